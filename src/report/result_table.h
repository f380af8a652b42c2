// One result as rows under named columns, written as CSV, JSON and Markdown; single lines of CSV
// (RFC 4180, with line feeds alone); and objects of JSON in one call. Reports and commands write
// their tables and JSON by it.
#pragma once

#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/json_pieces.h"
#include "core/json_value.h"
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

// [low, high], null where there is none.
inline core::JsonValue EndsOf(const statistics::Interval& interval) {
  return core::JsonValue(
      core::JsonValue::List{core::NumberOrNull(interval.low), core::NumberOrNull(interval.high)});
}

// A double that is not finite becomes null, an interval a list of its ends.
template <typename Value>
core::JsonValue TreeOf(Value&& value) {
  using Plain = std::remove_cvref_t<Value>;
  if constexpr (std::floating_point<Plain>) {
    return core::NumberOrNull(value);
  } else if constexpr (std::same_as<Plain, statistics::Interval>) {
    return EndsOf(value);
  } else {
    return core::JsonValue(std::forward<Value>(value));
  }
}

inline void SetMembers(core::JsonValue&) {}

template <typename Value, typename... Rest>
void SetMembers(core::JsonValue& json, std::string_view name, Value&& value, Rest&&... rest) {
  json.Set(name, TreeOf(std::forward<Value>(value)));
  SetMembers(json, std::forward<Rest>(rest)...);
}

// An object of JSON as tree: each member's name, then its value.
template <typename... Members>
core::JsonValue ObjectTree(Members&&... members) {
  core::JsonValue json = core::JsonValue::Object();
  SetMembers(json, std::forward<Members>(members)...);
  return json;
}

// What is JSON already, for ObjectText. It must outlive the call only.
struct Json {
  std::string_view text;
};

inline void AddMembers(core::JsonObject&) {}

template <typename Value, typename... Rest>
void AddMembers(core::JsonObject& json, std::string_view name, const Value& value,
                const Rest&... rest) {
  if constexpr (std::same_as<Value, Json>) {
    json.Add(name, value.text);
  } else if constexpr (std::convertible_to<Value, std::string_view>) {
    json.AddText(name, value);
  } else if constexpr (std::same_as<Value, bool>) {
    json.AddFlag(name, value);
  } else if constexpr (std::integral<Value>) {
    json.AddInteger(name, static_cast<std::int64_t>(value));
  } else if constexpr (std::floating_point<Value>) {
    json.AddNumber(name, value);
  } else {
    json.Add(name, core::JsonTexts(value));
  }
  AddMembers(json, rest...);
}

// An object of JSON as text: each member's name, then its value. Numbers are as core::JsonNumber
// has them; a list is one of texts.
template <typename... Members>
std::string ObjectText(const Members&... members) {
  core::JsonObject json;
  AddMembers(json, members...);
  return json.Text();
}

// A table. Its columns are named in one text, "id,p_value,verdict". A renderer that is given such a
// text writes these columns, in their order; "low as ci95_low" gives one another name.
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

  // The columns to write, by place, with the names to write.
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
