#include "app/refused_value.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "app/completion_offers.h"
#include "core/spelling.h"

namespace rockyard::app {
namespace {

const CLI::Option* OptionNamed(const CLI::App& command, const std::string& name) {
  for (const CLI::App* inner : command.get_subcommands()) {
    if (const CLI::Option* option = OptionNamed(*inner, name)) return option;
  }
  return command.get_option_no_throw(name);
}

// "wald" of "wald not in {wilson,clopper-pearson}", and of what a transformation says: "Check wald
// value in {...} FAILED".
std::string GivenWord(const std::string& reason) {
  const std::size_t end = reason.find(" not in {");
  if (end != std::string::npos) return reason.substr(0, end);
  constexpr std::string_view kCheck = "Check ";
  const std::size_t value = reason.find(" value in {");
  if (!reason.starts_with(kCheck) || value == std::string::npos) return "";
  return reason.substr(kCheck.size(), value - kCheck.size());
}

}  // namespace

std::optional<core::Problem> RefusedValue(const CLI::App& command, const CLI::ParseError& error) {
  if (dynamic_cast<const CLI::ValidationError*>(&error) == nullptr) return std::nullopt;
  const std::string text = error.what();  // "--interval: wald not in {wilson,clopper-pearson}"
  const std::size_t colon = text.find(": ");
  if (colon == std::string::npos) return std::nullopt;
  const std::string name = text.substr(0, colon);
  const std::string reason = text.substr(colon + 2);
  const std::string help = fmt::format("rockyard {} --help", command.get_name());
  const CLI::Option* option = OptionNamed(command, name);
  const std::string given = GivenWord(reason);
  if (option == nullptr || given.empty()) return core::Problem{name, reason, help};
  const std::vector<std::string> choices = ChoicesOf(*option);
  const std::vector<std::string_view> candidates(choices.begin(), choices.end());
  if (choices.empty()) return core::Problem{name, reason, help};
  return core::Problem{name, fmt::format("\"{}\" is none of its values", given),
                       core::Suggest(given, candidates)};
}

}  // namespace rockyard::app
