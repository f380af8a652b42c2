// One trial to run again: of a scenario, or of a finished run whose record it must repeat.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "batch/result_store.h"
#include "campaign/work.h"
#include "core/error.h"
#include "scenario/scenario.h"
#include "truth/record.h"

namespace rockyard::campaign {

// The trial, and what a finished run says of it.
struct TrialSource {
  scenario::Scenario scenario;
  std::uint64_t seed = 1;
  std::string cell;     // name of the campaign's cell; "" for a run or a scenario
  std::string request;  // the words that name the trial again, but for --trial
  std::optional<truth::Record> stored;
  std::vector<std::string> builds;  // that wrote the run
};

// Throws core::UserError: no such scenario, run or trial, or --seed or --set with a run.
TrialSource FindTrial(const TrialRequest& request);

// The same of a run that has been read already: the trial `stored` of `cell`, or nothing where it
// is pending. `request` tells where they are from. Throws core::UserError where the scenario is of
// another version of the program.
TrialSource StoredTrial(const TrialRequest& request, const batch::CellIdentity& cell,
                        std::vector<std::string> builds, std::optional<truth::Record> stored);

// "rockyard replay ..." of that trial, as a shell reads it.
std::string ReplayCommandLine(const TrialSource& source, std::uint64_t trial);

// Where `record` does not repeat the stored one, which must be there, and what to do then; nothing
// where it does.
std::vector<core::Problem> CompareWithStore(const TrialRequest& request, const TrialSource& source,
                                            const truth::RecordSchema& schema,
                                            const truth::Record& record);

}  // namespace rockyard::campaign
