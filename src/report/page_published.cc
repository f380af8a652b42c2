#include <fmt/format.h>

#include <string>
#include <vector>

#include "core/json_pieces.h"
#include "report/comparison_format.h"
#include "report/comparison_table.h"
#include "report/page_data.h"

namespace rockyard::report {
namespace {

using core::JsonList;
using core::JsonObject;
using core::JsonTexts;

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
  return JsonObject()
      .AddText("id", published.id)
      .AddText("what", published.what)
      .AddText("unit", IsCount(published) ? "1" : published.unit)
      .AddText("published", Published(published))
      .AddNumber("published_value", Share(published.value, published))
      .AddText("predicted", Prediction(value))
      .AddNumber("predicted_value", Share(predicted, published))
      .AddNumber("predicted_low", Share(value.interval.low, published))
      .AddNumber("predicted_high", Share(value.interval.high, published))
      .AddNumber("p_holm", value.holm_p_value)
      .AddNumber("power", value.power)
      .AddText("verdict", statistics::Name(value.verdict))
      .AddText("source", source)
      .Add("remarks", JsonTexts(AllRemarks(value)))
      .Text();
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
  return JsonObject()
      .AddText("reference", reference.title)
      .AddText("citation", reference.citation)
      .Add("notes", JsonTexts(notes))
      .Add("settings",
           JsonTexts(changed == nullptr ? std::vector<std::string>() : changed->settings))
      .Add("rows", JsonList(rows))
      .Text();
}

}  // namespace rockyard::report
