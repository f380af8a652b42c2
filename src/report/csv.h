// Comma-separated values (RFC 4180, with line feeds alone).
#pragma once

#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>

#include "statistics/proportions.h"

namespace rockyard::report {

// The shortest decimal that reads back to the same bits; empty where it is not finite.
std::string CsvNumber(double value);

// A text, quoted where it has commas, quotes or line breaks. One that a spreadsheet would take for
// a formula, as it begins with = + - @ or a blank of its line (tab, carriage return) and is neither
// a number nor that sign alone, gets an apostrophe in front, and so does one that begins with an
// apostrophe: to read the text back, take one leading apostrophe away. Numbers stay as they are.
std::string CsvField(std::string_view text);

// One line, field by field: a text as CsvField has it, a double as CsvNumber, a flag as 1 or 0. An
// interval is two fields, and a list has one for each of its values.
class CsvRow {
 public:
  template <typename... Values>
  explicit CsvRow(const Values&... values) {
    Add(values...);
  }

  template <typename... Values>
  CsvRow& Add(const Values&... values) {
    (AddValue(values), ...);
    return *this;
  }

  CsvRow& AddEmpty(std::size_t fields) {
    while (fields-- > 0) AddField("");
    return *this;
  }

  // With a line feed.
  std::string Line() const { return text_ + '\n'; }

 private:
  template <typename Value>
  void AddValue(const Value& value) {
    if constexpr (std::convertible_to<Value, std::string_view>) {
      AddField(CsvField(value));
    } else if constexpr (std::same_as<Value, bool>) {
      AddField(value ? "1" : "0");
    } else if constexpr (std::integral<Value>) {
      AddField(std::to_string(value));
    } else if constexpr (std::floating_point<Value>) {
      AddField(CsvNumber(value));
    } else if constexpr (std::same_as<Value, statistics::Interval>) {
      Add(value.low, value.high);
    } else {
      for (const auto& each : value) Add(each);
    }
  }

  void AddField(std::string_view field);

  std::string text_;
  bool empty_ = true;
};

// The line of these values.
template <typename... Values>
std::string CsvLine(const Values&... values) {
  return CsvRow(values...).Line();
}

}  // namespace rockyard::report
