#include "app/command_line.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <functional>
#include <initializer_list>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/examples.h"
#include "app/manual.h"
#include "app/option_checks.h"
#include "app/run_display.h"
#include "campaign/campaign_process.h"
#include "campaign/journal.h"
#include "core/error.h"
#include "core/provenance.h"
#include "core/text.h"

namespace rockyard::app {
namespace {

// Opens a standard stream that is closed. It is opened for reading alone, so that writing to it
// still fails. open() takes the lowest free number, which is `descriptor`, as the standard streams
// below it are open: they must be opened in ascending order.
void OpenIfClosed(int descriptor) {
  if (fcntl(descriptor, F_GETFD) >= 0) return;
  [[maybe_unused]] const int opened = open("/dev/null", O_RDONLY);
}

// Must be called first of all. A standard stream that the caller has closed is opened, or a file of
// a run would get its number, and with it what is printed: reading then finds the end, and writing
// fails (console.h). Writing into a pipe without a reader, or beyond a limit on the size of files,
// becomes an error instead of a signal, which would end the program before its results are stored.
void PrepareStandardStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) OpenIfClosed(stream);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

// Returns what `action` returns. An exception out of it is told on standard error, and gives
// kBadInput for core::UserError, kFailed for anything else.
ExitCode Guarded(const std::function<ExitCode()>& action) {
  const campaign::Observer console = MessagesToConsole(Output::kText);
  campaign::Journal journal(console);
  return campaign::Guarded(journal, action);
}

// Must agree: these numbers and those of campaign::Outcome.
constexpr const char* kFooter =
    "Exit codes: 0 done, 1 a comparison differs, 2 bad input (nothing written), 3 too many\n"
    "simulator faults, 4 inconclusive, 5 failed while running, 130 interrupted.";

std::string VersionText() {
  const core::Provenance p = core::CurrentProvenance();
  return fmt::format("{}\nflags {}\non {} ({}, {}, {} threads)", core::VersionLine(), p.flags,
                     p.host, p.cpu_model, p.cpu_level, p.cpu_threads);
}

// Returns the innermost subcommand that was named: `plan claim` of `rockyard plan claim`.
const CLI::App& Chosen(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? app : Chosen(*chosen.front());
}

// Returns "--trails" of "The following arguments were not expected: 5 --trails"; empty for other
// errors, and where no option is among the arguments.
std::string UnknownOption(const CLI::ParseError& error) {
  const std::string text = error.what();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr) return "";
  const std::size_t dashes = text.find(" --", text.find(": "));
  if (dashes == std::string::npos) return "";
  const std::string word = text.substr(dashes + 1);
  return word.substr(0, word.find_first_of(" ="));
}

// Returns the option of the subcommand that is nearest to the word; empty where none is near.
std::string NearestOption(const CLI::App& command, std::string_view word) {
  if (!word.starts_with("--")) return "";
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  return std::string(core::Nearest(word, candidates));
}

core::Problem ExplainOption(const CLI::App& command, const std::string& unknown,
                            const CLI::ParseError& error) {
  const std::string text = error.what();
  if (const auto refused = RefusedValue(command, error)) return *refused;
  // The two options exclude each other; CLI11 names both and says no more.
  if (text.find("--trials") != std::string::npos &&
      text.find("--until-half-width") != std::string::npos) {
    return {"command line", text, "--max-trials bounds the trials of --until-half-width"};
  }
  const std::string meant = NearestOption(command, unknown);
  if (meant.empty()) return {"command line", text, HelpOf(command)};
  return {"command line", fmt::format("{} is no option of this command", unknown),
          fmt::format("did you mean \"{}\"? see {}", meant, HelpOf(command))};
}

// Returns the problem of a command line that the parser refused. `first` is its first word: the
// parser would say that a subcommand is missing, not that the one given is unknown.
core::Problem Explain(const CLI::App& app, const CLI::ParseError& error, std::string_view first) {
  const CLI::App& command = Chosen(app);
  if (&command != &app) return ExplainOption(command, UnknownOption(error), error);
  if (first.empty() || first.front() == '-') {
    return ExplainOption(app, std::string(first), error);
  }
  std::vector<std::string> names;
  for (const CLI::App* each : app.get_subcommands({})) names.push_back(each->get_name());
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  return {"command line", fmt::format("\"{}\" is no subcommand", first),
          core::Suggest(first, candidates)};
}

// Prints on rank 0 alone: every rank that mpirun started reads the same command line.
void PrintOnce(const std::vector<core::Problem>& problems) {
  if (campaign::IsFirstRank()) PrintProblems(problems);
}

// Lets rank 0 tell first what is wrong with the input: mpirun ends every rank as soon as one has
// left with an error. Where only the input of this rank is bad (a file that its machine lacks), its
// leaving ends all ranks.
void LeaveFirstRankTime(ExitCode outcome) {
  constexpr std::chrono::seconds kFirstRank{10};
  if (outcome != ExitCode::kBadInput || campaign::IsFirstRank()) return;
  std::this_thread::sleep_for(kFirstRank);
}

// Returns whether every rank of mpirun takes part: ranks share the trials of a campaign, and rank 0
// alone does anything else.
bool IsForAllRanks(std::string_view command) { return command == "run" || command == "sweep"; }

// Throws core::UserError for a word that is no UTF-8: words go into stores, pages and files of
// JSON, which could not be read again.
void CheckText(std::string_view word) {
  if (core::Utf8Bytes(word) == word.size()) return;
  throw core::UserError(std::string(word), "is no text of UTF-8",
                        "set a locale of UTF-8, or rename the file");
}

ExitCode Parse(CLI::App& app, int argc, const char* const* argv, const ExitCode& exit_code) {
  for (int i = 1; i < argc; ++i) CheckText(argv[i]);
  if (argc <= 1) {
    Print(Wrapped(StartText(app)));
    return ExitCode::kDone;
  }
  try {
    app.parse(argc, argv);
    return exit_code;
  } catch (const CLI::Success& request) {  // --help, --version
    std::ostringstream asked_for;
    app.exit(request, asked_for, asked_for);
    Print(asked_for.str());
    return ExitCode::kDone;
  } catch (const CLI::ParseError& error) {
    PrintOnce({Explain(app, error, argc > 1 ? argv[1] : "")});
    return ExitCode::kBadInput;
  }
}

}  // namespace

void AddCommands(CLI::App& app, ExitCode& exit_code) {
  app.require_subcommand(1);
  app.footer(kFooter);
  app.set_version_flag("--version", VersionText);
  // Help, docs/commands and completion have the commands in this order.
  AddRunCommand(app, exit_code);
  AddSweepCommand(app, exit_code);
  AddCheckCommand(app, exit_code);
  AddBaselineCommand(app);
  AddCompareCommand(app, exit_code);
  AddMergeCommand(app, exit_code);
  AddRoverCommand(app);
  AddMobilityCommand(app, exit_code);
  AddBenchCommand(app, exit_code);
  AddTerrainCommand(app);
  AddRenderCommand(app, exit_code);
  AddStereoCommand(app);
  AddVoCommand(app, exit_code);
  AddCylinderCommand(app, exit_code);
  AddCalibrateCommand(app);
  AddTraceCommand(app, exit_code);
  AddReplayCommand(app, exit_code);
  AddReportCommand(app, exit_code);
  AddValidateCommand(app);
  AddDefaultsCommand(app);
  AddSchemaCommand(app);
  AddListCommand(app);
  AddParametersCommand(app);
  AddPlanCommand(app);
  AddMetricsCommand(app);
  AddNewCommand(app);
  AddHelpCommand(app);
  AddCompletionCommand(app);
  // Must come last: these go over all options that have been added.
  AddExamples(app);
  CheckEveryValue(app);
  KeepEveryInput(app);
}

int RunCommandLine(int argc, const char* const* argv) {
  PrepareStandardStreams();
  if (!campaign::IsFirstRank() && !(argc > 1 && IsForAllRanks(argv[1]))) {
    return static_cast<int>(ExitCode::kDone);
  }
  const ExitCode outcome = Guarded([&] {
    CLI::App app("Monte Carlo performance evaluation of planetary rovers", "rockyard");
    app.formatter(HelpFormatter());  // of its subcommands, too
    ExitCode exit_code = ExitCode::kDone;
    AddCommands(app, exit_code);
    return Parse(app, argc, argv, exit_code);
  });
  LeaveFirstRankTime(outcome);
  return static_cast<int>(OutputFailed() ? AfterFailedOutput(outcome) : outcome);
}

}  // namespace rockyard::app
