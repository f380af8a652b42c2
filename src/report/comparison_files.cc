#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/numbers.h"
#include "report/comparison_format.h"
#include "report/comparison_table.h"
#include "report/xml_text.h"

namespace rockyard::report {
namespace {

using statistics::ComparedValue;
using statistics::ComparisonResult;
using statistics::PublishedReference;
using statistics::PublishedValue;

// With what must not be missed where rows are read one by one.
std::string Remark(const ComparisonResult& result, const ComparedValue& value) {
  if (result.FindChanged(value.published.scenario) == nullptr) return value.remark;
  return fmt::format("{}{}{}", kNotPublishedCase, value.remark.empty() ? "" : "; ", value.remark);
}

// Test cases that pass hold no message, so that the suite says it.
std::string ChangedXml(const ComparisonResult& result) {
  if (result.changed.empty()) return "";
  std::string xml = "  <properties>\n";
  for (const statistics::OtherSettings& changed : result.changed) {
    for (const std::string& setting : changed.settings) {
      xml += fmt::format("    <property name=\"{}\" value=\"{}\"/>\n",
                         EscapeXml(fmt::format("{}: {}", changed.scenario, kNotPublishedCase)),
                         EscapeXml(setting));
    }
  }
  return xml + "  </properties>\n";
}

}  // namespace

ResultTable ComparisonRows(const ComparisonResult& result, ComparisonDetail detail) {
  const bool full = detail == ComparisonDetail::kFull;
  ResultTable table(
      "id,scenario,what,place,role,unit,published,published_runs,simulated_runs,simulated,"
      "predicted_median,predicted_low,predicted_high,p_value,p_holm,level,power,verdict,"
      "one_layout_p_low,one_layout_p_high,one_layout_measured,remark");
  for (const ComparedValue& v : result.values) {
    const PublishedValue& p = v.published;
    const statistics::Interval layout =
        v.one_layout ? v.one_layout->p_value : statistics::Interval{core::kNaN, core::kNaN};
    const char* measured = !v.one_layout ? "" : (v.one_layout->measured ? "1" : "0");
    table.Add(p.id, p.scenario, p.what, p.place, RoleName(p.role), p.unit, p.value, p.sample_size,
              v.pool, v.pool_value, v.median, v.interval, v.p_value, v.holm_p_value, v.level,
              v.power, statistics::Name(v.verdict), layout, measured,
              full ? Remark(result, v) : v.remark);
    if (!full) continue;
    for (const statistics::SideStatistic& side : v.beside) {
      table.Add(p.id + "/" + side.name, p.scenario, side.name, p.place, RoleName(p.role), p.unit,
                p.value, p.sample_size, v.pool, "", side.median, side.interval, side.p_value);
    }
  }
  return table;
}

std::string ComparisonCsv(const ComparisonResult& result) {
  return ComparisonRows(result, ComparisonDetail::kFull).Csv();
}

std::string ComparisonJUnit(const PublishedReference& reference, const ComparisonResult& result) {
  // In the order of Verdict.
  constexpr std::string_view kElements[] = {"", "", "failure", "skipped", "skipped"};
  std::vector<JUnitCase> cases;
  for (const ComparedValue& value : result.values) {
    cases.push_back(
        {value.published.scenario, value.published.id,
         kElements[static_cast<std::size_t>(value.verdict)],
         fmt::format("{}: published {}, predicted {}, p {}, Holm {}, power {}. {}",
                     statistics::Name(value.verdict), Published(value.published), Prediction(value),
                     PValue(value.p_value), PValue(value.holm_p_value), Power(value.power),
                     Remark(result, value))});
  }
  return JUnitReport(reference.title, cases, ChangedXml(result));
}

}  // namespace rockyard::report
