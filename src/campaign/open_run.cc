#include "campaign/open_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

#include "batch/sqlite_database.h"
#include "campaign/navigator_times.h"
#include "campaign/run_source.h"
#include "core/error.h"
#include "core/hash.h"
#include "scenario/load.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;
using batch::StoreError;
using batch::StoreProblem;

std::string FileName(const std::string& name) {
  constexpr std::string_view kKept = "-._";
  std::string safe = name.substr(0, 100);
  for (char& c : safe) {
    const bool keep = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                      kKept.find(c) != std::string_view::npos;
    if (!keep) c = '_';
  }
  return safe;
}

bool MayResume(const OpenRequest& request) {
  return request.existing == ExistingRun::kResume || request.existing == ExistingRun::kOwn ||
         request.existing == ExistingRun::kResumeOrSetAside;
}

bool MaySetAside(const OpenRequest& request) {
  return request.existing == ExistingRun::kSetAside ||
         request.existing == ExistingRun::kResumeOrSetAside;
}

// Throws where the folder may not be used, before anything is made or claimed: a folder that no run
// made is not written into by accident.
void RefuseForeignFolder(const OpenRequest& request) {
  const fs::path& folder = request.folder;
  std::error_code error;
  const bool unused = !fs::exists(folder, error) || !fs::is_directory(folder, error) ||
                      batch::HoldsNoRunYet(folder);
  if (unused || MaySetAside(request) || request.existing == ExistingRun::kOwn) return;
  if (!batch::HoldsStore(folder)) {
    throw StoreError(StoreProblem::kExists, folder.string(), "is not empty and holds no run",
                     "choose another folder with --out, or write into it with --force, which "
                     "renames files of the names it needs");
  }
  if (!MayResume(request)) {
    throw StoreError(StoreProblem::kExists, folder.string(), "holds a run already",
                     "go on with it by --resume, set it aside by --force (nothing is "
                     "deleted), or choose another folder with --out");
  }
}

// The files of a campaign beside its store, as report/run_files.h and report/sweep_files.h write
// them, and the folder of campaign_traces.h. Must name all of them: a file that is missing here
// stays beside the results of another run after --force, and other commands may be told to write
// over it (IsRunFile).
constexpr std::array kDerivedFiles = {"attribution.csv",
                                      "cells.csv",
                                      "cells.svg",
                                      "curves.csv",
                                      "distance_cdf.csv",
                                      "differences.csv",
                                      "fit.csv",
                                      "fits.csv",
                                      NavigatorTimes::kFile,
                                      "scenario.resolved.json",
                                      "success.svg",
                                      "summary.json",
                                      "sweep.json",
                                      "traces",
                                      "trials.csv"};

// The files that `rockyard report` writes where it is told no other name: of the run, but written
// later.
constexpr std::array kReportFiles = {"report.html", "report_replays"};

fs::path FreeName(const fs::path& folder, const fs::path& name) {
  for (int number = 1;; ++number) {
    fs::path aside =
        fmt::format("{}.old-{}{}", name.stem().string(), number, name.extension().string());
    std::error_code error;
    if (!fs::exists(fs::symlink_status(folder / aside, error))) return aside;
  }
}

void SetAside(const fs::path& folder, const fs::path& name, std::vector<std::string>& names) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(folder / name, error))) return;
  const fs::path aside = FreeName(folder, name);
  fs::rename(folder / name, folder / aside, error);
  if (error) core::FailOnDisk(folder / name, "cannot be set aside", error);
  names.push_back(aside.string());
}

// Renames every file in the folder that has the name of one in kDerivedFiles or kReportFiles,
// whoever wrote it: summary.json to summary.old-1.json, or -2, ... Nothing is deleted or
// overwritten. Returns the new names. Requires a claim of the folder. Throws core::UserError where
// a file cannot be renamed.
std::vector<std::string> SetDerivedFilesAside(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::path name : kDerivedFiles) SetAside(folder, name, names);
  for (const fs::path name : kReportFiles) SetAside(folder, name, names);
  return names;
}

class Opener {
 public:
  Opener(const OpenRequest& request, const CampaignPlan& plan, const truth::RecordSchema& schema)
      : request_(request),
        plan_(plan),
        folder_(request.folder),
        identity_(IdentityOf(plan, schema, request.shard)) {}

  OpenedRun Open() {
    RefuseForeignFolder(request_);
    auto claim = std::make_unique<batch::FolderClaim>(folder_);
    const batch::EmptyFolders unused(claim->made());
    batch::ResultStore store = OpenStore();
    PlanTrials(store);
    return {folder_, std::move(claim), std::move(store), std::move(notes_)};
  }

 private:
  batch::ResultStore OpenStore() {
    if (batch::HoldsStore(folder_) && MayResume(request_)) {
      try {
        if (batch::ResultStore::HasBegun(folder_)) return Resume();
        notes_.emplace_back("the store in the folder holds nothing yet: the run starts anew");
      } catch (const StoreError& error) {
        const bool useless =
            error.problem() == StoreProblem::kMismatch || error.problem() == StoreProblem::kDamaged;
        if (!useless || !MaySetAside(request_)) throw;
        notes_.push_back("cannot go on with the run in the folder: " + FirstReason(error));
      }
    }
    if (batch::HoldsStore(folder_)) {
      const fs::path aside = batch::SetStoreAside(folder_);
      notes_.push_back("the former results are kept as " + aside.string());
    }
    if (MaySetAside(request_)) SetFilesAside();
    if (request_.retry_faults)
      notes_.emplace_back("no run is gone on with: no fault to drive again");
    TellItIsOwn();
    return batch::ResultStore::Create(folder_, identity_, WantedTrials());
  }

  batch::ResultStore Resume() {
    batch::ResultStore store = batch::ResultStore::Resume(folder_, identity_, request_.build);
    if (request_.retry_faults && request_.existing != ExistingRun::kOwn) {
      notes_.push_back(fmt::format("simulator faults to be driven again: {}", store.RetryFaults()));
    }
    TellItIsOwn();
    resumed_ = true;
    return store;
  }

  void TellItIsOwn() const {
    if (request_.own) request_.own();
  }

  // Sets aside what lies beside the store. Must be called only where the request allows to set all
  // of the folder aside.
  void SetFilesAside() {
    std::string names;
    for (const std::string& name : SetDerivedFilesAside(folder_)) {
      names += (names.empty() ? "" : ", ") + name;
    }
    if (!names.empty()) notes_.push_back("files that were there are kept as " + names);
  }

  static std::string FirstReason(const StoreError& error) {
    const core::Problem& problem = error.problems().at(error.problems().size() > 1 ? 1 : 0);
    return problem.path + " " + problem.reason;
  }

  std::vector<std::int64_t> WantedTrials() const {
    std::vector<std::int64_t> trials;
    for (const CampaignCell& cell : plan_.cells) trials.push_back(cell.scenario.trials);
    return trials;
  }

  // Sets rule and planned trials of the store. A resumed run keeps its plan and its rule unless the
  // user says otherwise. What is stored stays planned, under a rule until the run ends
  // (BatchSession::StoreEnds).
  void PlanTrials(batch::ResultStore& store) {
    const std::vector<batch::FinishedTrial> finished = store.Finished();
    std::vector<std::int64_t> ends(plan_.cells.size(), 0);
    for (const batch::FinishedTrial& trial : finished) {
      ends[static_cast<std::size_t>(trial.id.cell)] = trial.id.trial + 1;
    }
    std::optional<batch::StoppingRule> rule = request_.rule;
    if (!rule && resumed_ && !request_.trials_given) rule = store.rule();
    if (rule != store.rule()) store.SetRule(rule);
    std::int64_t planned = 0;
    for (int cell = 0; cell < store.cells(); ++cell) {
      const auto i = static_cast<std::size_t>(cell);
      const bool kept = resumed_ && !request_.trials_given;
      std::int64_t wanted = kept ? store.planned(cell) : plan_.cells[i].scenario.trials;
      if (rule) wanted = rule->max_trials;
      wanted = std::max(wanted, ends[i]);
      if (wanted != store.planned(cell)) store.SetPlanned(cell, wanted);
      planned += store.identity().shard.Share(wanted);
    }
    if (finished.empty()) return;
    notes_.push_back(fmt::format("going on with {}: {} of {}{} trials are there", folder_.string(),
                                 finished.size(), rule ? "at most " : "", planned));
  }

  const OpenRequest& request_;
  const CampaignPlan& plan_;
  fs::path folder_;
  batch::CampaignIdentity identity_;
  std::vector<std::string> notes_;
  bool resumed_ = false;
};

}  // namespace

fs::path DefaultFolder(const std::string& name, std::int64_t seed) {
  return fs::path("results") / "runs" / fmt::format("{}-seed{}", FileName(name), seed);
}

batch::CampaignIdentity IdentityOf(const CampaignPlan& plan, const truth::RecordSchema& schema,
                                   batch::Shard shard) {
  batch::CampaignIdentity identity{.name = plan.name,
                                   .design = plan.design,
                                   .build = BuildName(plan.program),
                                   .schema = schema,
                                   .cells = {},
                                   .shard = shard,
                                   .settings = plan.settings};
  for (const CampaignCell& cell : plan.cells) {
    identity.cells.push_back({.name = cell.name,
                              .scenario = cell.scenario.name,
                              .fingerprint = core::Hex(scenario::Fingerprint(cell.scenario)),
                              .resolved = scenario::ResolvedJson(cell.scenario),
                              .seed = static_cast<std::uint64_t>(cell.scenario.seed)});
  }
  return identity;
}

void CheckFolder(const OpenRequest& request, const batch::CampaignIdentity& identity) {
  RefuseForeignFolder(request);
  if (request.existing == ExistingRun::kResume && batch::ResultStore::HasBegun(request.folder)) {
    batch::ResultStore::RequireSame(request.folder, identity, request.build);
  }
}

OpenedRun OpenRun(const OpenRequest& request, const CampaignPlan& plan,
                  const truth::RecordSchema& schema) {
  return Opener(request, plan, schema).Open();
}

std::string PlannedTrials::text() const {
  return fmt::format("{}{} trials", at_most ? "at most " : "", total);
}

PlannedTrials TrialsOf(const OpenRequest& request, const CampaignPlan& plan) {
  PlannedTrials planned;
  planned.at_most = request.rule.has_value();
  for (const CampaignCell& cell : plan.cells) {
    const std::int64_t trials = request.rule ? request.rule->max_trials : cell.scenario.trials;
    planned.cells.push_back(request.shard.Share(trials));
    planned.total += planned.cells.back();
  }
  const bool limited = request.rule && request.rule->budget > 0;
  if (limited) planned.total = std::min(planned.total, request.rule->budget);
  return planned;
}

bool IsRunFile(const fs::path& name) {
  return name == batch::kStoreFile ||
         std::find(kDerivedFiles.begin(), kDerivedFiles.end(), name) != kDerivedFiles.end();
}

}  // namespace rockyard::campaign
