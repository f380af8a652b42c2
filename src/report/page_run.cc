#include <algorithm>

#include "core/json_text.h"
#include "report/json_members.h"
#include "report/page_data.h"
#include "report/paired_comparison.h"
#include "report/parameter_table.h"
#include "report/summary_json.h"
#include "statistics/cell_summary.h"
#include "statistics/clustered_rate.h"
#include "statistics/drive_summary.h"
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

// All where they are few enough. Else both ends, and every step at which the function has grown by
// more than kMin since the one kept before: those growths sum up to no more than 1.
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

}  // namespace rockyard::report
