#include "app/option_checks.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace rockyard::app {
namespace {

std::string EmptyProblem(const std::string& text) {
  return text.empty() ? "is empty: give a value, or leave the option out" : "";
}

// Text that is no number at all is refused by the parser, in its own words.
std::string FiniteProblem(const std::string& text) {
  double number = 0.0;
  const bool finite = !CLI::detail::lexical_cast(text, number) || std::isfinite(number);
  return finite ? "" : text + " is no finite number";
}

}  // namespace

void CheckEveryValue(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (option->get_expected_min() == 0 || option->get_items_expected_min() == 0) continue;
    const bool real = option->get_type_name().starts_with("FLOAT");
    option->check(EmptyProblem);
    if (real) option->check(FiniteProblem);
  }
  for (CLI::App* command : app.get_subcommands({})) CheckEveryValue(*command);
}

}  // namespace rockyard::app
