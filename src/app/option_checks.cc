#include "app/option_checks.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <system_error>
#include <type_traits>

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

// The parser would take the largest number that fits, or wrap a negative one around.
template <typename Integer>
std::string WholeProblem(const std::string& text) {
  Integer number = 0;
  const char* end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, number);
  if (result.ec == std::errc::result_out_of_range) return text + " has too many digits";
  return !std::is_signed_v<Integer> && text.starts_with('-') ? text + " is negative" : "";
}

}  // namespace

void CheckEveryValue(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (option->get_expected_min() == 0 || option->get_items_expected_min() == 0) continue;
    const std::string type = option->get_type_name();
    option->check(EmptyProblem);
    if (type.starts_with("FLOAT")) option->check(FiniteProblem);
    if (type.starts_with("INT")) option->check(WholeProblem<std::int64_t>);
    if (type.starts_with("UINT")) option->check(WholeProblem<std::uint64_t>);
  }
  for (CLI::App* command : app.get_subcommands({})) CheckEveryValue(*command);
}

}  // namespace rockyard::app
