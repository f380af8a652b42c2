// One result as rows under named columns, written as CSV, JSON and Markdown.
#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <vector>

#include "core/json_pieces.h"
#include "report/csv.h"

namespace rockyard::report {

// Columns are texts such as "id,p_value,verdict". Where a renderer is given some, it writes these,
// in their order; "low as ci95_low" gives one another name.
class ResultTable {
 public:
  explicit ResultTable(std::string_view columns);

  // A row: text, doubles, integers, flags and intervals (two columns), in the order of the columns.
  // The last columns may be left out.
  template <typename... Values>
  void Add(const Values&... values) {
    rows_.emplace_back();
    (AddValue(values), ...);
  }

  // With a header. What is not finite, or was left out, is empty.
  std::string Csv(std::string_view columns = "") const;

  // A list of objects, on one line. What is not finite, or was left out, is null.
  std::string Json(std::string_view columns) const;

  // The first column as code, without what a terminal obeys or hides.
  std::string Markdown(std::string_view columns = "") const;

 private:
  struct Cell {
    std::string csv;
    std::string json;
    std::string text;  // as it was given
  };

  // Those columns, by place, with the names to write.
  struct Choice {
    std::vector<std::size_t> places;
    std::vector<std::string> names;
  };

  template <typename Value>
  void AddValue(const Value& value) {
    if constexpr (std::convertible_to<Value, std::string_view>) {
      AddText(value);
    } else if constexpr (std::same_as<Value, bool>) {
      AddCell(value ? "1" : "0", value ? "true" : "false");
    } else if constexpr (std::integral<Value>) {
      AddCell(std::to_string(value), std::to_string(value));
    } else if constexpr (std::floating_point<Value>) {
      AddCell(CsvNumber(value), core::JsonNumber(value));
    } else {
      AddValue(value.low);
      AddValue(value.high);
    }
  }

  void AddText(std::string_view text);
  void AddCell(std::string csv, std::string json);
  Choice Chosen(std::string_view columns) const;

  std::vector<std::string> columns_;
  std::vector<std::vector<Cell>> rows_;
};

}  // namespace rockyard::report
