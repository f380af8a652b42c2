#include "app/open_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "app/run_source.h"
#include "batch/store_error.h"
#include "core/hash.h"
#include "scenario/load.h"

namespace rockyard::app {
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

fs::path FolderOf(const RunRequest& request, const scenario::Scenario& scenario) {
  if (!request.out.empty()) return request.out;
  return fs::path("results") / "runs" /
         fmt::format("{}-seed{}", FileName(scenario.name), scenario.seed);
}

batch::CampaignIdentity IdentityOf(const scenario::Scenario& scenario,
                                   const truth::RecordSchema& schema) {
  return {.name = scenario.name,
          .design = "",
          .build = BuildName(),
          .schema = schema,
          .cells = {{.name = "",
                     .scenario = scenario.name,
                     .fingerprint = core::Hex(scenario::Fingerprint(scenario)),
                     .resolved = scenario::ResolvedJson(scenario),
                     .seed = static_cast<std::uint64_t>(scenario.seed)}}};
}

// Removes the folder again, if it was not there before, unless all went well.
class NewFolderGuard {
 public:
  explicit NewFolderGuard(const fs::path& folder) {
    std::error_code error;
    if (!fs::exists(folder, error)) folder_ = folder;
  }
  ~NewFolderGuard() {
    std::error_code ignored;
    if (!folder_.empty()) fs::remove(folder_, ignored);
  }
  NewFolderGuard(const NewFolderGuard&) = delete;
  NewFolderGuard& operator=(const NewFolderGuard&) = delete;

  void Keep() { folder_.clear(); }

 private:
  fs::path folder_;
};

class Opener {
 public:
  Opener(const RunRequest& request, const scenario::Scenario& scenario,
         const truth::RecordSchema& schema)
      : request_(request),
        scenario_(scenario),
        folder_(FolderOf(request, scenario)),
        identity_(IdentityOf(scenario, schema)) {}

  OpenedRun Open() {
    RefuseForeignFolder();
    NewFolderGuard guard(folder_);
    auto claim = std::make_unique<batch::FolderClaim>(folder_);
    batch::ResultStore store = OpenStore();
    const std::int64_t trials = PlanTrials(store);
    guard.Keep();
    scenario_.trials = trials;
    return {std::move(scenario_), std::move(folder_), std::move(claim), std::move(store), trials,
            std::move(notes_)};
  }

 private:
  bool MayResume() const {
    return request_.existing == ExistingRun::kResume ||
           request_.existing == ExistingRun::kResumeOrSetAside;
  }
  bool MaySetAside() const {
    return request_.existing == ExistingRun::kSetAside ||
           request_.existing == ExistingRun::kResumeOrSetAside;
  }

  // Before anything is made or claimed: a folder that no run made is not written into by accident.
  void RefuseForeignFolder() const {
    std::error_code error;
    const bool empty = !fs::exists(folder_, error) || !fs::is_directory(folder_, error) ||
                       fs::is_empty(folder_, error);
    if (empty || MaySetAside()) return;
    if (!batch::HoldsStore(folder_)) {
      throw StoreError(StoreProblem::kExists, folder_.string(), "is not empty and holds no run",
                       "choose another folder with --out, or write into it with --force");
    }
    if (!MayResume()) {
      throw StoreError(StoreProblem::kExists, folder_.string(), "holds a run already",
                       "go on with it by --resume, set it aside by --force (nothing is "
                       "deleted), or choose another folder with --out");
    }
  }

  batch::ResultStore OpenStore() {
    if (batch::HoldsStore(folder_) && MayResume()) {
      try {
        return batch::ResultStore::Resume(folder_, identity_, request_.build);
      } catch (const StoreError& error) {
        const bool useless =
            error.problem() == StoreProblem::kMismatch || error.problem() == StoreProblem::kDamaged;
        if (!useless || !MaySetAside()) throw;
        notes_.push_back("cannot go on with the run in the folder: " + FirstReason(error));
      }
    }
    if (batch::HoldsStore(folder_)) {
      const fs::path aside = batch::SetStoreAside(folder_);
      notes_.push_back("the former results are kept as " + aside.string());
    }
    return batch::ResultStore::Create(folder_, identity_, scenario_.trials);
  }

  static std::string FirstReason(const StoreError& error) {
    const core::Problem& problem = error.problems().at(error.problems().size() > 1 ? 1 : 0);
    return problem.path + " " + problem.reason;
  }

  // A resumed run keeps its plan unless --trials says more.
  std::int64_t PlanTrials(batch::ResultStore& store) {
    const std::vector<batch::FinishedTrial> finished = store.Finished();
    const std::int64_t stored = finished.empty() ? 0 : finished.back().id.trial + 1;
    const std::int64_t wanted = request_.trials ? scenario_.trials : store.planned();
    const std::int64_t trials = std::max(wanted, stored);
    if (stored > 0) {
      notes_.push_back(fmt::format("going on with {}: trials up to {} of {} are there",
                                   folder_.string(), stored, trials));
    }
    if (trials != store.planned()) store.SetPlanned(0, trials);
    return trials;
  }

  const RunRequest& request_;
  scenario::Scenario scenario_;
  fs::path folder_;
  batch::CampaignIdentity identity_;
  std::vector<std::string> notes_;
};

}  // namespace

scenario::Scenario RequestedScenario(const RunRequest& request) {
  std::vector<std::string> overrides = request.overrides;
  if (request.trials) overrides.push_back(fmt::format("trials={}", *request.trials));
  if (request.seed) overrides.push_back(fmt::format("seed={}", *request.seed));
  return LoadScenarioFrom(request.scenario, overrides);
}

OpenedRun OpenRun(const RunRequest& request, const scenario::Scenario& scenario,
                  const truth::RecordSchema& schema) {
  return Opener(request, scenario, schema).Open();
}

}  // namespace rockyard::app
