// `rockyard bench run`: an entry drives the cells of a suite, every record and every action is
// kept, and all of them are tied together by a chain of digests. docs/bench.md has the rules.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "batch/result_store.h"
#include "campaign/bench/entry.h"
#include "campaign/run.h"
#include "campaign/run_campaign.h"
#include "campaign/work.h"
#include "core/json_value.h"
#include "scenario/scenario.h"

namespace rockyard::campaign {

// The version of the rules: cells are weighted, seeds made and chains linked by it.
inline constexpr std::int64_t kBenchVersion = 1;
// In the folder of a run, beside the store: what was entered, and the chain.
inline constexpr const char* kBenchFile = "bench.json";
inline constexpr const char* kChainFile = "chain.csv";

struct BenchRequest {
  std::filesystem::path entry;
  std::string suite = "bench/points";  // a sweep file or its name
  // Of a public randomness beacon, a round after the entry was frozen: the seed of a test. Empty:
  // the suite's seed, for development.
  std::string beacon = {};
  // `overrides`, `seed` and `prepare` are the benchmark's; `trials` are the layouts, absent: all.
  CampaignRequest campaign = {};
};

// Runs what the folder lacks of the drives, as RunSweep does, then writes kBenchFile and
// kChainFile. Never throws.
WorkResult RunBench(const BenchRequest& request, const RunObserver& observer = {},
                    const Stop& stop = {});

// Returns the seed that a round of a beacon gives to a suite, 0 to 2^62 - 1. Must stay: the first
// 62 bits of the SHA-256 of "rockyard bench 1", the suite's digest and the beacon's text, a line
// each.
std::int64_t BeaconSeed(std::string_view suite_digest, std::string_view beacon);

// Leaves out of a cell what entries of the track do not read: maps of the site.
void LeaveOut(BenchTrack track, scenario::Scenario& cell);

// What a run's chain begins with: SHA-256 of the entry, the suite, the seed and who drove.
std::string ChainStart(const core::JsonValue& document, const batch::ResultStore& store);

// A finished run of an entry.
struct BenchRun {
  std::filesystem::path folder;
  core::JsonValue document;  // kBenchFile whole
  EntryParams manifest;
  std::string entry_digest;
  std::string suite;         // the sweep's name
  std::string suite_digest;  // of the sweep file with all that it extends
  std::string beacon;        // "": driven by the suite's seed
  std::int64_t seed = 0;
  std::int64_t layouts = 0;
  std::string start;  // what the chain begins with
  std::string head;   // of the chain

  // Returns what the table of standings calls it.
  const std::string& name() const { return manifest.name; }
};

// Reads the run of an entry in a folder. Throws core::UserError where it is none.
BenchRun ReadBenchRun(const std::filesystem::path& folder);

}  // namespace rockyard::campaign
