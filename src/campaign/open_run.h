// From a plan to a store that is ready for trials; the files that a campaign derives from its
// store, beside it. Running a campaign opens its folder here, dry runs ask what that would do.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "batch/campaign.h"
#include "batch/campaign_differences.h"
#include "batch/result_store.h"
#include "batch/run_folder.h"
#include "batch/work_plan.h"
#include "campaign/work.h"
#include "scenario/scenario.h"
#include "truth/record.h"

namespace rockyard::campaign {

// A cell as it is to be run; its scenario says how many trials.
struct CampaignCell {
  std::string name;  // "" in a run of one scenario
  scenario::Scenario scenario;

  // Returns the cell in words, for people.
  std::string Label() const { return name.empty() ? "scenario" : "cell " + name; }
};

// A plan: what is to be run.
struct CampaignPlan {
  std::string name;
  std::string design;            // JSON text of the sweep file; "" for a run
  std::filesystem::path folder;  // where nothing else is asked for
  std::vector<CampaignCell> cells;
  std::optional<std::vector<std::string>> settings = std::nullopt;  // CampaignIdentity::settings
  std::string program = {};  // that links rockyard and decides records, too; "" of the command
};

// How a plan is to be run, and in which folder.
struct OpenRequest {
  std::filesystem::path folder;
  ExistingRun existing = ExistingRun::kRefuse;
  batch::BuildPolicy build = batch::BuildPolicy::kSame;
  bool retry_faults = false;  // of a run that goes on: its simulator faults are driven again
  bool trials_given = false;  // false: those planned before count, where there is a run
  std::optional<batch::StoppingRule> rule;  // none: that of a run that goes on
  batch::Shard shard;
  // Called once the folder is ready, before its store is made or when it goes on. A later process
  // of the same command must open the folder with kOwn from then on.
  std::function<void()> own = {};
};

struct OpenedRun {
  std::filesystem::path folder;
  std::unique_ptr<batch::FolderClaim> claim;
  batch::ResultStore store;        // with its rule and the trials that each cell is to have
  std::vector<std::string> notes;  // for the user: what was set aside, where it goes on
};

// Returns results/runs/<name>-seed<seed>, with '_' for what has no place in the name of a file.
// Must stay: --resume without --out finds the run there.
std::filesystem::path DefaultFolder(const std::string& name, std::int64_t seed);

// Returns what the store of a plan says of itself. `schema`: of the experiment of every cell.
batch::CampaignIdentity IdentityOf(const CampaignPlan& plan, const truth::RecordSchema& schema,
                                   batch::Shard shard);

// Throws batch::StoreError where the request may not use the folder as it is: it holds something
// else, or a run that may not be gone on with. Writes nothing.
void CheckFolder(const OpenRequest& request, const batch::CampaignIdentity& identity);

// Opens the folder for the plan: a new store, or one that goes on, and the trials that each cell is
// to have. Throws core::UserError (batch::StoreError where it is about the folder); a folder that
// was made for the run is then removed again.
OpenedRun OpenRun(const OpenRequest& request, const CampaignPlan& plan,
                  const truth::RecordSchema& schema);

// How many trials a plan has.
struct PlannedTrials {
  std::vector<std::int64_t> cells;  // the shard's share of each
  std::int64_t total = 0;           // of all, as far as the budget of a rule goes
  bool at_most = false;             // a rule may end cells before

  std::string text() const;  // "12 trials", "at most 100 trials"
};

// Returns how many trials a plan has that is to be run as requested; trials that are stored already
// are among them.
PlannedTrials TrialsOf(const OpenRequest& request, const CampaignPlan& plan);

// Returns whether a campaign writes a file of that name into its folder, or has its store there:
// other commands must not write over it (CheckOutputFile).
bool IsRunFile(const std::filesystem::path& name);

}  // namespace rockyard::campaign
