// The command `rockyard bench`: navigators of everybody on one suite, with a subcommand for each
// step of an entry.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "app/campaign_options.h"
#include "app/command_text.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/output_files.h"
#include "app/progress_line.h"
#include "app/run_display.h"
#include "campaign/bench/bench.h"
#include "campaign/bench/bench_page.h"
#include "campaign/bench/bench_standings.h"
#include "campaign/bench/bench_verify.h"
#include "campaign/scenario_names.h"
#include "core/json_text.h"
#include "report/line_text.h"
#include "report/result_table.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

struct BenchRunOptions {
  campaign::BenchRequest request;
  CampaignOptions campaign;
};

void AddRun(CLI::App& bench, ExitCode& exit_code) {
  auto options = std::make_shared<BenchRunOptions>();
  CLI::App* command = bench.add_subcommand(
      "run", "Drives the cells of a suite with an entry; keeps every record and every action");
  CampaignOptions& campaign = options->campaign;
  command
      ->add_option("ENTRY", options->request.entry,
                   "manifest of the entry, or its folder with an entry.json")
      ->required();
  command->add_option("--suite", options->request.suite, "sweep file or its name (bench/points)");
  command
      ->add_option("--layouts", campaign.request.trials,
                   "layouts of each cell (default: all of the suite); tables need all")
      ->check(CLI::Range(std::int64_t{2}, std::int64_t{1'000'000}));
  command->add_option("--beacon", options->request.beacon,
                      "what a public randomness beacon published after the entry was frozen: its "
                      "round gives the seed (default: the suite's, for development)");
  command->add_option("--out", campaign.out,
                      "run folder (default: results/runs/bench-<suite>-<entry>-seed<seed>)");
  command->add_flag("--resume", campaign.resume, "go on with the run in the folder");
  command->add_flag("--force", campaign.force,
                    "set a run in the folder aside (as *.old-1.*) and start anew");
  command
      ->add_option("--threads", campaign.request.containment.threads,
                   "threads (default: all of the machine)")
      ->check(CLI::Range(1, 4096));
  command->add_flag("--quiet", campaign.quiet, "print nothing but errors");
  command->callback([options, command, &exit_code] {
    // The text of a command has its own name alone: "rockyard run ...".
    constexpr std::string_view kProgram = "rockyard ";
    options->campaign.resume_command =
        "rockyard bench " + ResumeText(*command).substr(kProgram.size());
    options->campaign.names_next = false;
    options->request.campaign = options->campaign.Request();
    SharedFlag output_failed;
    const campaign::RunObserver shown = ShowRun(options->campaign, output_failed);
    const campaign::WorkResult result = campaign::RunBench(options->request, shown, StopBySignal());
    if (result.outcome == ExitCode::kDone && !options->campaign.quiet) {
      const std::string& suite = options->request.suite;
      Print(fmt::format(
          "  head: {}\n  next: rockyard bench verify {}{}\n",
          campaign::ReadBenchRun(result.folder).head, campaign::ShellPath(result.folder.string()),
          suite.starts_with("bench/") ? "" : " --suite " + campaign::ShellPath(suite)));
    }
    exit_code = ShownOutcome(result.outcome, output_failed);
  });
}

struct BenchReportOptions {
  std::vector<fs::path> folders;
  std::string out;
  campaign::ExistingFiles existing = campaign::ExistingFiles::kRefuse;
  bool json = false;
};

// Returns the words that make the page again.
std::string CommandText(const BenchReportOptions& options) {
  std::string text = "rockyard bench report";
  for (const fs::path& folder : options.folders) {
    text += " " + campaign::ShellPath(folder.string());
  }
  return text + " --out " + campaign::ShellPath(options.out);
}

void AddReport(CLI::App& bench) {
  auto options = std::make_shared<BenchReportOptions>();
  CLI::App* command = bench.add_subcommand(
      "report", "Entries of one suite beside each other, by their drives that truly arrive");
  command->add_option("RUN", options->folders, "folders of runs; the first is the baseline")
      ->required();
  command->add_option("--out", options->out,
                      "folder for tables and a page; it is made (default: nothing is written)");
  AddExistingFiles(*command, options->existing);
  command->add_flag("--json", options->json, "for programs");
  command->callback([options] {
    std::optional<campaign::OutputFolder> folder;
    if (!options->out.empty()) {
      folder.emplace(options->out, options->existing,
                     campaign::OutputPlan{.command = "bench",
                                          .names = {"standings.csv", "groups.csv", "cells.csv",
                                                    "ends.csv", "bench.md", "index.html"},
                                          .inputs = options->folders});
    }
    const campaign::Standings standings = campaign::MakeStandings(options->folders);
    if (folder) {
      folder->Write("standings", "standings.csv", standings.Table().Csv());
      folder->Write("groups", "groups.csv", standings.Groups().Csv());
      folder->Write("cells", "cells.csv", standings.Cells().Csv());
      folder->Write("ends", "ends.csv", standings.Ends().Csv());
      folder->Write("text", "bench.md", standings.Markdown());
      folder->Write("page", "index.html", campaign::BenchPage(standings, CommandText(*options)));
      folder->Finish();
    }
    if (options->json) {
      PrintJson(standings.Table().Json("") + "\n");
    } else {
      const std::string& why = standings.why_no_regret;
      Print(fmt::format("{}: {} layouts of each cell\n\n{}{}{}", standings.suite, standings.layouts,
                        standings.Markdown(), why.empty() ? "" : why + "\n",
                        folder ? FilesText(folder->files()) : std::string()));
    }
  });
}

struct BenchVerifyOptions {
  campaign::BenchVerifyRequest request;
  std::optional<std::uint64_t> seed;
  bool json = false;
};

std::string VerificationText(const campaign::BenchVerification& found, std::uint64_t seed) {
  std::string text = fmt::format(
      "{}: {} drives, {} driven again (--seed {}){}\n", report::Printable(found.run.name()),
      found.drives, found.driven_again, seed,
      found.not_driven > 0 ? fmt::format(", {} of the sample that cannot be", found.not_driven)
                           : std::string());
  text += fmt::format("  head: {}\n", found.run.head);
  for (const std::string& finding : found.findings) text += "  " + finding + "\n";
  if (found.findings.empty() && found.driven_again == 0)
    text += "  nothing is wrong; no drive was driven again\n";
  if (found.findings.empty() && found.driven_again > 0) {
    text += fmt::format(
        "  nothing is wrong; were a hundredth of the drives invented, this would have been seen "
        "with {:.1f} %\n",
        100.0 * (1.0 - found.ChanceToMiss(0.01)));
  }
  return text;
}

void AddVerify(CLI::App& bench, ExitCode& exit_code) {
  auto options = std::make_shared<BenchVerifyOptions>();
  CLI::App* command = bench.add_subcommand(
      "verify", "Makes the chain of a run again, and drives some of its drives by their actions");
  command->add_option("RUN", options->request.folder, "folder of a run of an entry")->required();
  command->add_option("--suite", options->request.suite,
                      "sweep file or its name (default: bench/ and the name in the run)");
  command->add_option("--entry", options->request.entry,
                      "the entry, to be held against what drove (default: it is not at hand)");
  command
      ->add_option("--sample", options->request.sample,
                   "drives that are driven again; as many as there are for all (300)")
      ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()));
  command->add_option("--seed", options->seed,
                      "of the choice of these drives (default: drawn anew, and told)");
  command
      ->add_option("--threads", options->request.threads, "threads (default: all of the machine)")
      ->check(CLI::Range(1, 4096));
  command->add_flag("--json", options->json, "for programs");
  command->callback([options, &exit_code] {
    campaign::BenchVerifyRequest& request = options->request;
    // An entry must not know which of its drives are looked at.
    request.seed = options->seed ? *options->seed : std::random_device()();
    ProgressLine line(stderr);
    const campaign::BenchVerification found = campaign::VerifyBench(
        request,
        [&](std::size_t done, std::size_t planned) {
          const std::string text = fmt::format("  {}/{} drives", done, planned);
          if (done == planned) return line.FinishText(text);
          line.ShowText(text);
        },
        StopBySignal());
    const bool whole =
        found.driven_again + found.not_driven >= std::min(found.drives, request.sample);
    if (options->json) {
      PrintJson(core::DumpJson(report::ObjectTree(
          "entry", found.run.name(), "head", found.run.head, "drives", found.drives, "driven_again",
          found.driven_again, "not_driven", found.not_driven, "seed", std::to_string(request.seed),
          "findings", core::ListOf(found.findings), "chance_to_miss_a_hundredth",
          found.ChanceToMiss(0.01))));
    } else {
      Print(VerificationText(found, request.seed));
    }
    if (!found.findings.empty()) exit_code = ExitCode::kDiffers;
    if (!whole && found.findings.empty()) exit_code = ExitCode::kInterrupted;
  });
}

void AddList(CLI::App& bench) {
  CLI::App* command = bench.add_subcommand("list", "The suites");
  command->callback([] {
    std::string text;
    for (const std::string& path : campaign::ScenarioPaths(campaign::Wanted::kSweep)) {
      if (!path.starts_with("bench/")) continue;
      const scenario::Sweep suite = scenario::LoadSweep(
          campaign::ScenarioFile(path, campaign::Wanted::kSweep), {.sealed = true});
      text +=
          fmt::format("{}  ({} cells of {} layouts, seed {})\n    {}\n", path, suite.cells.size(),
                      suite.cells.front().scenario.trials, suite.seed, suite.description);
    }
    Print(text);
  });
}

}  // namespace

void AddBenchCommand(CLI::App& app, ExitCode& exit_code) {
  CLI::App* bench = app.add_subcommand(
      "bench", "Navigators of everybody on the same rocks: runs, tables, and their verification");
  bench->require_subcommand(1);
  AddRun(*bench, exit_code);
  AddReport(*bench);
  AddVerify(*bench, exit_code);
  AddList(*bench);
}

}  // namespace rockyard::app
