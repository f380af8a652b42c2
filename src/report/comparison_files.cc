#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "report/comparison_format.h"
#include "report/comparison_table.h"
#include "report/csv.h"
#include "report/xml_text.h"

namespace rockyard::report {
namespace {

using statistics::ComparedValue;
using statistics::ComparisonResult;
using statistics::PublishedReference;
using statistics::PublishedValue;
using statistics::Verdict;

constexpr std::size_t kComparisonColumns = 22;

// Fields that may hold any text, joined.
std::string Line(std::vector<std::string> fields) {
  for (std::string& field : fields) field = CsvField(field);
  return CsvLine(fields);
}

// With what must not be missed where rows are read one by one.
std::string Remark(const ComparisonResult& result, const ComparedValue& value) {
  if (result.FindChanged(value.published.scenario) == nullptr) return value.remark;
  return fmt::format("{}{}{}", kNotPublishedCase, value.remark.empty() ? "" : "; ", value.remark);
}

std::string ValueLine(const ComparedValue& v, const std::string& remark) {
  const PublishedValue& p = v.published;
  const bool layout = v.one_layout.has_value();
  const char* measured = !layout ? "" : (v.one_layout->measured ? "1" : "0");
  return Line({p.id,
               p.scenario,
               p.what,
               p.place,
               std::string(RoleName(p.role)),
               p.unit,
               CsvNumber(p.value),
               fmt::format("{}", p.sample_size),
               fmt::format("{}", v.pool),
               CsvNumber(v.pool_value),
               CsvNumber(v.median),
               CsvNumber(v.interval.low),
               CsvNumber(v.interval.high),
               CsvNumber(v.p_value),
               CsvNumber(v.holm_p_value),
               CsvNumber(v.level),
               CsvNumber(v.power),
               statistics::Name(v.verdict),
               layout ? CsvNumber(v.one_layout->p_value.low) : "",
               layout ? CsvNumber(v.one_layout->p_value.high) : "",
               measured,
               remark});
}

// Another reading of the same value: the columns that it has, the others empty.
std::string SideLine(const ComparedValue& v, const statistics::SideStatistic& side) {
  const PublishedValue& p = v.published;
  std::vector<std::string> fields{p.id + "/" + side.name,
                                  p.scenario,
                                  side.name,
                                  p.place,
                                  std::string(RoleName(p.role)),
                                  p.unit,
                                  CsvNumber(p.value),
                                  fmt::format("{}", p.sample_size),
                                  fmt::format("{}", v.pool),
                                  "",
                                  CsvNumber(side.median),
                                  CsvNumber(side.interval.low),
                                  CsvNumber(side.interval.high),
                                  CsvNumber(side.p_value)};
  fields.resize(kComparisonColumns);
  return Line(std::move(fields));
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

std::string ComparisonCsv(const ComparisonResult& result) {
  std::string csv =
      "id,scenario,what,place,role,unit,published,published_runs,simulated_runs,simulated,"
      "predicted_median,predicted_low,predicted_high,p_value,p_holm,level,power,verdict,"
      "one_layout_p_low,one_layout_p_high,one_layout_measured,remark\n";
  for (const ComparedValue& value : result.values) {
    csv += ValueLine(value, Remark(result, value));
    for (const statistics::SideStatistic& side : value.beside) csv += SideLine(value, side);
  }
  return csv;
}

std::string ComparisonJUnit(const PublishedReference& reference, const ComparisonResult& result) {
  const std::size_t differs = CountOf(result, Verdict::kDiffers);
  const std::size_t skipped =
      CountOf(result, Verdict::kUnderpowered) + CountOf(result, Verdict::kNotJudged);
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  xml += fmt::format("<testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" skipped=\"{}\">\n",
                     EscapeXml(reference.title), result.values.size(), differs, skipped);
  xml += ChangedXml(result);
  for (const ComparedValue& value : result.values) {
    const std::string message =
        EscapeXml(fmt::format("{}: published {}, predicted {}, p {}, Holm {}, power {}. {}",
                              statistics::Name(value.verdict), Published(value.published),
                              Prediction(value), PValue(value.p_value), PValue(value.holm_p_value),
                              Power(value.power), Remark(result, value)));
    xml += fmt::format("  <testcase classname=\"{}\" name=\"{}\"",
                       EscapeXml(value.published.scenario), EscapeXml(value.published.id));
    switch (value.verdict) {
      case Verdict::kAgrees:
      case Verdict::kHolds:
        xml += "/>\n";
        break;
      case Verdict::kDiffers:
        xml += fmt::format(">\n    <failure message=\"{}\"/>\n  </testcase>\n", message);
        break;
      case Verdict::kUnderpowered:
      case Verdict::kNotJudged:
        xml += fmt::format(">\n    <skipped message=\"{}\"/>\n  </testcase>\n", message);
        break;
    }
  }
  return xml + "</testsuite>\n";
}

}  // namespace rockyard::report
