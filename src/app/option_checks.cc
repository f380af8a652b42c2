#include "app/option_checks.h"

#include <CLI/CLI.hpp>
#include <algorithm>
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
  if (!CLI::detail::lexical_cast(text, number)) return "";
  if (text.find_first_of("xX") != std::string::npos) return text + " is no decimal number";
  return std::isfinite(number) ? "" : text + " is no finite number";
}

// Without a plus and leading zeros, for which the parser would take a number as octal: scripts pad
// numbers so ("007").
std::string WithoutPadding(std::string text) {
  const bool negative = text.starts_with('-');
  const std::size_t sign = negative || text.starts_with('+') ? 1 : 0;
  const bool whole =
      text.size() > sign && text.find_first_not_of("0123456789", sign) == std::string::npos;
  if (!whole) return text;
  const std::size_t digit = std::min(text.find_first_not_of('0', sign), text.size() - 1);
  return (negative ? "-" : "") + text.substr(digit);
}

// The parser would take the largest number that fits, wrap a negative one around, and read other
// bases.
template <typename Integer>
std::string WholeProblem(const std::string& text) {
  Integer number = 0;
  const char* end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, number);
  if (result.ec == std::errc::result_out_of_range) return text + " has too many digits";
  if (!std::is_signed_v<Integer> && text.starts_with('-')) return text + " is negative";
  return result.ec == std::errc() && result.ptr == end ? "" : text + " is no whole decimal number";
}

}  // namespace

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

}  // namespace rockyard::app
