#include <algorithm>
#include <map>
#include <utility>

#include "report/json_members.h"
#include "report/page_data.h"
#include "truth/end_cause.h"

namespace rockyard::report {
namespace {

using core::JsonList;
using core::JsonSixDigits;

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
    const auto& [outcome, detail] = each.second;
    return ObjectText("outcome", truth::Name(outcome), "detail", detail, "count", each.first,
                      "limit", truth::EndedByLimit({0, outcome, detail, {}}));
  });
}

std::string PageTrialsJson(const truth::RecordSchema& schema, std::span<const Record> records,
                           std::span<const std::size_t> places) {
  TextTable outcomes;
  TextTable details;
  const auto list = [&](const auto& element) { return ListAt(records, places, element); };
  const std::string numbers = list([](const Record& r) { return std::to_string(r.trial); });
  const std::string ends = list([&](const Record& r) {
    return std::to_string(outcomes.Number(std::string(truth::Name(r.outcome))));
  });
  const std::string why =
      list([&](const Record& r) { return std::to_string(details.Number(r.detail)); });
  std::vector<std::string> columns;
  for (std::size_t i = 0; i < schema.size(); ++i) {
    const std::string values = list([&](const Record& r) {
      return i < r.values.size() ? JsonSixDigits(r.values[i]) : std::string("null");
    });
    columns.push_back(
        ObjectText("name", schema[i].name, "unit", schema[i].unit, "values", Json{values}));
  }
  return ObjectText("trial", Json{numbers}, "outcome", Json{ends}, "outcome_names",
                    outcomes.texts(), "detail", Json{why}, "detail_texts", details.texts(),
                    "columns", Json{JsonList(columns)});
}

}  // namespace rockyard::report
