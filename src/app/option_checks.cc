#include "app/option_checks.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

#include "app/completion.h"
#include "app/console.h"
#include "app/run_folders.h"
#include "app/set_options.h"
#include "campaign/scenario_names.h"
#include "core/json_file.h"
#include "core/text.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

std::string EmptyProblem(const std::string& text) {
  return text.empty() ? "is empty: give a value, or leave the option out" : "";
}

// Returns what is wrong with a real number; nothing for text that is no number at all, which the
// parser refuses in its own words.
std::string FiniteProblem(const std::string& text) {
  double number = 0.0;
  if (!CLI::detail::lexical_cast(text, number)) return "";
  if (text.find_first_of("xX") != std::string::npos) return text + " is no decimal number";
  return std::isfinite(number) ? "" : text + " is no finite number";
}

// Returns a whole number without plus and leading zeros: scripts pad numbers so ("007"), and the
// parser would take them as octal. Returns other text as it is.
std::string WithoutPadding(std::string text) {
  const bool negative = text.starts_with('-');
  const std::size_t sign = negative || text.starts_with('+') ? 1 : 0;
  const bool whole =
      text.size() > sign && text.find_first_not_of("0123456789", sign) == std::string::npos;
  if (!whole) return text;
  const std::size_t digit = std::min(text.find_first_not_of('0', sign), text.size() - 1);
  return (negative ? "-" : "") + text.substr(digit);
}

// Returns what is wrong with a whole number. The parser would replace one that is too large by the
// largest that fits, wrap a negative one around, and read other bases.
template <typename Integer>
std::string WholeProblem(const std::string& text) {
  Integer number = 0;
  const char* end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, number);
  if (result.ec == std::errc::result_out_of_range) return text + " has too many digits";
  if (!std::is_signed_v<Integer> && text.starts_with('-')) return text + " is negative";
  return result.ec == std::errc() && result.ptr == end ? "" : text + " is no whole decimal number";
}

// The options that name a file or folder to be written. Must be complete: an option that is missing
// here counts as one that names files to be read.
constexpr std::array<std::string_view, 7> kOutputs = {"--out",  "--csv",  "--svg",  "--npz",
                                                      "--mcap", "--data", "--junit"};

bool IsOutput(const CLI::Option& option) {
  return std::find(kOutputs.begin(), kOutputs.end(), option.get_name()) != kOutputs.end();
}

// Returns the path that a word of the command line means, which may be the name of a scenario or
// rover.
fs::path MeantBy(const CLI::Option& option, const std::string& word) {
  if (!option.get_positional() || fs::exists(word)) return word;
  try {
    return campaign::ScenarioFile(word, campaign::Wanted::kRover);
  } catch (const core::UserError&) {
    return word;  // it means something else
  }
}

// Returns all files that are read for an input: a scenario and those that it extends.
std::vector<fs::path> ReadFor(const fs::path& input) {
  std::error_code error;
  if (!fs::is_regular_file(input, error)) return {input};
  try {
    return core::FilesOf(input);
  } catch (const core::UserError&) {
    return {input};  // no scenario, or one of which the command says what is wrong
  }
}

void RefuseWriting(const std::string& option, const fs::path& file, const fs::path& input) {
  std::error_code error;
  if (fs::is_regular_file(file, error) && fs::equivalent(file, input, error)) {
    throw core::UserError(option, fmt::format("is {}, which is read", input.string()),
                          "name another file");
  }
}

void KeepInputs(const CLI::App& command) {
  for (const CLI::Option* output : command.get_options()) {
    if (!IsOutput(*output) || output->count() == 0) continue;
    for (const CLI::Option* option : command.get_options()) {
      if (IsOutput(*option)) continue;
      for (const std::string& word : option->results()) {
        for (const fs::path& input : ReadFor(MeantBy(*option, word))) {
          RefuseWriting(output->get_name(), output->results().front(), input);
        }
      }
    }
  }
}

const CLI::Option* OptionNamed(const CLI::App& command, const std::string& name) {
  for (const CLI::App* inner : command.get_subcommands()) {
    if (const CLI::Option* option = OptionNamed(*inner, name)) return option;
  }
  return command.get_option_no_throw(name);
}

// Returns "wald" of the parser's "wald not in {wilson,clopper-pearson}", or "Check wald value in
// {...} FAILED", as a transformation words it; empty for other reasons.
std::string GivenWord(const std::string& reason) {
  const std::size_t end = reason.find(" not in {");
  if (end != std::string::npos) return reason.substr(0, end);
  constexpr std::string_view kCheck = "Check ";
  const std::size_t value = reason.find(" value in {");
  if (!reason.starts_with(kCheck) || value == std::string::npos) return "";
  return reason.substr(kCheck.size(), value - kCheck.size());
}

}  // namespace

void KeepEveryInput(CLI::App& app) {
  for (CLI::App* command : app.get_subcommands({})) {
    command->parse_complete_callback([command] { KeepInputs(*command); });
  }
}

void CheckEveryValue(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (option->get_expected_min() == 0 || option->get_items_expected_min() == 0) continue;
    const std::string type = option->get_type_name();
    option->check(EmptyProblem);
    if (type.starts_with("FLOAT")) option->check(FiniteProblem);
    if (type.starts_with("INT") || type.starts_with("UINT")) option->transform(WithoutPadding);
    if (type.starts_with("INT")) option->check(WholeProblem<std::int64_t>);
    if (type.starts_with("UINT")) option->check(WholeProblem<std::uint64_t>);
  }
  for (CLI::App* command : app.get_subcommands({})) CheckEveryValue(*command);
}

std::string HelpOf(const CLI::App& command) {
  std::string words = "--help";
  for (const CLI::App* at = &command; at->get_parent() != nullptr; at = at->get_parent()) {
    words = fmt::format("{} {}", at->get_name(), words);
  }
  return "rockyard " + words;
}

std::optional<core::Problem> RefusedValue(const CLI::App& command, const CLI::ParseError& error) {
  if (dynamic_cast<const CLI::ValidationError*>(&error) == nullptr) return std::nullopt;
  const std::string text = error.what();  // "--interval: wald not in {wilson,clopper-pearson}"
  const std::size_t colon = text.find(": ");
  if (colon == std::string::npos) return std::nullopt;
  const std::string name = text.substr(0, colon);
  const std::string reason = text.substr(colon + 2);
  const std::string help = HelpOf(command);
  const CLI::Option* option = OptionNamed(command, name);
  const std::string given = GivenWord(reason);
  if (option == nullptr || given.empty()) return core::Problem{name, reason, help};
  const std::vector<std::string> choices = ChoicesOf(*option);
  const std::vector<std::string_view> candidates(choices.begin(), choices.end());
  if (choices.empty()) return core::Problem{name, reason, help};
  return core::Problem{name, fmt::format("\"{}\" is none of its values", given),
                       core::Suggest(given, candidates)};
}

void AddTrialOptions(CLI::App& command, campaign::TrialRequest& request) {
  command
      .add_option("SCENARIO_OR_RUN", request.source,
                  "scenario file or its name, scenario.resolved.json, or the folder of a run")
      ->required();
  command.add_option("--trial", request.trial, "trial index, from 0")->required();
  command.add_option("--cell", request.cell, "cell of a campaign: its name, or number from 0");
  command.add_option("--seed", request.seed, "seed of every random stream");
  AddSetOptions(command, request.overrides);
}

void FindSource(campaign::TrialRequest& request) {
  request.source = campaign::ScenarioFile(request.source);
  RequireRuns(std::span(&request.source, 1));
}

void PrintRepetition(std::optional<bool> repeats_stored, const std::string& source) {
  std::error_code error;
  if (repeats_stored.value_or(false)) {
    Print("  same as the stored record, bit for bit\n");
  } else if (!repeats_stored && std::filesystem::is_directory(source, error)) {
    Print("  pending in the run: compared with nothing\n");
  }
}

}  // namespace rockyard::app
