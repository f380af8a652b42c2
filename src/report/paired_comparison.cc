#include "report/paired_comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/numbers.h"
#include "report/line_text.h"
#include "statistics/clustered_rate.h"
#include "statistics/drive_summary.h"
#include "statistics/equivalence.h"
#include "statistics/metrics.h"
#include "statistics/sample_statistics.h"
#include "truth/measurement_record.h"

namespace rockyard::report {
namespace {

using statistics::Proportion;
using truth::Record;
using truth::TrialOutcome;

using Succeeded = bool (*)(TrialOutcome);

// A trial of both runs. Pairs of one group hang together.
struct Pair {
  const Record* first;
  const Record* second;
  std::size_t group;
};

std::vector<std::size_t> GroupsOf(const ComparedRun& run) {
  return run.groups.empty() ? statistics::DependentGroups(run.schema, run.records) : run.groups;
}

std::vector<Pair> Pairs(const ComparedRun& first, const ComparedRun& second) {
  const std::vector<std::size_t> of_first = GroupsOf(first);
  const std::vector<std::size_t> of_second = GroupsOf(second);
  // A pair is of the group of an earlier one that shares its layout in either run.
  std::map<std::size_t, std::size_t> in_first;
  std::map<std::size_t, std::size_t> in_second;
  std::vector<Pair> pairs;
  // Records are contiguous prefixes: place i is trial i of both.
  const std::size_t common = std::min(first.records.size(), second.records.size());
  for (std::size_t i = 0; i < common; ++i) {
    const Record& a = first.records[i];
    const Record& b = second.records[i];
    if (IsFault(a) || IsFault(b)) continue;
    std::size_t group = i;
    if (!of_second.empty()) group = in_second.emplace(of_second[i], group).first->second;
    if (!of_first.empty()) group = in_first.emplace(of_first[i], group).first->second;
    if (!of_second.empty()) in_second[of_second[i]] = group;
    pairs.push_back({&a, &b, group});
  }
  return pairs;
}

// Trials of one layout follow each other (trial/course/layout.h), so that neighbours tell.
bool ShareGroups(const std::vector<Pair>& pairs) {
  return std::adjacent_find(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
           return a.group == b.group;
         }) != pairs.end();
}

SuccessComparison ComparePaired(const std::vector<Pair>& pairs, std::string what,
                                Succeeded succeeded) {
  SuccessComparison result;
  result.what = std::move(what);
  std::vector<double> first;
  std::vector<double> second;
  std::vector<std::size_t> groups;
  statistics::ClusteredValues differences;
  for (const Pair& pair : pairs) {
    const bool before = succeeded(pair.first->outcome);
    const bool after = succeeded(pair.second->outcome);
    result.counts.Add(before, after);
    first.push_back(before ? 1.0 : 0.0);
    second.push_back(after ? 1.0 : 0.0);
    groups.push_back(pair.group);
    differences.Add(pair.group, second.back() - first.back());
  }
  const bool shared = ShareGroups(pairs);
  if (!shared) groups.clear();
  result.first = statistics::RateOfTrials(first, groups);
  result.second = statistics::RateOfTrials(second, groups);
  result.difference = result.second.rate - result.first.rate;
  if (shared) {
    result.interval =
        AgrestiMinInterval(differences.Effective(statistics::kConfidence), statistics::kConfidence);
    result.p_value = core::kNaN;
    return result;
  }
  result.interval = statistics::DifferenceInterval(result.counts);
  result.p_value =
      statistics::McNemarExactPValue(result.counts.only_first, result.counts.only_second);
  return result;
}

Proportion RateOf(const ComparedRun& run, Succeeded succeeded) {
  return statistics::RateOfTrials(statistics::OnesWhere(run.records, succeeded), GroupsOf(run));
}

SuccessComparison CompareUnpaired(const ComparedRun& first, const ComparedRun& second,
                                  std::string what, Succeeded succeeded) {
  SuccessComparison result;
  result.what = std::move(what);
  result.first = RateOf(first, succeeded);
  result.second = RateOf(second, succeeded);
  result.difference = result.second.rate - result.first.rate;
  result.interval = statistics::DifferenceInterval(result.first, result.second);
  const bool shared = result.first.method == statistics::IntervalMethod::kClustered ||
                      result.second.method == statistics::IntervalMethod::kClustered;
  result.p_value = shared ? core::kNaN
                          : statistics::FisherExactPValue(
                                {result.first.count, result.first.trials - result.first.count,
                                 result.second.count, result.second.trials - result.second.count});
  return result;
}

double Mean(std::span<const double> values) { return statistics::MomentsOf(values).mean(); }

// The interval is that of the mean of the differences; unknown where it has none.
void ComparePairedColumn(const std::vector<Pair>& pairs, std::size_t in_first,
                         std::size_t in_second, ColumnComparison& result) {
  std::vector<double> first;
  std::vector<double> second;
  std::vector<double> differences;
  std::vector<std::size_t> groups;
  for (const Pair& pair : pairs) {
    const double before = pair.first->values[in_first];
    const double after = pair.second->values[in_second];
    if (!std::isfinite(before) || !std::isfinite(after)) continue;
    first.push_back(before);
    second.push_back(after);
    differences.push_back(after - before);
    groups.push_back(pair.group);
  }
  result.count = static_cast<std::int64_t>(differences.size());
  result.second_count = result.count;
  result.first_mean = Mean(first);
  result.second_mean = Mean(second);
  result.difference = Mean(differences);
  if (!ShareGroups(pairs)) groups.clear();
  result.interval =
      statistics::MeanOfTrials(differences, groups, statistics::FewestForMean(result.name))
          .interval;
}

// Returns the values of every trial that counts; NaN of the others.
std::vector<double> ValuesOf(const ComparedRun& run, std::size_t column, bool arrived) {
  std::vector<double> values;
  values.reserve(run.records.size());
  for (const Record& record : run.records) {
    const bool counts = !IsFault(record) && column < record.values.size() &&
                        (!arrived || truth::DeclaredSuccess(record.outcome));
    values.push_back(counts ? record.values[column] : core::kNaN);
  }
  return values;
}

// What one side says of a column.
struct SideMean {
  std::int64_t count = 0;
  double mean = 0.0;
  statistics::Interval interval;
};

SideMean MeanOf(const ComparedRun& run, std::size_t column, bool arrived, std::int64_t fewest) {
  const std::vector<double> values = ValuesOf(run, column, arrived);
  const std::vector<double> sorted = statistics::SortedFinite(values);
  return {static_cast<std::int64_t>(sorted.size()), Mean(sorted),
          statistics::MeanOfTrials(values, GroupsOf(run), fewest).interval};
}

// Every column that both schemas have; `compare` gets its index in each and fills the rest.
template <typename Compare>
std::vector<ColumnComparison> CommonColumns(const ComparedRun& first, const ComparedRun& second,
                                            const Compare& compare) {
  std::vector<ColumnComparison> columns;
  for (std::size_t i = 0; i < first.schema.size(); ++i) {
    const auto other = statistics::ColumnIndex(second.schema, first.schema[i].name);
    if (!other) continue;
    ColumnComparison column{.name = first.schema[i].name, .unit = first.schema[i].unit};
    compare(i, *other, column);
    columns.push_back(std::move(column));
  }
  return columns;
}

std::vector<ColumnComparison> PairedColumns(const ComparedRun& first, const ComparedRun& second,
                                            const std::vector<Pair>& pairs) {
  return CommonColumns(first, second, [&](std::size_t a, std::size_t b, ColumnComparison& column) {
    ComparePairedColumn(pairs, a, b, column);
  });
}

// The interval is unknown where the mean of either side has none.
std::vector<ColumnComparison> UnpairedColumns(const ComparedRun& first, const ComparedRun& second,
                                              bool arrived) {
  return CommonColumns(first, second, [&](std::size_t a, std::size_t b, ColumnComparison& column) {
    const std::int64_t fewest = statistics::FewestForMean(column.name);
    const SideMean one = MeanOf(first, a, arrived, fewest);
    const SideMean other = MeanOf(second, b, arrived, fewest);
    column.count = one.count;
    column.second_count = other.count;
    column.first_mean = one.mean;
    column.second_mean = other.mean;
    column.difference = other.mean - one.mean;
    column.interval =
        statistics::MeanDifferenceInterval(one.mean, one.interval, other.mean, other.interval);
  });
}

std::vector<Pair> BothArrived(std::vector<Pair> pairs) {
  std::erase_if(pairs, [](const Pair& pair) {
    return !truth::DeclaredSuccess(pair.first->outcome) ||
           !truth::DeclaredSuccess(pair.second->outcome);
  });
  return pairs;
}

void CompareInPairs(const ComparedRun& first, const ComparedRun& second, bool drives,
                    RunComparison& result) {
  const std::vector<Pair> pairs = Pairs(first, second);
  result.pairs = static_cast<std::int64_t>(pairs.size());
  result.columns = PairedColumns(first, second, pairs);
  if (!drives) return;
  result.successes = {ComparePaired(pairs, "declared success", truth::DeclaredSuccess),
                      ComparePaired(pairs, "true success", truth::TrueSuccess)};
  result.arrived_columns = PairedColumns(first, second, BothArrived(pairs));
}

void CompareAsSamples(const ComparedRun& first, const ComparedRun& second, bool drives,
                      RunComparison& result) {
  result.columns = UnpairedColumns(first, second, false);
  if (!drives) return;
  result.successes = {CompareUnpaired(first, second, "declared success", truth::DeclaredSuccess),
                      CompareUnpaired(first, second, "true success", truth::TrueSuccess)};
  result.arrived_columns = UnpairedColumns(first, second, true);
}

// Returns the names of what navigators count of which this run has values.
std::vector<std::string> OwnValuesOf(const ComparedRun& run) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < run.schema.size(); ++i) {
    if (!truth::IsOwnColumn(run.schema[i].name)) continue;
    if (!statistics::ColumnValues(run.records, i).empty()) names.push_back(run.schema[i].name);
  }
  return names;
}

// Returns the names that the other list lacks.
std::vector<std::string> Without(const std::vector<std::string>& names,
                                 const std::vector<std::string>& others) {
  std::vector<std::string> left;
  std::ranges::copy_if(names, std::back_inserter(left), [&](const std::string& name) {
    return std::ranges::find(others, name) == others.end();
  });
  return left;
}

}  // namespace

RunComparison CompareRuns(const ComparedRun& first, const ComparedRun& second) {
  const bool drives = !truth::IsMeasurement(first.schema) && !truth::IsMeasurement(second.schema);
  RunComparison result;
  result.paired = first.seed == second.seed;
  result.same_terrain = first.fields == second.fields;
  result.shared_layouts = !GroupsOf(first).empty() || !GroupsOf(second).empty();
  if (result.paired) {
    CompareInPairs(first, second, drives, result);
  } else {
    CompareAsSamples(first, second, drives, result);
  }
  const std::vector<std::string> own_first = OwnValuesOf(first);
  const std::vector<std::string> own_second = OwnValuesOf(second);
  result.only_first = Without(own_first, own_second);
  result.only_second = Without(own_second, own_first);
  return result;
}

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

// Returns the size of the smaller of two samples.
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
  const auto metrics = statistics::MetricsOf({{column.name, column.unit, ""}});
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
  for (const std::string& note : OneSidedNotes(comparison, "A", "B")) {
    text += Wrapped("  " + Printable(note)) + "\n";
  }
  if (whole) return text;
  return text + "\n  every column: --all, or --csv FILE\n";
}

std::vector<std::string> OneSidedNotes(const RunComparison& comparison, std::string_view first,
                                       std::string_view second) {
  std::vector<std::string> notes;
  const auto add = [&](std::string_view run, const std::vector<std::string>& names) {
    if (names.empty()) return;
    notes.push_back(fmt::format("Counted by the navigator of {} alone, and left out: {}.", run,
                                fmt::join(names, ", ")));
  };
  add(first, comparison.only_first);
  add(second, comparison.only_second);
  return notes;
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
