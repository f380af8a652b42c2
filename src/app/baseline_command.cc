// rockyard baseline
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "batch/run_folder.h"
#include "batch/trial_hash.h"
#include "campaign/baseline_scenario.h"
#include "campaign/output_file.h"
#include "campaign/run_source.h"
#include "core/error.h"
#include "report/atomic_file.h"
#include "report/baseline.h"
#include "truth/measurement_record.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

struct BaselineOptions {
  std::vector<std::string> runs;
  std::string reason;
  std::string name;
  std::string out;
};

// Every build that wrote trials of the runs: one, if an exact comparison is to be possible.
std::string Joined(const std::set<std::string>& builds) {
  return fmt::format("{}", fmt::join(builds, "; "));
}

// What would make a bad baseline.
std::vector<core::Problem> ProblemsOf(const campaign::StoredRun& run) {
  if (truth::IsMeasurement(run.schema)) {
    return {{run.Label(), "drives nothing, so that no metric is defined", "name runs of drives"}};
  }
  if (run.prefix().empty()) return {{run.Label(), "holds no finished trials", "run some first"}};
  if (static_cast<std::int64_t>(run.prefix().size()) < run.planned) {
    return {{run.Label(),
             fmt::format("is unfinished: {} of {} trials", run.prefix().size(), run.planned),
             "finish it with rockyard run --resume"}};
  }
  return campaign::SharedLayoutProblems(run.Label(), run.identity.resolved);
}

report::BaselineCell CellOf(const campaign::StoredRun& run) {
  report::BaselineCell cell{.name = campaign::CellName(run),
                            .scenario = run.identity.scenario,
                            .fingerprint = run.identity.fingerprint,
                            .resolved = run.identity.resolved,
                            .seed = run.identity.seed,
                            .trial_hash = batch::TrialHash(run.prefix()),
                            .outcomes = {},
                            .metrics = {}};
  report::FillBaselineCell(run.schema, run.prefix(), cell);
  return cell;
}

report::Baseline ReadBaseline(const BaselineOptions& options) {
  report::Baseline baseline;
  baseline.reason = options.reason;
  std::set<std::string> builds;
  std::vector<core::Problem> problems;
  for (const std::string& path : options.runs) {
    for (const fs::path& folder : batch::FindRuns(path)) {
      for (const campaign::StoredRun& run : campaign::ReadCampaign(folder)) {
        campaign::RequireWhole(run);
        for (core::Problem& problem : ProblemsOf(run)) problems.push_back(std::move(problem));
        builds.insert(run.builds.begin(), run.builds.end());
        baseline.cells.push_back(CellOf(run));
      }
    }
  }
  for (std::size_t i = 0; i < baseline.cells.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (baseline.cells[i].name != baseline.cells[j].name) continue;
      problems.push_back(
          {baseline.cells[i].name, "is the name of two cells", "name runs of different scenarios"});
    }
  }
  if (!problems.empty()) throw core::UserError(std::move(problems));
  baseline.build = Joined(builds);
  return baseline;
}

// Of the file, else of the folder of the first run.
std::string NameOf(const BaselineOptions& options) {
  if (!options.name.empty()) return options.name;
  if (!options.out.empty()) return fs::path(options.out).stem().string();
  return fs::weakly_canonical(options.runs.front()).filename().string();
}

void WriteBaseline(const BaselineOptions& options) {
  if (options.reason.find_first_not_of(" \t\n") == std::string::npos) {
    throw core::UserError("--reason", "is empty", "say why the numbers may be what they are");
  }
  const std::string name = NameOf(options);
  const std::string out =
      options.out.empty() ? fmt::format("results/baselines/{}.json", name) : options.out;
  campaign::CheckOutputFile("--out", out);
  report::Baseline baseline = ReadBaseline(options);
  baseline.name = name;
  const std::string text = report::BaselineJson(baseline);
  report::WriteFileAtomically(out, text);
  Print(fmt::format("{}: {} cells, {} bytes\n", out, baseline.cells.size(), text.size()));
}

}  // namespace

void AddBaselineCommand(CLI::App& app) {
  auto options = std::make_shared<BaselineOptions>();
  CLI::App* command = app.add_subcommand(
      "baseline", "Keeps what runs gave, for rockyard check to hold later builds against it");
  command->add_option("RUN", options->runs, "folders of runs, or a folder of such folders")
      ->required();
  command->add_option("--reason", options->reason, "why it is made, or made anew")->required();
  command->add_option("--name", options->name, "its name; else that of the file or of the folder");
  command->add_option("--out", options->out, "file; else results/baselines/NAME.json");
  command->callback([options] { WriteBaseline(*options); });
}

}  // namespace rockyard::app
