// Two measurements, cell by cell, as text and CSV (paired_comparison.h).
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "report/line_text.h"
#include "report/paired_comparison.h"
#include "report/result_table.h"
#include "report/summary_text.h"

namespace rockyard::report {
namespace {

using statistics::CellComparison;
using statistics::ComparedCell;
using statistics::RateDifference;

// Most cells of a rate that are shown: of more, those with the smallest p-values.
// CellComparisonText's comment states the number.
constexpr std::size_t kMaxLines = 40;

std::string Head(const ComparedRun& first, const ComparedRun& second,
                 const CellComparison& comparison) {
  std::string text;
  char letter = 'A';
  for (const ComparedRun* run : {&first, &second}) {
    text += fmt::format("{}: {:.60}, seed {}, {} runs\n", letter++, Printable(run->name), run->seed,
                        run->records.size());
  }
  text += fmt::format("{} cell{} in both", comparison.cells.size(),
                      comparison.cells.size() == 1 ? "" : "s");
  if (comparison.only_first > 0) text += fmt::format(", {} only in A", comparison.only_first);
  if (comparison.only_second > 0) text += fmt::format(", {} only in B", comparison.only_second);
  const std::size_t differing = comparison.Differing();
  text += differing == 0   ? "; none differs"
          : differing == 1 ? "; 1 of them differs"
                           : fmt::format("; {} of them differ", differing);
  return text + fmt::format(" at alpha {:g} after Holm\n", comparison.alpha) +
         fmt::format(
             "{} tests (rates x cells) by Fisher, exact; 95 % intervals of B - A by Newcombe\n"
             "(1998), each alone and all {} at once (Bonferroni)\n\n",
             comparison.tests, comparison.tests);
}

// Returns a line for each rate: its cell with the smallest p-value, and how many cells differ.
std::string RateLines(const CellComparison& comparison) {
  std::string text =
      fmt::format("  {:<20} {:>7} {:>6} {:>7} {:>15} {:>7} {:>5} {:>11}\n", "least likely cell of",
                  "A", "B", "B - A", "all at once", "p", "Holm", "that differ");
  for (std::size_t i = 0; i < comparison.rates.size(); ++i) {
    const auto less_likely = [i](const ComparedCell& a, const ComparedCell& b) {
      return a.rates[i].p_value < b.rates[i].p_value;
    };
    const RateDifference& r =
        std::min_element(comparison.cells.begin(), comparison.cells.end(), less_likely)->rates[i];
    text += fmt::format(
        "  {:<20.20} {:>7.4f} {:.4f} {:+.4f} {:+.4f} {:+.4f} {:>7.2g} {:>5.2g} {:>11}\n",
        comparison.rates[i].name, r.first.rate, r.second.rate, r.difference, r.simultaneous.low,
        r.simultaneous.high, r.p_value, r.adjusted, comparison.Differing(i));
  }
  return text;
}

std::string CellLine(const CellComparison& comparison, const ComparedCell& cell, std::size_t rate) {
  std::string line = " ";
  for (std::size_t i = 0; i < std::min(kMaxFactors, cell.factors.size()); ++i) {
    line += fmt::format(" {:>6.4g}", cell.factors[i]);
  }
  const RateDifference& r = cell.rates[rate];
  if (!r.tested) return line + "  no trials in one of them\n";
  return line + fmt::format(
                    " {:.4f} {:.4f} {:+.4f} {:+.4f} {:+.4f} {:+.4f} {:+.4f} {:>7.2g} "
                    "{:>5.2g}{}\n",
                    r.first.rate, r.second.rate, r.difference, r.interval.low, r.interval.high,
                    r.simultaneous.low, r.simultaneous.high, r.p_value, r.adjusted,
                    comparison.Differs(r) ? " *" : "");
}

// The cells to show for a rate, in the order of the table.
std::vector<const ComparedCell*> Shown(const CellComparison& comparison, std::size_t rate,
                                       bool main) {
  std::vector<const ComparedCell*> shown;
  for (const ComparedCell& cell : comparison.cells) {
    if (main || comparison.Differs(cell.rates[rate])) shown.push_back(&cell);
  }
  if (shown.size() <= kMaxLines) return shown;
  std::stable_sort(shown.begin(), shown.end(), [&](const ComparedCell* a, const ComparedCell* b) {
    return a->rates[rate].p_value < b->rates[rate].p_value;
  });
  shown.resize(kMaxLines);
  std::sort(shown.begin(), shown.end());  // they lie in one vector
  return shown;
}

std::string CellLines(const CellComparison& comparison, std::size_t rate, bool main) {
  const std::vector<const ComparedCell*> shown = Shown(comparison, rate, main);
  if (shown.empty()) return "";
  std::string text = fmt::format("\n  {}, {}", comparison.rates[rate].name,
                                 main ? "every cell" : "the cells that differ");
  const std::size_t all = main ? comparison.cells.size() : comparison.Differing(rate);
  if (shown.size() < all) text += fmt::format(": the {} of smallest p", shown.size());
  text += "\n ";
  const std::size_t factors = std::min(kMaxFactors, comparison.factors.size());
  for (std::size_t i = 0; i < factors; ++i)
    text += fmt::format(" {:>6}", fmt::format("({})", i + 1));
  text += fmt::format(" {:>6} {:>6} {:>7} {:>15} {:>15} {:>7} {:>5}\n", "A", "B", "B - A", "alone",
                      "all at once", "p", "Holm");
  for (const ComparedCell* cell : shown) text += CellLine(comparison, *cell, rate);
  return text;
}

std::string FactorNames(const CellComparison& comparison) {
  std::string text = "\n ";
  const std::size_t factors = std::min(kMaxFactors, comparison.factors.size());
  for (std::size_t i = 0; i < factors; ++i) {
    text += fmt::format(" ({}) {}", i + 1, comparison.factors[i].name);
  }
  return text + "\n";
}

}  // namespace

std::string CellComparisonText(const ComparedRun& first, const ComparedRun& second,
                               const CellComparison& comparison) {
  std::string text = Head(first, second, comparison);
  if (comparison.tests == 0) return text;
  text += RateLines(comparison) + FactorNames(comparison);
  const std::size_t found = MainRate(comparison.rates);
  const std::size_t main = found < comparison.rates.size() ? found : 0;
  text += CellLines(comparison, main, true);
  for (std::size_t i = 0; i < comparison.rates.size(); ++i) {
    if (i != main) text += CellLines(comparison, i, false);
  }
  return text;
}

std::string CellComparisonCsv(const statistics::CellComparison& comparison) {
  CsvRow head("rate");
  for (const truth::ValueInfo& factor : comparison.factors) head.Add(factor.name);
  head.Add("a_count", "a_trials", "a_rate", "b_count", "b_trials", "b_rate", "difference", "low",
           "high", "all_low", "all_high", "p_value", "p_holm", "differs");
  std::string csv = head.Line();
  for (std::size_t i = 0; i < comparison.rates.size(); ++i) {
    for (const statistics::ComparedCell& cell : comparison.cells) {
      const statistics::RateDifference& rate = cell.rates[i];
      csv += CsvLine(comparison.rates[i].name, cell.factors, rate.first.count, rate.first.trials,
                     rate.first.rate, rate.second.count, rate.second.trials, rate.second.rate,
                     rate.difference, rate.interval, rate.simultaneous, rate.p_value, rate.adjusted,
                     comparison.Differs(rate));
    }
  }
  return csv;
}

}  // namespace rockyard::report
