// Runs and their trials on the report page (page_data.h).
#include <algorithm>
#include <map>
#include <utility>

#include "core/json_text.h"
#include "report/page_data.h"
#include "report/paired_comparison.h"
#include "report/parameter_table.h"
#include "report/result_table.h"
#include "report/summary_json.h"
#include "statistics/cell_summary.h"
#include "statistics/clustered_rate.h"
#include "statistics/drive_summary.h"
#include "truth/end_cause.h"
#include "truth/measurement_record.h"

namespace rockyard::report {
namespace {

using core::JsonList;
using core::JsonSixDigits;

core::JsonValue Summary(const PageRun& run, statistics::IntervalMethod method) {
  const std::int64_t planned = run.description.planned;
  if (truth::IsMeasurement(run.schema)) {
    return MeasurementValue(run.description,
                            statistics::SummarizeCells(run.schema, run.prefix, planned, method));
  }
  return SummaryValue(run.description,
                      statistics::Summarize(run.schema, run.prefix, planned, method));
}

std::string Index(const std::optional<std::size_t>& index) {
  return index ? std::to_string(*index) : "null";
}

// What tells the cells of a measurement apart; nothing for drives.
std::vector<std::string> Factors(const truth::RecordSchema& schema) {
  std::vector<std::string> names;
  for (const truth::ValueInfo& info : schema) {
    if (info.role == truth::ColumnRole::kFactor) names.push_back(info.name);
  }
  return names;
}

// Returns the places of the steps that the page keeps: all where they are few enough; else both
// ends, and every step at which the function has grown by more than kMin since the one kept before.
// These growths sum up to no more than 1.
std::vector<std::size_t> KeptSteps(std::span<const DistanceStep> steps) {
  constexpr double kMin = 1.0 / static_cast<double>(kMaxPageSteps - 2);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool grown =
        kept.empty() || steps[i].all.fraction - steps[kept.back()].all.fraction > kMin;
    if (steps.size() <= kMaxPageSteps || grown || i + 1 == steps.size()) kept.push_back(i);
  }
  return kept;
}

}  // namespace

std::string PageCdfJson(std::span<const DistanceStep> steps) {
  if (steps.empty()) return "null";
  const std::vector<std::size_t> kept = KeptSteps(steps);
  core::JsonObject json;
  for (const std::size_t column : {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}) {
    json.Add(kDistanceColumns[column], JsonList(kept, [&](std::size_t step) {
               return JsonSixDigits(DistanceNumbers(steps[step])[column]);
             }));
  }
  return json.Text();
}

std::vector<core::ParameterInfo> OtherParameters(std::span<const core::ParameterInfo> parameters,
                                                 std::span<const core::ParameterInfo> of) {
  const bool same = std::equal(parameters.begin(), parameters.end(), of.begin(), of.end(),
                               [](const auto& a, const auto& b) { return a.path == b.path; });
  std::vector<core::ParameterInfo> others;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (same && ParameterValue(parameters[i]) == ParameterValue(of[i])) continue;
    others.push_back(parameters[i]);
  }
  return others;
}

std::string PageParametersJson(std::span<const core::ParameterInfo> parameters) {
  return ParameterColumns(parameters).Json("path,value,unit,origin,range,source,doc");
}

std::string PageReplaysJson(std::span<const PageLink> links) {
  core::JsonObject json;
  for (const PageLink& link : links) json.AddText(std::to_string(link.trial), link.link);
  return json.Text();
}

core::JsonObject PageRunMembers(const PageRun& run, statistics::IntervalMethod method) {
  const bool measures = truth::IsMeasurement(run.schema);
  std::vector<DistanceStep> steps;
  if (!measures) steps = DistanceSteps(run.schema, run.prefix);
  const std::vector<std::size_t> places = PageTrials(run.records, run.named);
  core::JsonObject json;
  AddMembers(json, "label", run.label, "folder", run.folder, "cell", run.cell, "sweep",
             Json{Index(run.sweep)}, "kind", measures ? "measurement" : "drive", "summary",
             Json{core::CompactJson(Summary(run, method))}, "trials",
             Json{PageTrialsJson(run.schema, run.records, places)}, "stored_trials",
             run.records.size(), "prefix_trials", run.prefix.size(), "shared_layouts",
             !statistics::DependentGroups(run.schema, run.prefix).empty(), "endings",
             Json{PageEndingsJson(run.prefix)}, "course",
             Json{run.course ? PageCourseJson(*run.course) : "null"}, "cdf",
             Json{PageCdfJson(steps)}, "cdf_steps", steps.size(), "factors",
             measures ? Factors(run.schema) : std::vector<std::string>(), "published",
             Json{run.published}, "parameters", Json{PageParametersJson(run.parameters)},
             "parameters_as", Json{Index(run.parameters_as)}, "replay_command", run.replay_command);
  return json;
}

std::string PageJson(const PageHead& head, std::span<const std::string> runs,
                     std::span<const std::string> sweeps,
                     std::span<const std::string> comparisons) {
  return ObjectText("version", 1, "title", head.title, "command", head.command,
                    "why_none_published", head.why_none_published, "provenance",
                    Json{core::CompactJson(ProvenanceJson(head.provenance))}, "runs",
                    Json{JsonList(runs)}, "sweeps", Json{JsonList(sweeps)}, "comparisons",
                    Json{JsonList(comparisons)});
}

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
    core::JsonObject column;
    AddMembers(column, "name", schema[i].name, "unit", schema[i].unit);
    // The page knows what the others are.
    if (truth::IsOwnColumn(schema[i].name)) column.AddText("meaning", schema[i].meaning);
    columns.push_back(column.Add("values", values).Text());
  }
  return ObjectText("trial", Json{numbers}, "outcome", Json{ends}, "outcome_names",
                    outcomes.texts(), "detail", Json{why}, "detail_texts", details.texts(),
                    "columns", Json{JsonList(columns)});
}

}  // namespace rockyard::report
