#include "campaign/bench/bench_verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>
#include <utility>

#include "batch/campaign_differences.h"
#include "batch/executor.h"
#include "batch/parallel_tasks.h"
#include "campaign/bench/bench_chain.h"
#include "campaign/run_source.h"
#include "campaign/scenario_names.h"
#include "core/digest.h"
#include "core/error.h"
#include "core/files.h"
#include "core/json_text.h"
#include "core/random.h"
#include "experiments/make_experiment.h"
#include "navigation/action_log.h"
#include "report/trace_view.h"
#include "scenario/load.h"
#include "scenario/sweep.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxFindings = 10;  // of each kind

// One drive of the run.
struct StoredDrive {
  std::size_t cell = 0;
  truth::Record record;
};

// Whether the cells of the store are those of the suite with what the entry may set.
void CheckCells(const BenchRun& run, const std::string& suite_word, const batch::ResultStore& store,
                std::vector<std::string>& findings) {
  const std::string file =
      ScenarioFile(suite_word.empty() ? "bench/" + run.suite : suite_word, Wanted::kSweep);
  // The seed of a test depends on it: with another digest somebody could look for a better seed.
  if (core::Sha256(scenario::LoadSweep(file, {.sealed = true}).document) != run.suite_digest) {
    findings.emplace_back("the digest of the suite is another one");
  }
  scenario::Sweep suite =
      scenario::LoadSweep(file, {.overrides = SettingsOf(*run.document.Find("entry"), run.manifest),
                                 .trials = run.layouts,
                                 .seed = run.seed,
                                 .sealed = true});
  const auto& cells = store.identity().cells;
  if (cells.size() != suite.cells.size()) {
    findings.push_back(
        fmt::format("the suite has {} cells, the run {}", suite.cells.size(), cells.size()));
    return;
  }
  const bool foreign = !run.manifest.plugin.empty() || !run.manifest.process.empty();
  const std::string own = "navigation." + run.manifest.navigator;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].name != suite.cells[i].name) {
      findings.push_back(
          fmt::format("cell {} is {} in the suite", cells[i].name, suite.cells[i].name));
      return;
    }
    LeaveOut(run.manifest.track, suite.cells[i].scenario);
    for (const batch::ScenarioDifference& difference : batch::FindScenarioDifferences(
             cells[i].resolved, scenario::ResolvedJson(suite.cells[i].scenario))) {
      // What a plugin has for parameters is known to the plugin alone.
      if (foreign && (difference.path.starts_with("plugins") || difference.path.starts_with(own))) {
        continue;
      }
      findings.push_back(fmt::format("cell {}: {} is {}, and {} in the suite", cells[i].name,
                                     difference.path, difference.first, difference.second));
      if (findings.size() >= kMaxFindings) return;
    }
  }
}

void CheckChain(const BenchRun& run, const batch::ResultStore& store,
                std::vector<std::string>& findings) {
  const std::string file = (run.folder / kChainFile).string();
  constexpr std::size_t kMaxBytes = std::size_t{1} << 28;
  const std::vector<ChainLink> told =
      ParseChain(core::ReadTextFile(file, kMaxBytes, "the chain of a bench run"), file);
  const std::vector<ChainLink> made = MakeChain(run.folder, store, run.start);
  if (told.empty() || told.back().digest != run.head) {
    findings.push_back(fmt::format("{} does not end with the head of {}", kChainFile, kBenchFile));
  }
  const auto [at, made_at] = std::ranges::mismatch(told, made);
  if (at == told.end() && made_at == made.end()) return;
  if (made_at == made.end() || at == told.end()) {
    findings.push_back(
        fmt::format("{} has {} links, the run {} drives", kChainFile, told.size(), made.size()));
    return;
  }
  findings.push_back(fmt::format("trial {} of {} is not the drive that the chain holds",
                                 made_at->trial, store.identity().cells[made_at->cell].name));
}

// Returns which drives are driven again, in the order of cells and trials.
std::vector<std::size_t> Sample(std::size_t drives, const BenchVerifyRequest& request) {
  std::vector<std::size_t> chosen(drives);
  std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  const auto wanted = std::min(drives, static_cast<std::size_t>(request.sample));
  core::RandomStream random({request.seed, 0}, core::Purpose::kExperiment);
  for (std::size_t i = 0; i < wanted; ++i) {
    std::swap(chosen[i], chosen[i + random.NextU64() % (drives - i)]);
  }
  chosen.resize(wanted);
  std::ranges::sort(chosen);
  return chosen;
}

// The experiment of a cell, whose navigators give the answers of the run.
std::unique_ptr<experiments::Experiment> PlayedExperiment(const fs::path& folder, std::size_t cell,
                                                          const batch::CellIdentity& identity) {
  // A plugin or process says what it reads and what its looks cost; it decides nothing.
  scenario::Scenario scenario = ScenarioToDrive(identity.resolved, identity.name);
  scenario.drive.navigation.navigators.WrapChosen(
      [&](std::unique_ptr<navigation::NavigatorKind> kind) {
        return navigation::Played(std::move(kind), [=](std::uint64_t random_seed) {
          const fs::path file = folder / ActionFile(cell, identity.name, random_seed);
          constexpr std::size_t kMaxBytes = std::size_t{1} << 28;
          return core::ReadWholeFile(file, kMaxBytes, "a file of actions");
        });
      });
  return experiments::MakeExperiment(scenario.experiment, scenario.drive);
}

// Drives some again, and says what differs.
void DriveAgain(const BenchVerifyRequest& request, const batch::ResultStore& store,
                const std::vector<StoredDrive>& drives, BenchVerification& verification,
                const std::function<void(std::size_t, std::size_t)>& progress, const Stop& stop) {
  const auto& cells = store.identity().cells;
  std::vector<std::unique_ptr<experiments::Experiment>> experiments;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    experiments.push_back(PlayedExperiment(request.folder, i, cells[i]));
  }
  std::vector<std::string> found(drives.size());
  std::atomic<bool> ended = false;
  const StopWish wish(stop);
  std::mutex mutex;
  std::size_t done = 0;
  const auto drive = [&](std::size_t i) {
    const StoredDrive& of = drives[i];
    const truth::RecordSchema& schema = experiments[of.cell]->schema();
    truth::Record again = experiments[of.cell]->Run(cells[of.cell].seed, of.record.trial);
    again.detail = of.record.detail;  // may be the navigator's own words
    const auto differences = report::RecordDifferences(schema, of.record, again);
    if (!differences.empty()) {
      found[i] = fmt::format("trial {} of {} is another one when its actions are driven again: {}",
                             of.record.trial, cells[of.cell].name, differences.front());
    }
    const std::lock_guard lock(mutex);
    ++done;
    if (progress) progress(done, drives.size());
    if (wish.IsThere()) ended = true;
  };
  verification.driven_again = static_cast<std::int64_t>(batch::RunTasks(
      drives.size(), batch::ThreadCount({.threads = request.threads}), ended, drive));
  std::size_t told = 0;
  for (std::string& finding : found) {
    if (!finding.empty() && told++ < kMaxFindings) {
      verification.findings.push_back(std::move(finding));
    }
  }
}

}  // namespace

double BenchVerification::ChanceToMiss(double share) const {
  // Without replacement: that no invented drive is among those driven again.
  const auto invented = std::llround(share * static_cast<double>(drives));
  double chance = 1.0;
  for (std::int64_t i = 0; i < driven_again; ++i) {
    chance *= std::max(0.0, 1.0 - static_cast<double>(invented) / static_cast<double>(drives - i));
  }
  return chance;
}

BenchVerification VerifyBench(const BenchVerifyRequest& request,
                              const std::function<void(std::size_t, std::size_t)>& progress,
                              const Stop& stop) {
  BenchVerification verification;
  verification.run = ReadBenchRun(request.folder);
  const batch::ResultStore store = batch::ResultStore::Read(request.folder);
  const std::vector<std::string> builds = store.Builds();
  if (builds != std::vector<std::string>{BuildName()}) {
    throw core::UserError(request.folder.string(), "was driven by another build: " + builds.front(),
                          "verify it with that program");
  }
  CheckCells(verification.run, request.suite, store, verification.findings);
  const std::int64_t seed =
      verification.run.beacon.empty()
          ? verification.run.seed
          : BeaconSeed(verification.run.suite_digest, verification.run.beacon);
  if (seed != verification.run.seed) {
    verification.findings.emplace_back("the seed is not that of the beacon");
  }
  if (ChainStart(verification.run.document, store) != verification.run.start) {
    verification.findings.push_back(
        fmt::format("{} is not what its chain begins with", kBenchFile));
  }
  if (!request.entry.empty() && ReadEntry(request.entry).digest != verification.run.entry_digest) {
    verification.findings.emplace_back("the entry is not the one that drove");
  }
  CheckChain(verification.run, store, verification.findings);
  std::vector<StoredDrive> drives;
  for (std::size_t cell = 0; cell < store.identity().cells.size(); ++cell) {
    for (truth::Record& record : store.Load(static_cast<int>(cell))) {
      drives.push_back({cell, std::move(record)});
    }
  }
  verification.drives = static_cast<std::int64_t>(drives.size());
  std::vector<StoredDrive> sample;
  for (const std::size_t i : Sample(drives.size(), request)) {
    if (IsFault(drives[i].record) || IsNavigatorCrash(drives[i].record)) {
      ++verification.not_driven;
    } else {
      sample.push_back(std::move(drives[i]));
    }
  }
  DriveAgain(request, store, sample, verification, progress, stop);
  return verification;
}

}  // namespace rockyard::campaign
