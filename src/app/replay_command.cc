// rockyard replay
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/replay_options.h"
#include "app/replay_views.h"
#include "app/trial_options.h"
#include "campaign/open_run.h"
#include "campaign/output_file.h"
#include "campaign/replay_page.h"
#include "core/error.h"
#include "report/atomic_file.h"
#include "report/line_text.h"
#include "web/page.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

// One file that is asked for.
struct AskedFile {
  std::string option;  // that names it
  std::string what;
  fs::path path;
  std::function<std::string(const campaign::ReplayedTrial&)> text;
};

std::string DefaultStem(const campaign::TrialSource& source, std::uint32_t trial) {
  const std::string cell = source.cell.empty() ? "" : fmt::format("-{}", source.cell);
  const fs::path folder =
      campaign::DefaultFolder(source.scenario.name + cell, static_cast<std::int64_t>(source.seed));
  return fmt::format("{}-trial{}", folder.string(), trial);
}

// Without pages there are the plan and the data.
std::vector<AskedFile> OutputsOf(const ReplayOptions& options,
                                 const campaign::TrialSource& source) {
  const std::string stem = options.out.empty() ? DefaultStem(source, options.request.trial)
                                               : fs::path(options.out).replace_extension().string();
  const bool pages = web::PagesBuilt();
  const auto path = [&](const std::string& asked, const char* extension) {
    return asked.empty() ? fs::path(stem + extension) : fs::path(asked);
  };
  std::vector<AskedFile> outputs;
  if (pages) {
    outputs.push_back({"--out", "3-D replay", path(options.out, ".html"),
                       [](const campaign::ReplayedTrial& replayed) {
                         return web::MakePage(web::Page::kReplay, replayed.data.title,
                                              campaign::ReplayPayload(replayed));
                       }});
  }
  outputs.push_back({"--svg", "plan view", path(options.svg, ".svg"),
                     [](const campaign::ReplayedTrial& replayed) { return replayed.plan_svg; }});
  if (!pages || !options.data.empty()) {
    outputs.push_back(
        {"--data", "data of the page", path(options.data, ".json"), campaign::ReplayPayload});
  }
  return outputs;
}

// Found before the drive rather than after it.
void CheckOutputs(const ReplayOptions& options, const std::vector<AskedFile>& outputs) {
  campaign::CheckOutputFile("--out", options.out);
  campaign::CheckExtension("--out", options.out, ".html");
  campaign::CheckOutputFile("--svg", options.svg);
  campaign::CheckOutputFile("--data", options.data);
  std::vector<campaign::NamedFile> files;
  files.reserve(outputs.size());
  for (const AskedFile& output : outputs) files.push_back({output.option, output.path.string()});
  campaign::CheckDistinct(files);
}

ExitCode WriteOutputs(const std::vector<AskedFile>& outputs,
                      const campaign::ReplayedTrial& replayed) {
  try {
    for (const AskedFile& output : outputs) {
      if (output.path.has_parent_path()) fs::create_directories(output.path.parent_path());
      report::WriteFileAtomically(output.path, output.text(replayed));
      Print(fmt::format("  {} in {}\n", output.what, report::Printable(output.path.string())));
    }
  } catch (const core::UserError& failure) {
    PrintProblems(failure.problems());
    return ExitCode::kFailed;
  } catch (const fs::filesystem_error& failure) {
    PrintProblems(
        {{failure.path1().string(), failure.code().message(), "name another file with --out"}});
    return ExitCode::kFailed;
  }
  return ExitCode::kDone;
}

ExitCode WritePage(const ReplayOptions& options) {
  const campaign::TrialSource source = campaign::FindTrial(options.request);
  const std::vector<AskedFile> outputs = OutputsOf(options, source);
  CheckOutputs(options, outputs);
  const campaign::ReplayedTrial replayed = campaign::ReplayTrial(source, options.request.trial);
  const report::ReplayData& data = replayed.data;
  Print(fmt::format("  {}\n", report::Printable(fmt::format("{}: {}, {}", data.title,
                                                            truth::Name(data.record.outcome),
                                                            data.record.detail))));
  const ExitCode same = source.stored ? TellRepetition(campaign::CompareWithStore(
                                            options.request, source, data.schema, data.record))
                                      : ExitCode::kDone;
  if (!web::PagesBuilt()) {
    PrintNote(
        "this build has no pages, so the 3-D replay is left out: install nodejs and npm, and build "
        "again");
  }
  const ExitCode written = WriteOutputs(outputs, replayed);
  return written == ExitCode::kDone ? same : written;
}

void AddOptions(CLI::App& command, ReplayOptions& options) {
  CLI::Option* scan =
      command
          .add_option("--scan", options.scan,
                      "number of a scan, from 0: writes its images and its array instead")
          ->check(CLI::NonNegativeNumber);
  CLI::Option* step =
      command
          .add_option("--step", options.step,
                      "number of a step, from 0: writes map, votes and choice of the navigator "
                      "instead")
          ->check(CLI::NonNegativeNumber)
          ->excludes(scan);
  CLI::Option* list =
      command.add_flag("--list", options.list, "lists scans and steps, and writes nothing")
          ->excludes(scan)
          ->excludes(step);
  command
      .add_option("--out", options.out,
                  "page (default: results/runs/<name>-seed<seed>-trial<I>.html); of a scan or step "
                  "a folder (default: ...-scan<N>, or -step<N>)")
      ->excludes(list);
  for (const auto& [name, file, what] :
       {std::tuple{"--svg", &options.svg, "file for the plan view (default: beside the page)"},
        std::tuple{"--data", &options.data, "file for what the page is given, as JSON"}}) {
    command.add_option(name, *file, what)->excludes(list)->excludes(scan)->excludes(step);
  }
}

}  // namespace

void AddReplayCommand(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<ReplayOptions>();
  CLI::App* command = app.add_subcommand(
      "replay",
      "Runs one trial again and writes a 3-D replay of it, a page for a browser, and a plan view; "
      "or lists\nor draws the scans of its light stripe and the steps of its map-based navigator");
  AddTrialOptions(*command, options->request);
  AddOptions(*command, *options);
  command->callback([options, &exit_code] {
    exit_code = options->list || options->draws() ? ShowViews(*options) : WritePage(*options);
  });
}

}  // namespace rockyard::app
