#include <fmt/format.h>

#include <iterator>
#include <map>

#include "core/json_pieces.h"
#include "report/page_data.h"

namespace rockyard::report {
namespace {

using core::JsonList;
using core::JsonObject;
using core::JsonSixDigits;
using core::JsonTexts;

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

std::string Column(const truth::ValueInfo& info, std::size_t index,
                   std::span<const Record> records) {
  return JsonObject()
      .AddText("name", info.name)
      .AddText("unit", info.unit)
      .Add("values", JsonList(records,
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
  json.Add("trial", JsonList(records, [](const Record& r) { return std::to_string(r.trial); }));
  json.Add("outcome", JsonList(records, [&](const Record& r) {
             return std::to_string(outcomes.Number(std::string(truth::Name(r.outcome))));
           }));
  json.Add("outcome_names", JsonTexts(outcomes.texts()));
  json.Add("detail", JsonList(records, [&](const Record& r) {
             return std::to_string(details.Number(r.detail));
           }));
  json.Add("detail_texts", JsonTexts(details.texts()));
  std::vector<std::string> columns;
  for (std::size_t i = 0; i < schema.size(); ++i) columns.push_back(Column(schema[i], i, records));
  json.Add("columns", JsonList(columns));
  return json.Text();
}

}  // namespace rockyard::report
