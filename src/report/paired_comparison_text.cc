#include <fmt/format.h>

#include <cmath>

#include "report/paired_comparison.h"

namespace rockyard::report {
namespace {

std::string Number(double value) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value) : std::string("-");
}

std::string Percent(const statistics::Proportion& rate) {
  return fmt::format("{} of {} ({:.1f} %)", rate.count, rate.trials, 100.0 * rate.rate);
}

std::string SuccessLines(const SuccessComparison& success, bool paired) {
  std::string text = fmt::format(
      "  {:<17} A {:<26} B {}\n  {:<17} B - A {:+.1f} points (95 % interval {:+.1f} .. {:+.1f})\n",
      success.what, Percent(success.first), Percent(success.second), "", 100.0 * success.difference,
      100.0 * success.interval.low, 100.0 * success.interval.high);
  const PairedCounts& counts = success.counts;
  if (paired) {
    text += fmt::format(
        "  {:<17} both {}, only A {}, only B {}, neither {}; McNemar, exact: p = {:.3g}\n", "",
        counts.both, counts.only_first, counts.only_second, counts.neither, success.p_value);
  } else {
    text += fmt::format("  {:<17} Fisher, exact: p = {:.3g}\n", "", success.p_value);
  }
  return text;
}

std::string ColumnLine(const ColumnComparison& column) {
  return fmt::format("  {:<27.27} {:>5} {:>10} {:>10} {:>10} {:>13} .. {:<10}\n", column.name,
                     column.count, Number(column.first_mean), Number(column.second_mean),
                     Number(column.difference), Number(column.interval.low),
                     Number(column.interval.high));
}

}  // namespace

std::string RunComparisonText(const ComparedRun& first, const ComparedRun& second,
                              const RunComparison& comparison) {
  std::string text =
      fmt::format("A: {}, seed {}, {} trials\nB: {}, seed {}, {} trials\n", first.name, first.seed,
                  first.records.size(), second.name, second.seed, second.records.size());
  text +=
      comparison.paired
          ? fmt::format("{} pairs of trials with equal rocks and equal noise\n\n", comparison.pairs)
          : std::string("different seeds: compared as two samples, not in pairs\n\n");
  for (const SuccessComparison& success : comparison.successes) {
    text += SuccessLines(success, comparison.paired);
  }
  text += fmt::format("\n  {:<27} {:>5} {:>10} {:>10} {:>10} {:>19}\n", "means", "n", "A", "B",
                      "B - A", "95 % interval");
  for (const ColumnComparison& column : comparison.columns) text += ColumnLine(column);
  return text;
}

}  // namespace rockyard::report
