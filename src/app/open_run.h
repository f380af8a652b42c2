// From the options of `rockyard run` to a store that is ready for trials.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "batch/result_store.h"
#include "batch/run_folder.h"
#include "scenario/scenario.h"
#include "truth/record.h"

namespace rockyard::app {

// What to do with a run that lies in the folder already. No choice deletes a store.
enum class ExistingRun {
  kRefuse,            // the default
  kResume,            // go on; refuse where scenario, seed or build differ
  kSetAside,          // --force: rename its store and start anew
  kResumeOrSetAside,  // --resume --force: go on where it fits, otherwise set aside
};

struct RunRequest {
  std::filesystem::path scenario;
  std::vector<std::string> overrides;
  std::optional<std::int64_t> trials;  // absent: the scenario's, or those planned before
  std::optional<std::int64_t> seed;    // absent: the scenario's
  std::filesystem::path out;           // empty: results/runs/<name>-seed<seed>
  ExistingRun existing = ExistingRun::kRefuse;
  batch::BuildPolicy build = batch::BuildPolicy::kSame;
};

struct OpenedRun {
  scenario::Scenario scenario;
  std::filesystem::path folder;
  std::unique_ptr<batch::FolderClaim> claim;
  batch::ResultStore store;
  std::int64_t trials = 0;         // to have in the end
  std::vector<std::string> notes;  // for the user: what was set aside, where it goes on
};

// `schema` of the scenario's experiment. Throws core::UserError (batch::StoreError where it is
// about the folder); a folder made for the run is then removed again.
OpenedRun OpenRun(const RunRequest& request, const scenario::Scenario& scenario,
                  const truth::RecordSchema& schema);

// The scenario of the request with --set, --trials and --seed.
scenario::Scenario RequestedScenario(const RunRequest& request);

}  // namespace rockyard::app
