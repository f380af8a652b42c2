#include <fmt/format.h>

#include <string>
#include <vector>

#include "report/comparison_format.h"
#include "report/comparison_table.h"
#include "report/json_members.h"
#include "report/page_data.h"

namespace rockyard::report {
namespace {

using core::JsonList;

using statistics::ComparedValue;
using statistics::PublishedValue;

// As a share of its runs for a count, so that it can be drawn beside a rate.
double Share(double value, const PublishedValue& published) {
  return IsCount(published) ? value / static_cast<double>(published.sample_size) : value;
}

// With the other readings that the terminal's table shows below a row.
std::vector<std::string> AllRemarks(const ComparedValue& value) {
  std::vector<std::string> remarks = Remarks(value);
  for (const statistics::SideStatistic& side : value.beside) {
    remarks.push_back(
        fmt::format("{}: {}, p {}", side.name, Prediction(value, side), PValue(side.p_value)));
  }
  return remarks;
}

std::string JsonRow(const ComparedValue& value) {
  const PublishedValue& published = value.published;
  const bool tolerance = statistics::HasTolerance(published.statistic);
  const double predicted = tolerance ? value.pool_value : value.median;
  std::string source = published.place;
  if (published.role != statistics::ValueRole::kPrediction) {
    source += "; " + std::string(RoleName(published.role));
  }
  if (!published.note.empty()) source += "; " + published.note;
  return ObjectText(
      "id", published.id, "what", published.what, "unit", IsCount(published) ? "1" : published.unit,
      "published", Published(published), "published_value", Share(published.value, published),
      "predicted", Prediction(value), "predicted_value", Share(predicted, published),
      "predicted_low", Share(value.interval.low, published), "predicted_high",
      Share(value.interval.high, published), "p_holm", value.holm_p_value, "power", value.power,
      "verdict", statistics::Name(value.verdict), "source", source, "remarks", AllRemarks(value));
}

}  // namespace

std::string PublishedJson(const statistics::PublishedReference& reference,
                          const statistics::ComparisonResult& result, std::string_view scenario) {
  std::vector<std::string> rows;
  for (const ComparedValue& value : result.values) {
    if (value.published.scenario == scenario) rows.push_back(JsonRow(value));
  }
  if (rows.empty()) return "null";
  std::vector<std::string> notes = ComparisonNotes(result);
  notes.emplace_back(
      "Holm's family is that of this run alone: other runs on the page do not change it, and "
      "`rockyard check` of several runs takes all of them as one.");
  const statistics::OtherSettings* changed = result.FindChanged(scenario);
  return ObjectText("reference", reference.title, "citation", reference.citation, "notes", notes,
                    "settings", changed == nullptr ? std::vector<std::string>() : changed->settings,
                    "rows", Json{JsonList(rows)});
}

}  // namespace rockyard::report
