#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "core/json_pieces.h"
#include "report/page_data.h"
#include "truth/end_cause.h"

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

// One element for each of the places.
template <typename Element>
std::string ListAt(std::span<const Record> records, std::span<const std::size_t> places,
                   const Element& element) {
  return JsonList(places, [&](std::size_t place) { return element(records[place]); });
}

}  // namespace

std::vector<std::size_t> PageTrials(std::span<const Record> records,
                                    std::span<const std::uint64_t> named) {
  const std::size_t step = (records.size() + kMaxPageTrials - 1) / kMaxPageTrials;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (i % step == 0 || std::binary_search(named.begin(), named.end(), records[i].trial)) {
      places.push_back(i);
    }
  }
  return places;
}

std::string PageEndingsJson(std::span<const Record> records) {
  std::map<std::pair<truth::TrialOutcome, std::string>, std::int64_t> counts;
  for (const Record& record : records) ++counts[{record.outcome, record.detail}];
  std::vector<std::pair<std::int64_t, std::pair<truth::TrialOutcome, std::string>>> endings;
  endings.reserve(counts.size());
  for (const auto& [ending, count] : counts) endings.emplace_back(count, ending);
  std::stable_sort(endings.begin(), endings.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  return JsonList(endings, [](const auto& each) {
    return JsonObject()
        .AddText("outcome", truth::Name(each.second.first))
        .AddText("detail", each.second.second)
        .AddInteger("count", each.first)
        .Add("limit",
             truth::EndedByLimit({0, each.second.first, each.second.second, {}}) ? "true" : "false")
        .Text();
  });
}

std::string PageTrialsJson(const truth::RecordSchema& schema, std::span<const Record> records,
                           std::span<const std::size_t> places) {
  TextTable outcomes;
  TextTable details;
  const auto list = [&](const auto& element) { return ListAt(records, places, element); };
  JsonObject json;
  json.Add("trial", list([](const Record& r) { return std::to_string(r.trial); }));
  json.Add("outcome", list([&](const Record& r) {
             return std::to_string(outcomes.Number(std::string(truth::Name(r.outcome))));
           }));
  json.Add("outcome_names", JsonTexts(outcomes.texts()));
  json.Add("detail",
           list([&](const Record& r) { return std::to_string(details.Number(r.detail)); }));
  json.Add("detail_texts", JsonTexts(details.texts()));
  std::vector<std::string> columns;
  for (std::size_t i = 0; i < schema.size(); ++i) {
    columns.push_back(JsonObject()
                          .AddText("name", schema[i].name)
                          .AddText("unit", schema[i].unit)
                          .Add("values", list([&](const Record& r) {
                                 return i < r.values.size() ? JsonSixDigits(r.values[i])
                                                            : std::string("null");
                               }))
                          .Text());
  }
  json.Add("columns", JsonList(columns));
  return json.Text();
}

}  // namespace rockyard::report
