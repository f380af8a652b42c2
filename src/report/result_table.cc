#include "report/result_table.h"

#include <algorithm>
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

}  // namespace rockyard::report
