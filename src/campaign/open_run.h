// From a plan to a store that is ready for trials; the files that a campaign derives from its
// store, beside it.
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

  // For people.
  std::string Label() const { return name.empty() ? "scenario" : "cell " + name; }
};

// What is to be run.
struct CampaignPlan {
  std::string name;
  std::string design;            // JSON text of the sweep file; "" for a run
  std::filesystem::path folder;  // where nothing else is asked for
  std::vector<CampaignCell> cells;
  std::optional<std::vector<std::string>> settings = std::nullopt;  // CampaignIdentity::settings
};

struct OpenRequest {
  std::filesystem::path folder;
  ExistingRun existing = ExistingRun::kRefuse;
  batch::BuildPolicy build = batch::BuildPolicy::kSame;
  bool retry_faults = false;  // of a run that goes on: its simulator faults are driven again
  bool trials_given = false;  // false: those planned before count, where there is a run
  std::optional<batch::StoppingRule> rule;  // none: that of a run that goes on
  batch::Shard shard;
  // Called once the folder is ready, before its store is made or when it goes on: whoever opens it
  // from then on for the same command does so with kOwn.
  std::function<void()> own = {};
};

struct OpenedRun {
  std::filesystem::path folder;
  std::unique_ptr<batch::FolderClaim> claim;
  batch::ResultStore store;        // with its rule and the trials that each cell is to have
  std::vector<std::string> notes;  // for the user: what was set aside, where it goes on
};

// results/runs/<name>-seed<seed>, with '_' for what has no place in the name of a file.
std::filesystem::path DefaultFolder(const std::string& name, std::int64_t seed);

// What the store of a plan says of itself. `schema`: of every cell's experiment.
batch::CampaignIdentity IdentityOf(const CampaignPlan& plan, const truth::RecordSchema& schema,
                                   batch::Shard shard);

// Throws batch::StoreError where the request may not use the folder as it is: it holds something
// else, or a run that may not be gone on with. Writes nothing.
void CheckFolder(const OpenRequest& request, const batch::CampaignIdentity& identity);

// Throws core::UserError (batch::StoreError where it is about the folder); a folder made for the
// run is then removed again.
OpenedRun OpenRun(const OpenRequest& request, const CampaignPlan& plan,
                  const truth::RecordSchema& schema);

struct PlannedTrials {
  std::vector<std::int64_t> cells;  // the shard's share of each
  std::int64_t total = 0;           // of all, as far as the budget of a rule goes
  bool at_most = false;             // a rule may end cells before

  std::string text() const;  // "12 trials", "at most 100 trials"
};

// Of a plan that is to be run as requested; trials that are stored already are among them.
PlannedTrials TrialsOf(const OpenRequest& request, const CampaignPlan& plan);

// Whether a campaign writes a file of that name into its folder, or has its store there.
bool IsRunFile(const std::filesystem::path& name);

}  // namespace rockyard::campaign
