#include <fmt/format.h>

#include <iterator>
#include <map>

#include "report/page_data.h"
#include "report/page_json.h"

namespace rockyard::report {
namespace {

using truth::Record;

// Texts by number, in the order in which they were met first.
class TextTable {
 public:
  std::size_t Number(const std::string& text) {
    const auto [at, fresh] = known_.try_emplace(text, texts_.size());
    if (fresh) texts_.push_back(text);
    return at->second;
  }
  const std::vector<std::string>& texts() const { return texts_; }

 private:
  std::map<std::string, std::size_t> known_;
  std::vector<std::string> texts_;
};

// [a,b,...] of one value for each record.
template <typename Value>
std::string PerRecord(std::span<const Record> records, const Value& value) {
  std::string list(1, '[');
  for (const Record& record : records) {
    if (list.size() > 1) list += ',';
    list += value(record);
  }
  return list + ']';
}

std::string Column(const truth::ValueInfo& info, std::size_t index,
                   std::span<const Record> records) {
  return JsonObject()
      .AddText("name", info.name)
      .AddText("unit", info.unit)
      .Add("values", PerRecord(records,
                               [&](const Record& record) {
                                 return index < record.values.size()
                                            ? JsonSixDigits(record.values[index])
                                            : std::string("null");
                               }))
      .Text();
}

}  // namespace

std::string PageTrialsJson(const truth::RecordSchema& schema, std::span<const Record> records) {
  TextTable outcomes;
  TextTable details;
  JsonObject json;
  json.Add("trial", PerRecord(records, [](const Record& r) { return std::to_string(r.trial); }));
  json.Add("outcome", PerRecord(records, [&](const Record& r) {
             return std::to_string(outcomes.Number(std::string(truth::Name(r.outcome))));
           }));
  json.Add("outcome_names", JsonTexts(outcomes.texts()));
  json.Add("detail", PerRecord(records, [&](const Record& r) {
             return std::to_string(details.Number(r.detail));
           }));
  json.Add("detail_texts", JsonTexts(details.texts()));
  std::vector<std::string> columns;
  for (std::size_t i = 0; i < schema.size(); ++i) columns.push_back(Column(schema[i], i, records));
  json.Add("columns", JsonList(columns));
  return json.Text();
}

}  // namespace rockyard::report
