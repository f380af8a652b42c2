#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "report/line_text.h"
#include "report/regression_format.h"
#include "report/regression_report.h"

namespace rockyard::report {
namespace {

using statistics::RegressionRow;
using statistics::RegressionVerdict;

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

// The first finding: bits.
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

// The second finding: what the trials say.
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

std::string RegressionLine(const RegressionRow& row) {
  return fmt::format("  {:<13}{:<25}{:>10}{:>10}{:>11}{:>10}{:>9}{:>10}\n", Name(row.verdict),
                     row.metric->name, FourDigits(row.baseline_mean), FourDigits(row.run_mean),
                     Signed(row.difference), FourDigits(row.margin), Probability(row.holm_p_value),
                     FourDigits(row.seen_80));
}

// What is undecided in the secondary family decides nothing, and is counted only.
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
