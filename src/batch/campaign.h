// What a campaign is: a list of cells, each one resolved scenario with its trials. These types pass
// between all of this folder and the campaigns above it.
//
// Two kinds of faults occur. A simulator fault is the record of a trial in which the simulator
// failed (truth::TrialOutcome::kSimulatorFault). An infrastructure fault says that the machine or a
// process failed; the trial has no record and stays pending.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "truth/record.h"

namespace rockyard::batch {

// One part of a campaign that is divided between machines: it runs the trials t of every cell with
// t % count == index - 1. The default is the whole campaign. Must stay: this formula. A store keeps
// index and count alone, so that by another one its trials would be foreign to it.
struct Shard {
  int index = 1;  // 1 .. count
  int count = 1;

  bool whole() const { return count == 1; }
  bool Has(std::int64_t trial) const { return trial % count == index - 1; }
  // Returns how many of the trials 0 .. trials-1 the shard runs.
  std::int64_t Share(std::int64_t trials) const { return (trials + count - index) / count; }
  bool operator==(const Shard&) const = default;
};

// What decides the records of one cell. All are plain texts, so that the store knows no scenario.
// Must stay, once stored: fingerprint and seed, with which the checksum of every stored trial
// begins.
struct CellIdentity {
  std::string name;         // "" in a campaign of one cell
  std::string scenario;     // name
  std::string fingerprint;  // of the resolved scenario
  std::string resolved;     // JSON of every effective value
  std::uint64_t seed = 1;
};

// What decides the records of a campaign, and what the campaign is called.
struct CampaignIdentity {
  std::string name;
  std::string design;  // JSON text of the sweep file; "" for a run of one scenario
  std::string build;   // program, compiler, flags and CPU level: what libm and the code depend on
  truth::RecordSchema schema;
  std::vector<CellIdentity> cells;
  Shard shard{};
  // What the scenario or sweep was changed by on the way from its file, for people: "PATH=VALUE",
  // "--ablate NAME". It decides no record. Absent where it is not known.
  std::optional<std::vector<std::string>> settings = std::nullopt;
};

struct TrialId {
  int cell = 0;  // index in CampaignIdentity::cells
  std::int64_t trial = 0;

  auto operator<=>(const TrialId&) const = default;
};

struct CellRecord {
  int cell = 0;
  truth::Record record;
};

// A stored trial without its values.
struct FinishedTrial {
  TrialId id;
  truth::TrialOutcome outcome = truth::TrialOutcome::kSimulatorFault;
};

// What happened to a machine or a process while a trial ran. The trial has no result from it, is in
// no hash, and may run again.
struct InfrastructureFault {
  TrialId id;
  std::string kind;    // e.g. "cpu_time_limit"
  std::string detail;  // a sentence for people
};

}  // namespace rockyard::batch
