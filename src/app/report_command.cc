// rockyard report
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "app/command_text.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/report_build.h"
#include "batch/run_folder.h"
#include "campaign/derived_files.h"
#include "campaign/output_file.h"
#include "campaign/shell_word.h"
#include "core/error.h"
#include "report/atomic_file.h"
#include "report/line_text.h"
#include "web/page.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

constexpr double kLargePage_bytes = 5e6;

struct PageOptions {
  std::vector<std::string> runs;
  std::string out;
  std::size_t replays = 5;
  std::string against;
  std::string title;
  std::string cell;
  std::string data;
};

// "report.html" in the folder that was named first.
std::string PageFile(const PageOptions& options) {
  return options.out.empty() ? (fs::path(options.runs.front()) / "report.html").string()
                             : options.out;
}

std::string Title(const PageOptions& options, const std::vector<campaign::ReportInput>& inputs) {
  constexpr std::size_t kNamed = 3;
  if (!options.title.empty()) return options.title;
  std::string title;
  for (std::size_t i = 0; i < std::min(inputs.size(), kNamed); ++i) {
    title += (i == 0 ? "" : ", ") + inputs[i].label;
  }
  if (inputs.size() > kNamed) title += fmt::format(" and {} more", inputs.size() - kNamed);
  return title;
}

// Before the work: what cannot be meant, or would lay a page over what a run holds.
void CheckFile(const char* option, const std::string& file, const char* extension) {
  campaign::CheckOutputFile(option, file);
  campaign::CheckExtension(option, file, extension);
  const fs::path folder = fs::absolute(file).parent_path();
  if (batch::HoldsStore(folder) && campaign::IsRunFile(fs::path(file).filename())) {
    throw core::UserError(option, "is a file of the run itself: " + file, "choose another name");
  }
}

void CheckBuilt(const PageOptions& options) {
  if (!web::PagesBuilt() && (options.data.empty() || !options.out.empty())) {
    throw core::UserError("rockyard report", "this program was built without its pages",
                          "install nodejs and npm and build it again (scripts/quickstart.sh), or "
                          "write the numbers alone with --data FILE");
  }
}

void CheckFiles(const PageOptions& options) {
  if (web::PagesBuilt()) CheckFile("--out", PageFile(options), ".html");
  if (!options.data.empty()) CheckFile("--data", options.data, ".json");
}

std::string Size(std::size_t bytes) {
  return bytes < 1000000 ? fmt::format("{:.0f} kB", 1e-3 * static_cast<double>(bytes))
                         : fmt::format("{:.1f} MB", 1e-6 * static_cast<double>(bytes));
}

void PrintPage(const std::string& file, std::size_t bytes, const Report& report) {
  Print(fmt::format("  {} ({}): {} run{}, {} trials\n", report::Printable(file), Size(bytes),
                    report.runs, report.runs == 1 ? "" : "s", report.trials));
  if (report.replays.written > 0) {
    Print(fmt::format("  {} replay{} in {}\n", report.replays.written,
                      report.replays.written == 1 ? "" : "s",
                      report::Printable(report.replays.folder.string())));
  }
  if (static_cast<double>(bytes) > kLargePage_bytes) {
    PrintNote(fmt::format(
        "the page has {}, and may open slowly: name fewer runs, or one cell with --cell",
        Size(bytes)));
  }
  Print(fmt::format("  next: open it in a browser, for example `xdg-open {}`\n",
                    campaign::ShellWord(file)));
}

void WriteFiles(const PageOptions& options, const ReportRequest& request, const Report& report) {
  if (!options.data.empty()) {
    report::WriteFileAtomically(options.data, report.json);
    Print(fmt::format("  {} ({})\n", options.data, Size(report.json.size())));
  }
  if (web::PagesBuilt()) {
    const std::string page = web::MakePage(web::Page::kReport, request.title, report.json);
    report::WriteFileAtomically(request.page, page);
    PrintPage(request.page.string(), page.size(), report);
  }
}

ExitCode WriteReport(const PageOptions& options, const std::string& command) {
  CheckBuilt(options);
  ReportRequest request;
  request.inputs = campaign::FindReportInputs(options.runs, options.cell);
  CheckFiles(options);
  request.title = Title(options, request.inputs);
  request.command = command;
  request.against = options.against;
  request.replays = web::PagesBuilt() ? options.replays : 0;
  request.page = PageFile(options);
  const Report report = BuildReport(request);
  try {
    WriteFiles(options, request, report);
  } catch (const core::UserError& failure) {
    // A disk that fails after the work, not input that is wrong before it.
    PrintProblems(failure.problems());
    if (report.replays.written > 0) {
      PrintNote(fmt::format("{} replays are written, in {}", report.replays.written,
                            report.replays.folder.string()));
    }
    return ExitCode::kFailed;
  }
  return report.replays.exit_code;
}

}  // namespace

void AddReportCommand(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<PageOptions>();
  CLI::App* command = app.add_subcommand(
      "report", "Writes a page for a browser: what runs and sweeps say, and replays of failures");
  command
      ->add_option("RUN", options->runs,
                   "folders of runs or sweeps; runs are compared with the first")
      ->required();
  command->add_option("--out", options->out,
                      "page to write (default: report.html in the folder that is named first)");
  command
      ->add_option("--replays", options->replays,
                   "replays that are written with it: of the worst failed trials of each run, or "
                   "of each sweep; 0: none")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command->add_option("--against", options->against,
                      "reference with published values (default: those in results/reference that "
                      "name the scenarios)");
  command->add_option("--cell", options->cell,
                      "one cell of a campaign alone: its name, or number from 0");
  command->add_option("--title", options->title, "title of the page");
  command->add_option("--data", options->data, "write the numbers of the page to this file (JSON)");
  command->callback(
      [options, command, &exit_code] { exit_code = WriteReport(*options, CommandText(*command)); });
}

}  // namespace rockyard::app
