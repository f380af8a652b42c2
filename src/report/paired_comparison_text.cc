#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/numbers.h"
#include "report/line_text.h"
#include "report/paired_comparison.h"
#include "statistics/metrics.h"

namespace rockyard::report {
namespace {

std::string CountAndPercent(const statistics::Proportion& rate) {
  return fmt::format("{} of {} ({:.1f} %)", rate.count, rate.trials, 100.0 * rate.rate);
}

std::string SuccessLines(const SuccessComparison& success, bool paired) {
  std::string text = fmt::format(
      "  {:<17} A {:<26} B {}\n  {:<17} B - A {:+.1f} points (95 % interval {:+.1f} .. {:+.1f})\n",
      success.what, CountAndPercent(success.first), CountAndPercent(success.second), "",
      100.0 * success.difference, 100.0 * success.interval.low, 100.0 * success.interval.high);
  const statistics::PairedCounts& counts = success.counts;
  const bool tested = std::isfinite(success.p_value);
  if (paired) {
    text +=
        fmt::format("  {:<17} both {}, only A {}, only B {}, neither {}{}", "", counts.both,
                    counts.only_first, counts.only_second, counts.neither,
                    tested ? fmt::format("; McNemar, exact: p = {:.3g}\n", success.p_value) : "\n");
  } else if (tested) {
    text += fmt::format("  {:<17} Fisher, exact: p = {:.3g}\n", "", success.p_value);
  }
  return text;
}

// Of two samples the smaller one.
std::int64_t Least(const ColumnComparison& column) {
  return std::min(column.count, column.second_count);
}

std::string ColumnLine(const ColumnComparison& column) {
  return fmt::format("  {:<27.27} {:>5} {:>10} {:>10} {:>10} {:>13} .. {:<10}\n", column.name,
                     Least(column), FourDigits(column.first_mean), FourDigits(column.second_mean),
                     FourDigits(column.difference), FourDigits(column.interval.low),
                     FourDigits(column.interval.high));
}

bool IsOfAMetric(const ColumnComparison& column, statistics::MetricTrials trials) {
  const auto metrics = statistics::Metrics();
  return Least(column) > 0 && std::ranges::any_of(metrics, [&](const statistics::Metric& metric) {
           return metric.trials == trials &&
                  (metric.name == column.name || metric.columns[0] == column.name);
         });
}

std::vector<ColumnComparison> OfMetrics(const std::vector<ColumnComparison>& columns,
                                        statistics::MetricTrials trials) {
  std::vector<ColumnComparison> kept;
  std::ranges::copy_if(columns, std::back_inserter(kept), [trials](const ColumnComparison& column) {
    return IsOfAMetric(column, trials);
  });
  return kept;
}

std::string ColumnTable(std::string_view title, std::span<const ColumnComparison> columns) {
  std::string text = fmt::format("\n  {:<27} {:>5} {:>10} {:>10} {:>10} {:>19}\n", title, "n", "A",
                                 "B", "B - A", "95 % interval");
  for (const ColumnComparison& column : columns) text += ColumnLine(column);
  return text;
}

std::string Pairing(const RunComparison& comparison) {
  if (!comparison.paired) return "different seeds: compared as two samples, not in pairs\n\n";
  return fmt::format("{} pairs of trials with {}\n\n", comparison.pairs,
                     comparison.same_terrain
                         ? "equal rocks and equal noise"
                         : "equal random numbers, but other settings of terrain or course");
}

void AddColumns(std::string_view trials, std::span<const ColumnComparison> columns, bool paired,
                ResultTable& table) {
  for (const ColumnComparison& column : columns) {
    table.Add(trials, column.name, column.unit, Least(column), column.count,
              paired ? core::kNaN : static_cast<double>(column.second_count), column.first_mean,
              column.second_mean, column.difference, column.interval);
  }
}

}  // namespace

std::string RunComparisonText(const ComparedRun& first, const ComparedRun& second,
                              const RunComparison& comparison, std::string_view settings,
                              bool every_column) {
  std::string text = fmt::format("A: {}, seed {}, {} trials\nB: {}, seed {}, {} trials\n",
                                 Printable(first.name), first.seed, first.records.size(),
                                 Printable(second.name), second.seed, second.records.size());
  text += Pairing(comparison);
  text += settings;
  if (comparison.shared_layouts) {
    text += "Trials share layouts of rocks: intervals allow for it, and there are no p-values.\n\n";
  }
  for (const SuccessComparison& success : comparison.successes) {
    text += SuccessLines(success, comparison.paired);
  }
  const bool whole = every_column || comparison.successes.empty();
  const std::vector<ColumnComparison> all =
      whole ? comparison.columns : OfMetrics(comparison.columns, statistics::MetricTrials::kAll);
  text += ColumnTable("means, all trials", all);
  const std::vector<ColumnComparison> arrived =
      whole ? comparison.arrived_columns
            : OfMetrics(comparison.arrived_columns, statistics::MetricTrials::kArrived);
  if (!arrived.empty()) {
    text += ColumnTable(comparison.paired ? "means, both arrived" : "means, arrived", arrived);
    text += "  (arrived: declared success; trials that one of both failed are left out here)\n";
  }
  if (whole) return text;
  return text + "\n  every column: --all, or --csv FILE\n";
}

ResultTable ColumnsOf(const RunComparison& comparison) {
  ResultTable table("trials,column,unit,least,n,n_second,first,second,difference,low,high");
  AddColumns("all", comparison.columns, comparison.paired, table);
  AddColumns("arrived", comparison.arrived_columns, comparison.paired, table);
  return table;
}

std::string RunComparisonCsv(const RunComparison& comparison) {
  return ColumnsOf(comparison)
      .Csv(
          "trials,column,unit,least as n,first as mean_a,second as mean_b,difference,low as "
          "ci95_low,"
          "high as ci95_high");
}

}  // namespace rockyard::report
