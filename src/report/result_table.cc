#include "report/result_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "core/check.h"
#include "core/json_text.h"
#include "report/line_text.h"

namespace rockyard::report {
namespace {

std::vector<std::string> SplitColumns(std::string_view columns) {
  std::vector<std::string> names;
  while (!columns.empty()) {
    const std::size_t end = std::min(columns.find(','), columns.size());
    names.emplace_back(columns.substr(0, end));
    columns.remove_prefix(std::min(end + 1, columns.size()));
  }
  return names;
}

}  // namespace

ResultTable::ResultTable(std::string_view columns) : columns_(SplitColumns(columns)) {}

void ResultTable::AddText(std::string_view text) {
  rows_.back().push_back({CsvField(text), core::QuoteJson(text), std::string(text)});
}

void ResultTable::AddCell(std::string csv, std::string json) {
  rows_.back().push_back({csv, std::move(json), csv});
}

ResultTable::Choice ResultTable::Chosen(std::string_view columns) const {
  constexpr std::string_view kAs = " as ";
  Choice choice;
  for (const std::string& each : columns.empty() ? columns_ : SplitColumns(columns)) {
    const std::size_t as = each.find(kAs);
    const auto column = std::find(columns_.begin(), columns_.end(), each.substr(0, as));
    EXPECT(column != columns_.end());
    choice.places.push_back(static_cast<std::size_t>(column - columns_.begin()));
    choice.names.push_back(as == std::string::npos ? each : each.substr(as + kAs.size()));
  }
  return choice;
}

std::string ResultTable::Csv(std::string_view columns) const {
  const Choice choice = Chosen(columns);
  std::string csv = CsvLine(choice.names);
  for (const std::vector<Cell>& row : rows_) {
    for (const std::size_t& place : choice.places) {
      if (&place != choice.places.data()) csv += ',';
      if (place < row.size()) csv += row[place].csv;
    }
    csv += '\n';
  }
  return csv;
}

std::string ResultTable::Json(std::string_view columns) const {
  const Choice choice = Chosen(columns);
  return core::JsonList(rows_, [&](const std::vector<Cell>& row) {
    core::JsonObject object;
    for (std::size_t i = 0; i < choice.places.size(); ++i) {
      const std::size_t place = choice.places[i];
      object.Add(choice.names[i], place < row.size() ? row[place].json : "null");
    }
    return object.Text();
  });
}

std::string ResultTable::Markdown(std::string_view columns) const {
  const Choice choice = Chosen(columns);
  std::string head = "|";
  std::string rule = "|";
  for (const std::string& name : choice.names) {
    head += " " + name + " |";
    rule += "---|";
  }
  std::string table = head + "\n" + rule + "\n";
  for (const std::vector<Cell>& row : rows_) {
    table += "|";
    for (const std::size_t& place : choice.places) {
      const std::string_view code = &place == choice.places.data() ? "`" : "";
      table.append(" ").append(code).append(Printable(row[place].text)).append(code).append(" |");
    }
    table += "\n";
  }
  return table;
}

namespace {

bool IsNumber(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const std::from_chars_result result =
      std::from_chars(text.data(), text.data() + text.size(), value);
  return result.ptr == text.data() + text.size() && result.ec == std::errc();
}

bool NeedsApostrophe(std::string_view text) {
  if (text.starts_with('\'')) return true;
  const bool begins = std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos;
  return begins && text.size() > 1 && !IsNumber(text);
}

}  // namespace

std::string CsvNumber(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : std::string();
}

std::string CsvField(std::string_view text) {
  if (text.empty()) return {};
  const std::string_view before = NeedsApostrophe(text) ? "'" : "";
  if (text.find_first_of(",\"\n\r") == std::string_view::npos) {
    return std::string(before) + std::string(text);
  }
  std::string quoted = '"' + std::string(before);
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

void CsvRow::AddField(std::string_view field) {
  if (!empty_) text_ += ',';
  empty_ = false;
  text_ += field;
}

}  // namespace rockyard::report
