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

std::string CellLine(const CheckedCell& cell) {
  const std::string name = cell.name.empty() ? "the run" : cell.name;
  std::string how;
  if (cell.identical) {
    how = fmt::format("identical: {} trials, every bit", cell.run_trials);
  } else if (cell.paired) {
    how = fmt::format("{} pairs with the baseline's trials (seed {}), {} of them the same",
                      std::min(cell.run_trials, cell.baseline_trials), cell.run_seed,
                      cell.same_pairs);
  } else {
    how = fmt::format("{} trials (seed {}) against {} (seed {}){}", cell.run_trials, cell.run_seed,
                      cell.baseline_trials, cell.baseline_seed,
                      cell.same_fields ? "" : ", other fields");
  }
  return fmt::format("  {:<30} {}\n", name, how);
}

std::string TableHead() {
  return fmt::format("\n  {:<13}{:<25}{:>10}{:>10}{:>11}{:>10}{:>9}{:>10}\n", "verdict", "metric",
                     "baseline", "run", "difference", "margin", "Holm p", "seen 80 %");
}

std::string TableRow(const RegressionRow& row) {
  return fmt::format("  {:<13}{:<25}{:>10}{:>10}{:>11}{:>10}{:>9}{:>10}\n", Name(row.verdict),
                     row.metric->name, FourDigits(row.baseline_mean), FourDigits(row.run_mean),
                     Signed(row.difference), FourDigits(row.margin), Probability(row.holm_p_value),
                     FourDigits(row.seen_80));
}

std::string Table(const RegressionReport& report, ReportedRows rows) {
  std::string text;
  for (const CheckedCell& cell : report.cells) {
    std::string lines;
    for (const RegressionRow& row : report.result.rows) {
      const bool shown =
          rows == ReportedRows::kAll || row.verdict != RegressionVerdict::kEquivalent;
      if (row.cell == cell.name && shown) lines += TableRow(row);
    }
    if (lines.empty()) continue;
    text += TableHead() + (cell.name.empty() ? "" : fmt::format("  {}\n", cell.name)) + lines;
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
  for (const RegressionRow* row : rows) text += "  " + Sentence(*row) + "\n";
  return text.empty() ? text : "\nchanged\n" + text;
}

// Whether the run was large enough to know, and what would be.
std::string Unsure(const RegressionReport& report) {
  std::int64_t most = 0;
  std::int64_t unsure = 0;
  const RegressionRow* worst = nullptr;
  for (const RegressionRow& row : report.result.rows) {
    if (row.verdict != RegressionVerdict::kInconclusive) continue;
    ++unsure;
    if (row.trials_for_margin > most) {
      most = row.trials_for_margin;
      worst = &row;
    }
  }
  if (unsure == 0) return "";
  std::string text = fmt::format(
      "\n{} of {} metrics are inconclusive: no change is shown, nor that it is below the margin.\n",
      unsure, report.result.rows.size());
  if (worst != nullptr) {
    text += fmt::format(
        "  The hardest, {},\n  needs about {} trials with a value to see a shift of its margin.\n",
        Label(*worst), most);
  }
  return text;
}

std::string Rates(const RegressionReport& report) {
  const statistics::RegressionResult& result = report.result;
  return fmt::format(
      "\n{} changed, {} equivalent, {} inconclusive of {} metrics in {} cells\n"
      "false alarm in an unchanged build: at most {} for all metrics together (Holm)\n"
      "equivalent although moved by its margin: at most {} for each rate, about that for values\n"
      "seen 80 %: shift that such a run would have called changed with 80 %\n",
      result.Count(RegressionVerdict::kChanged), result.Count(RegressionVerdict::kEquivalent),
      result.Count(RegressionVerdict::kInconclusive), result.rows.size(), report.cells.size(),
      result.options.alpha, result.options.equivalence_alpha);
}

std::string Determinism(const RegressionReport& report) {
  std::string text;
  for (const CheckedCell& cell : report.cells) {
    if (!cell.not_deterministic) continue;
    text += fmt::format("  {}\n", NotDeterministic(cell));
  }
  return text.empty() ? text : "determinism is broken\n" + text + "\n";
}

}  // namespace

std::string RegressionText(const RegressionReport& report, ReportedRows rows) {
  std::string text = Determinism(report);
  text += fmt::format("against baseline {}: {}\n", report.baseline, report.reason);
  for (const std::string& note : report.notes) text += "  note: " + note + "\n";
  for (const CheckedCell& cell : report.cells) text += CellLine(cell);
  return text + Table(report, rows) + Moved(report) + Unsure(report) + Rates(report);
}

}  // namespace rockyard::report
