#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "report/line_text.h"
#include "report/regression_format.h"
#include "report/regression_report.h"
#include "report/xml_text.h"

namespace rockyard::report {

using statistics::RegressionRow;
using statistics::RegressionVerdict;

std::string_view Name(RegressionVerdict verdict) {
  // In the order of RegressionVerdict.
  constexpr std::array<std::string_view, 4> kNames{"changed", "equivalent", "none_seen",
                                                   "inconclusive"};
  return kNames[static_cast<std::size_t>(verdict)];
}

std::string Signed(double value) {
  return std::isfinite(value) ? fmt::format("{:+.4g}", value) : "-";
}

std::string Probability(double p) {
  return p < 1e-4 ? fmt::format("{:.0e}", p) : fmt::format("{:.4f}", p);
}

std::string Label(const RegressionRow& row) {
  return row.cell.empty() ? std::string(row.metric->name)
                          : fmt::format("{}: {}", row.cell, row.metric->name);
}

std::string Sentence(const RegressionRow& row) {
  std::string moved = fmt::format(
      "{} {} by {} {}, from {} to {} (95 % {} to {}, Holm p {}{})", Label(row),
      row.difference < 0.0 ? "fell" : "rose", FourDigits(std::abs(row.difference)),
      row.metric->unit, FourDigits(row.baseline_mean), FourDigits(row.run_mean),
      Signed(row.interval.low), Signed(row.interval.high), Probability(row.holm_p_value),
      std::abs(row.difference) < row.margin ? "; less than its margin" : "");
  if (row.verdict == RegressionVerdict::kChanged) return moved;
  if (row.verdict == RegressionVerdict::kEquivalent) {
    return fmt::format("{}: less than {} {} apart", Label(row), FourDigits(row.margin),
                       row.metric->unit);
  }
  if (row.verdict == RegressionVerdict::kNoneSeen) {
    return fmt::format("{}: {} apart; the run would have seen {} with 80 %, and {} matters",
                       Label(row), Signed(row.difference), FourDigits(row.seen_80),
                       FourDigits(row.to_see));
  }
  if (row.run_count == 0) {
    return fmt::format("{}: the run has no value of it, the baseline has {}", Label(row),
                       row.baseline_count);
  }
  if (!std::isfinite(row.seen_80)) {
    return fmt::format("{}: too few values ({} and {}) to tell anything", Label(row),
                       row.baseline_count, row.run_count);
  }
  return fmt::format(
      "{}: {} apart; the run would have seen {} with 80 %, the margin is {}: about {} trials tell",
      Label(row), Signed(row.difference), FourDigits(row.seen_80), FourDigits(row.margin),
      row.trials_for_margin);
}

std::string Columns(const RecordChanges& changes) {
  constexpr std::size_t kShown = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, changes.columns.size()); ++i) {
    text += fmt::format("{}{} {}", i == 0 ? "" : ", ", changes.columns[i].name,
                        changes.columns[i].trials);
  }
  if (changes.columns.size() > kShown) {
    text += fmt::format(" and {} more", changes.columns.size() - kShown);
  }
  return text;
}

RecordFinding FindingOfRecords(const RegressionReport& report) {
  const auto any = [&](auto holds) {
    return std::any_of(report.cells.begin(), report.cells.end(), holds);
  };
  if (any([](const CheckedCell& cell) { return cell.records.any(); })) {
    return RecordFinding::kChanged;
  }
  const bool apart =
      report.cells.empty() || any([](const CheckedCell& cell) { return cell.records.pairs == 0; });
  return apart ? RecordFinding::kNotComparable : RecordFinding::kSame;
}

std::string_view Name(RecordFinding finding) {
  // In the order of RecordFinding.
  constexpr std::array<std::string_view, 3> kNames{"same", "changed", "not_comparable"};
  return kNames[static_cast<std::size_t>(finding)];
}

std::string_view DistributionName(const statistics::RegressionResult& result) {
  const int code = statistics::ExitCode(result);
  return code == 0 ? "no change" : code == 1 ? "changed" : "inconclusive";
}

std::string NotDeterministic(const CheckedCell& cell) {
  return fmt::format("{}: the baseline's own build, seed and settings gave other records",
                     cell.name.empty() ? "the run" : cell.name);
}

bool BrokenDeterminism(const RegressionReport& report) {
  return std::any_of(report.cells.begin(), report.cells.end(),
                     [](const CheckedCell& cell) { return cell.not_deterministic; });
}

ResultTable RegressionTable(const RegressionReport& report) {
  ResultTable table(
      "cell,metric,unit,verdict,paired,baseline_count,run_count,baseline_mean,run_mean,difference,"
      "difference_low,difference_high,margin,p_value,p_holm,level,p_equivalence,seen_80,seen_90,"
      "trials_for_margin,family,to_see");
  for (const RegressionRow& row : report.result.rows) {
    table.Add(row.cell, row.metric->name, row.metric->unit, Name(row.verdict), row.paired,
              row.baseline_count, row.run_count, row.baseline_mean, row.run_mean, row.difference,
              row.interval, row.margin, row.p_value, row.holm_p_value, row.level,
              row.equivalence_p_value, row.seen_80, row.seen_90, row.trials_for_margin,
              row.primary ? "primary" : "secondary", row.to_see);
  }
  return table;
}

std::string RegressionCsv(const RegressionReport& report) { return RegressionTable(report).Csv(); }

std::string RegressionJUnit(const RegressionReport& report) {
  const auto named = [&](const std::string& cell) { return cell.empty() ? report.baseline : cell; };
  // In the order of RegressionVerdict.
  constexpr std::string_view kElements[] = {"failure", "", "", "skipped"};
  std::vector<JUnitCase> cases;
  for (const CheckedCell& cell : report.cells) {
    if (!cell.not_deterministic) continue;
    cases.push_back({named(cell.name), "determinism", "failure", NotDeterministic(cell)});
  }
  for (const RegressionRow& row : report.result.rows) {
    cases.push_back({named(row.cell), std::string(row.metric->name),
                     kElements[static_cast<std::size_t>(row.verdict)], Sentence(row)});
  }
  return JUnitReport(report.baseline, cases);
}

}  // namespace rockyard::report
