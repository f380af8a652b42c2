#include "report/regression_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "report/line_text.h"
#include "report/xml_text.h"

namespace rockyard::report {

using statistics::RegressionRow;
using statistics::RegressionVerdict;

std::string_view Name(RegressionVerdict verdict) {
  // Must stay in the order of RegressionVerdict.
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
  return row.cell.empty() ? row.metric.name : fmt::format("{}: {}", row.cell, row.metric.name);
}

std::string Sentence(const RegressionRow& row) {
  std::string moved = fmt::format(
      "{} {} by {} {}, from {} to {} (95 % {} to {}, Holm p {}{})", Label(row),
      row.difference < 0.0 ? "fell" : "rose", FourDigits(std::abs(row.difference)), row.metric.unit,
      FourDigits(row.baseline_mean), FourDigits(row.run_mean), Signed(row.interval.low),
      Signed(row.interval.high), Probability(row.holm_p_value),
      std::abs(row.difference) < row.margin ? "; less than its margin" : "");
  if (row.verdict == RegressionVerdict::kChanged) return moved;
  if (row.verdict == RegressionVerdict::kEquivalent) {
    return fmt::format("{}: less than {} {} apart", Label(row), FourDigits(row.margin),
                       row.metric.unit);
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
  // Must stay in the order of RecordFinding.
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
    table.Add(row.cell, row.metric.name, row.metric.unit, Name(row.verdict), row.paired,
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
  // Must stay in the order of RegressionVerdict.
  constexpr std::string_view kElements[] = {"failure", "", "", "skipped"};
  std::vector<JUnitCase> cases;
  for (const CheckedCell& cell : report.cells) {
    if (!cell.not_deterministic) continue;
    cases.push_back({named(cell.name), "determinism", "failure", NotDeterministic(cell)});
  }
  for (const RegressionRow& row : report.result.rows) {
    cases.push_back({named(row.cell), row.metric.name,
                     kElements[static_cast<std::size_t>(row.verdict)], Sentence(row)});
  }
  return JUnitReport(report.baseline, cases);
}

namespace {

std::string NameOf(const CheckedCell& cell) {
  return cell.name.empty() ? "the run" : Printable(cell.name);
}

std::string CellLine(const CheckedCell& cell) {
  std::string how;
  if (cell.identical) {
    how = fmt::format("identical: {} trials, every bit", cell.run_trials);
  } else if (cell.paired) {
    how = fmt::format("{} pairs with the baseline's trials (seed {})", cell.records.pairs,
                      cell.run_seed);
  } else {
    how = fmt::format("{} trials (seed {}) against {} (seed {}){}", cell.run_trials, cell.run_seed,
                      cell.baseline_trials, cell.baseline_seed,
                      cell.same_fields ? "" : ", other fields");
  }
  return fmt::format("  {:<30} {}\n", NameOf(cell), how);
}

// The finding on records.
std::string Records(const RegressionReport& report) {
  const RecordFinding finding = FindingOfRecords(report);
  if (finding == RecordFinding::kSame) {
    const bool every_bit = std::all_of(report.cells.begin(), report.cells.end(),
                                       [](const CheckedCell& cell) { return cell.identical; });
    return every_bit ? "\nrecords: the same in every bit\n"
                     : "\nrecords: the same, as far as the baseline keeps them\n";
  }
  if (finding == RecordFinding::kNotComparable) {
    return "\nrecords: not comparable, since other seeds or fields meet other trials\n";
  }
  std::string text = "\nrecords: changed\n";
  for (const CheckedCell& cell : report.cells) {
    if (!cell.records.any()) continue;
    text +=
        fmt::format("  {}: {}\n", NameOf(cell),
                    cell.records.only_hash
                        ? "another hash; last digits, or columns that the baseline does not keep"
                        : fmt::format("{} of {} trials: {}", cell.records.trials,
                                      cell.records.pairs, Columns(cell.records)));
  }
  return text;
}

std::string Counted(const statistics::RegressionResult& result, bool primary) {
  const auto count = [&](RegressionVerdict verdict) { return result.Count(verdict, primary); };
  return fmt::format("{} changed, {} equivalent, {} none seen, {} inconclusive",
                     count(RegressionVerdict::kChanged), count(RegressionVerdict::kEquivalent),
                     count(RegressionVerdict::kNoneSeen), count(RegressionVerdict::kInconclusive));
}

// The finding on distributions.
std::string Distribution(const statistics::RegressionResult& result) {
  return fmt::format(
      "\ndistribution: {}\n"
      "  primary (success, distance, time, errors)  {}\n"
      "  secondary (all other metrics)              {}\n",
      DistributionName(result), Counted(result, true), Counted(result, false));
}

std::string TableHead() {
  return fmt::format("\n  {:<13}{:<25}{:>10}{:>10}{:>11}{:>10}{:>9}{:>10}\n", "verdict", "metric",
                     "baseline", "run", "difference", "margin", "Holm p", "seen 80 %");
}

// What navigators count may have longer names than the column is wide.
constexpr std::size_t kMetricWidth = 24;

std::string RegressionLine(const RegressionRow& row) {
  return fmt::format("  {:<13}{:<25}{:>10}{:>10}{:>11}{:>10}{:>9}{:>10}\n", Name(row.verdict),
                     Cut(Printable(row.metric.name), kMetricWidth), FourDigits(row.baseline_mean),
                     FourDigits(row.run_mean), Signed(row.difference), FourDigits(row.margin),
                     Probability(row.holm_p_value), FourDigits(row.seen_80));
}

// Whether kThatMatter shows the row: what is undecided in the secondary family decides nothing, and
// is counted only.
bool Matters(const RegressionRow& row) {
  return row.primary ? row.verdict != RegressionVerdict::kEquivalent
                     : row.verdict == RegressionVerdict::kChanged;
}

std::string Table(const RegressionReport& report, ReportedRows rows) {
  std::string text;
  for (const CheckedCell& cell : report.cells) {
    std::string lines;
    for (const RegressionRow& row : report.result.rows) {
      if (row.cell == cell.name && (rows == ReportedRows::kAll || Matters(row))) {
        lines += RegressionLine(row);
      }
    }
    if (lines.empty()) continue;
    text += TableHead() + (cell.name.empty() ? "" : fmt::format("  {}\n", NameOf(cell))) + lines;
  }
  return text;
}

// The largest moves first, in units of their margins.
std::string Moved(const RegressionReport& report) {
  std::vector<const RegressionRow*> rows;
  for (const RegressionRow& row : report.result.rows) {
    if (row.verdict == RegressionVerdict::kChanged) rows.push_back(&row);
  }
  std::stable_sort(rows.begin(), rows.end(), [](const auto* a, const auto* b) {
    return std::abs(a->difference) / a->margin > std::abs(b->difference) / b->margin;
  });
  std::string text;
  for (const RegressionRow* row : rows) text += "  " + Printable(Sentence(*row)) + "\n";
  return text.empty() ? text : "\nchanged\n" + text;
}

// Whether the run was large enough to know, and what would be.
std::string Unsure(const RegressionReport& report) {
  std::int64_t most = 0;
  std::int64_t unsure = 0;
  std::int64_t primary = 0;
  const RegressionRow* worst = nullptr;
  for (const RegressionRow& row : report.result.rows) {
    if (!row.primary) continue;
    ++primary;
    if (row.verdict != RegressionVerdict::kInconclusive) continue;
    ++unsure;
    if (row.trials_for_margin > most) {
      most = row.trials_for_margin;
      worst = &row;
    }
  }
  if (unsure == 0) return "";
  std::string text = fmt::format(
      "\n{} of {} primary metrics are inconclusive: no change is shown, nor would one that "
      "matters\n"
      "have been seen.\n",
      unsure, primary);
  if (worst != nullptr) {
    text += fmt::format(
        "  The hardest, {},\n  needs about {} trials with a value to see a shift of its margin.\n",
        Printable(Label(*worst)), most);
  }
  return text;
}

std::string Rates(const statistics::RegressionOptions& options) {
  return fmt::format(
      "  false alarm in an unchanged build: at most {:g} for all metrics together (Holm within "
      "each\n"
      "  family), {:g} of it primary\n"
      "  equivalent although moved by its margin: at most {:g} for each rate, about that for "
      "values\n"
      "  none seen: a shift of the margin (of a mean, of {:g} standard deviations where that is "
      "more)\n"
      "  would have been called changed with 80 %\n",
      options.alpha, options.FamilyAlpha(true), options.equivalence_alpha,
      statistics::kShiftThatMatters);
}

std::string Determinism(const RegressionReport& report) {
  std::string text;
  for (const CheckedCell& cell : report.cells) {
    if (!cell.not_deterministic) continue;
    text += fmt::format("  {}\n", Printable(NotDeterministic(cell)));
  }
  return text.empty() ? text : "determinism is broken\n" + text + "\n";
}

}  // namespace

std::string RegressionText(const RegressionReport& report, ReportedRows rows) {
  std::string text = Determinism(report);
  text += fmt::format("against baseline {}: {}\n", Printable(report.baseline),
                      Printable(report.reason));
  for (const CheckedCell& cell : report.cells) text += CellLine(cell);
  text += Table(report, rows) + Moved(report) + Unsure(report) + Records(report) +
          Distribution(report.result) + Rates(report.result.options);
  for (const std::string& note : report.notes) text += "  note: " + Printable(note) + "\n";
  return text;
}

}  // namespace rockyard::report
