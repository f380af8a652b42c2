// The command `rockyard baseline`: keeps what runs gave in a file, for `rockyard check --against`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/run_folders.h"
#include "campaign/reference_cases.h"
#include "report/baseline.h"
#include "report/line_text.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

struct BaselineOptions {
  std::vector<std::string> runs;
  std::string reason;
  std::string name;
  std::string out;
};

// Returns the name of the baseline: --name, else that of the file, else that of the folder of the
// first run.
std::string NameOf(const BaselineOptions& options) {
  if (!options.name.empty()) return options.name;
  if (!options.out.empty()) return fs::path(options.out).stem().string();
  return fs::weakly_canonical(options.runs.front()).filename().string();
}

void WriteBaseline(const BaselineOptions& options) {
  const std::string name = NameOf(options);
  const std::string out =
      options.out.empty() ? fmt::format("results/baselines/{}.json", name) : options.out;
  const report::Baseline baseline =
      campaign::WriteBaseline({.runs = options.runs, .name = name, .reason = options.reason}, out)
          .OrThrow();
  Print(fmt::format("{}: {} cells, {} bytes\n", report::Printable(out), baseline.cells.size(),
                    fs::file_size(out)));
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
