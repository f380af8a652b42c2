#include "report/comparison_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/numbers.h"
#include "core/text.h"
#include "report/line_text.h"
#include "report/reference_fields.h"
#include "report/xml_text.h"

namespace rockyard::report {
namespace {

using statistics::ComparedValue;
using statistics::ComparisonResult;
using statistics::Interval;
using statistics::PublishedReference;
using statistics::PublishedValue;
using statistics::ValueRole;
using statistics::Verdict;

constexpr std::size_t kWidth = 100;
constexpr std::size_t kRemarkIndent = 6;

// What the columns show by marks and indents.
constexpr const char* kMarks =
    "c: conditional on error sizes that the publication states as inputs. k: the simulation was "
    "calibrated with these runs or their like. Indented: other readings, shown and not judged, "
    "among them sets of which as many runs arrived as of the published ones.";

char RoleMark(ValueRole role) {
  switch (role) {
    case ValueRole::kConditional:
      return 'c';
    case ValueRole::kCalibration:
      return 'k';
    case ValueRole::kPrediction:
      break;
  }
  return ' ';
}

std::string What(const PublishedValue& value) {
  const bool has_unit = !IsCount(value) && std::isfinite(value.value) && value.unit != "1";
  return has_unit ? fmt::format("{} [{}]", value.what, value.unit) : value.what;
}

// Words in lines of at most kWidth, each line indented.
std::string Wrap(const std::string& text, std::size_t indent) {
  std::istringstream words(text);
  std::string result;
  std::string line(indent, ' ');
  std::string word;
  while (words >> word) {
    const bool first = line.size() == indent;
    if (!first && line.size() + 1 + word.size() > kWidth) {
      result += line + "\n";
      line = std::string(indent, ' ') + word;
    } else {
      line += (first ? "" : " ") + word;
    }
  }
  return result + line + "\n";
}

std::string Line(char mark, const std::string& what, const std::string& published,
                 const std::string& predicted, const std::string& p, const std::string& holm,
                 const std::string& power, const std::string& verdict) {
  std::string line = fmt::format("{} {:<31.31} {:>9} {:>23} {:>6} {:>6} {:>5} {}", mark,
                                 Printable(what), published, predicted, p, holm, power, verdict);
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string Details(const ComparedValue& value) {
  std::string text;
  for (const auto& side : value.beside) {
    text += Line(' ', "    " + side.name, "", Prediction(value, side), PValue(side.p_value), "", "",
                 "");
  }
  for (const std::string& remark : Remarks(value)) text += Wrap(remark, kRemarkIndent);
  return text;
}

std::string Row(const ComparedValue& value) {
  const PublishedValue& published = value.published;
  return Line(RoleMark(published.role), What(published), Published(published), Prediction(value),
              PValue(value.p_value), PValue(value.holm_p_value), Power(value.power),
              statistics::Name(value.verdict)) +
         Details(value);
}

// Says where the run is not the published case, which a reader must not miss: it stands between the
// name of a scenario and its rows.
std::string Changed(const ComparisonResult& result, std::string_view scenario) {
  const statistics::OtherSettings* changed = result.FindChanged(scenario);
  if (changed == nullptr) return "";
  std::string text = Wrap(std::string(kNotPublishedCase) + ":", 2);
  for (const std::string& setting : changed->settings) text += Wrap(setting, 4);
  return text;
}

std::string Footnotes(const ComparisonResult& result) {
  std::vector<std::string> notes = ComparisonNotes(result);
  // kMarks stands behind what columns and verdicts mean, which ComparisonNotes says in its first
  // three.
  notes.insert(notes.begin() + 3, kMarks);
  std::string text;
  for (const std::string& note : notes) text += Wrap(note, 0);
  return text;
}

std::vector<std::string> Scenarios(const ComparisonResult& result) {
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const ComparedValue& value : result.values) {
    if (seen.insert(value.published.scenario).second) names.push_back(value.published.scenario);
  }
  return names;
}

// Says how many values are computed: arithmetic that agrees with a publication says nothing about
// the simulation.
std::string ComputedAmongThem(const ComparisonResult& result) {
  const auto computed =
      std::count_if(result.values.begin(), result.values.end(), [](const ComparedValue& value) {
        return value.published.statistic == statistics::StatisticKind::kComputed;
      });
  return computed == 0 ? "" : fmt::format("; {} of them computed, not simulated", computed);
}

}  // namespace

std::vector<std::string> ComparisonNotes(const ComparisonResult& result) {
  const statistics::ComparisonOptions& options = result.options;
  std::vector<std::string> notes{
      "published: successes of runs, or the printed number. predicted: median and 95 % interval "
      "for a new set of the published size, the simulation's own uncertainty included.",
      "p: two-sided, that the published and the simulated runs follow one law. Holm: adjusted for "
      "the family. power: chance to see a success rate 0.20 lower (other counts: 0.20 nearer to "
      "one half; other numbers: a shift by half a standard deviation, and where a number has a "
      "lower limit a change of scale as large, whichever is hardest to see) at the level that "
      "Holm grants.",
      "agrees: not rejected, and power 0.8 or more. holds: a bound or arithmetic that any "
      "simulation "
      "meets. differs: Holm at or below alpha; of counts, for runs on rock layouts that are "
      "independent. underpowered: not rejected, but too few published runs to tell. not judged: no "
      "number, or no simulated trials."};
  if (std::any_of(result.values.begin(), result.values.end(), [](const ComparedValue& value) {
        return statistics::HasTolerance(value.published.statistic);
      })) {
    notes.emplace_back(
        "Numbers with a tolerance: the simulated value and its interval, all such intervals "
        "together 95 % (Bonferroni). agrees: inside of the tolerance. differs: apart from it. "
        "underpowered: across an end of it. Computed numbers are points: they hold or differ.");
  }
  notes.push_back(
      fmt::format("{} p-values in Holm's family, alpha {}, {} samples for each, seed {}. A bound "
                  "is judged without a p-value.",
                  result.family, options.alpha, options.replicates, options.seed));
  return notes;
}

std::string ComparisonText(const PublishedReference& reference, const ComparisonResult& result) {
  std::string text = Printable(reference.title) + " against simulated trials\n\n";
  text += Line(' ', "number", "published", "predicted (95 %)", "p", "Holm", "power", "verdict");
  for (const std::string& scenario : Scenarios(result)) {
    text +=
        (scenario.empty() ? "computed" : Printable(scenario)) + "\n" + Changed(result, scenario);
    for (const ComparedValue& value : result.values) {
      if (value.published.scenario == scenario) text += Row(value);
    }
  }
  text += fmt::format("\n{} agree, {} hold, {} differ, {} underpowered, {} not judged{}\n\n",
                      CountOf(result, Verdict::kAgrees), CountOf(result, Verdict::kHolds),
                      CountOf(result, Verdict::kDiffers), CountOf(result, Verdict::kUnderpowered),
                      CountOf(result, Verdict::kNotJudged), ComputedAmongThem(result));
  for (const statistics::OtherSettings& changed : result.changed) {
    text += Wrap(fmt::format("{} is {}", changed.scenario, kNotPublishedCase), 0) + "\n";
  }
  return text + Footnotes(result);
}

namespace {

// Whether dependence through the layout alone could have made the difference: the p-value under it
// may lie above the level that the row was judged at.
bool DiffersByLayoutsAlone(const statistics::ComparedValue& value) {
  return value.verdict == statistics::Verdict::kDiffers && value.one_layout &&
         value.one_layout->p_value.high > value.level;
}

std::string OneLayoutRemark(const statistics::OneLayout& layout) {
  const std::string low = PValue(layout.p_value.low);
  const std::string high = PValue(layout.p_value.high);
  const std::string_view basis = layout.measured ? "from repeated layouts" : "bounds";
  return low == high ? fmt::format("one rock layout for all runs of the set: p {} ({})", low, basis)
                     : fmt::format("one rock layout for all runs of the set: p from {} to {} ({})",
                                   low, high, basis);
}

}  // namespace

using statistics::StatisticKind;

std::string Number(double value) {
  if (!std::isfinite(value)) return "-";
  if (value == 0.0) return "0";
  const double magnitude = std::abs(value);
  if (magnitude >= 100.0) return fmt::format("{:.0f}", value);
  if (magnitude >= 10.0) return fmt::format("{:.1f}", value);
  return fmt::format("{:.2f}", value);
}

std::string PValue(double p) {
  if (!std::isfinite(p)) return "-";
  if (p >= 0.9995) return "1";
  return p >= 0.001 ? fmt::format("{:.3f}", p) : fmt::format("{:.0e}", p);
}

std::string Power(double power) {
  return std::isfinite(power) ? fmt::format("{:.2f}", power) : "-";
}

bool IsCount(const PublishedValue& value) {
  return value.statistic == StatisticKind::kOutcomeCount ||
         value.statistic == StatisticKind::kNegativeCount;
}

std::string Published(const PublishedValue& value) {
  if (IsCount(value)) return fmt::format("{:.0f}/{}", value.value, value.sample_size);
  if (value.statistic == StatisticKind::kFailureKinds)
    return fmt::format("of {}", value.sample_size);
  if (value.statistic == StatisticKind::kExponentialTail) return "yes";
  if (!std::isfinite(value.value)) return "stated";
  if (statistics::HasTolerance(value.statistic)) return fmt::format("{:.4g}", value.value);
  const double step = value.rounding > 0.0 ? value.rounding : 0.01;
  const int digits = std::clamp(static_cast<int>(std::lround(-std::log10(step))), 0, 6);
  const std::string number = fmt::format("{:.{}f}", value.value, digits);
  return value.statistic == StatisticKind::kLowerBound ? ">= " + number : number;
}

std::string Prediction(double median, const Interval& interval, bool count) {
  if (!std::isfinite(median)) return "-";
  if (count) return fmt::format("{:.0f} ({:.0f} .. {:.0f})", median, interval.low, interval.high);
  return fmt::format("{} ({} .. {})", Number(median), Number(interval.low), Number(interval.high));
}

std::string Prediction(const ComparedValue& value) {
  if (!statistics::HasTolerance(value.published.statistic)) {
    return Prediction(value.median, value.interval, IsCount(value.published));
  }
  if (!std::isfinite(value.pool_value)) return "-";
  if (value.interval.low == value.interval.high) return fmt::format("{:.4g}", value.pool_value);
  return fmt::format("{:.3g} ({:.3g} .. {:.3g})", value.pool_value, value.interval.low,
                     value.interval.high);
}

std::string Prediction(const ComparedValue& value, const statistics::SideStatistic& beside) {
  if (!statistics::HasTolerance(value.published.statistic)) {
    return Prediction(beside.median, beside.interval, IsCount(value.published));
  }
  return fmt::format("{:.3g} ({:.3g} .. {:.3g})", beside.median, beside.interval.low,
                     beside.interval.high);
}

std::vector<std::string> Remarks(const ComparedValue& value) {
  std::vector<std::string> remarks;
  for (const statistics::KindPrediction& kind : value.kinds) {
    remarks.push_back(fmt::format("{}: {} published, {} of {} simulated failures", kind.name,
                                  kind.published, kind.simulated, value.pool));
  }
  if (value.one_layout) remarks.push_back(OneLayoutRemark(*value.one_layout));
  if (DiffersByLayoutsAlone(value)) {
    remarks.emplace_back(
        "differs if the runs of the set met layouts of their own; if they all met one, this says "
        "nothing against the simulation");
  }
  if (!value.remark.empty()) remarks.push_back(value.remark);
  return remarks;
}

std::string_view RoleName(ValueRole role) {
  return core::EnumNames<ValueRole>::kNames[static_cast<std::size_t>(role)];
}

std::size_t CountOf(const ComparisonResult& result, Verdict verdict) {
  return static_cast<std::size_t>(
      std::count_if(result.values.begin(), result.values.end(),
                    [&](const ComparedValue& value) { return value.verdict == verdict; }));
}

namespace {

// Returns the remark of a value, with what must not be missed where rows are read one by one.
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
      xml +=
          fmt::format("    <property name=\"{}\" value=\"{}\"/>\n",
                      core::EscapeXml(fmt::format("{}: {}", changed.scenario, kNotPublishedCase)),
                      core::EscapeXml(setting));
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
  // Must stay in the order of Verdict.
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
