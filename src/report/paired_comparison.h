// Two runs against each other: trial by trial where they share the seed, as two samples otherwise.
// `rockyard compare` and the report page show it, and sweeps compare their cells by it. Two
// measurements, cell by cell, as text and CSV. Differences of drives describe and decide no exit
// code (`compare` gives 0); those of cells are judged in statistics/cell_summary.h.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "report/result_table.h"
#include "statistics/cell_summary.h"
#include "statistics/proportions.h"
#include "truth/record.h"

namespace rockyard::report {

struct ComparedRun {
  std::string name;
  std::uint64_t seed = 1;
  truth::RecordSchema schema;
  std::span<const truth::Record> records;  // contiguous prefix
  std::string fields = {};  // what decides rocks, start and goal; equal texts mean equal fields
  // Which trials hang together (statistics::DependentGroups), where the records do not tell it.
  std::vector<std::size_t> groups = {};
};

struct SuccessComparison {
  std::string what;  // "declared success" or "true success"
  statistics::Proportion first;
  statistics::Proportion second;
  double difference = 0.0;          // rate of the second less rate of the first
  statistics::Interval interval{};  // 95 %, of the difference
  double p_value = 1.0;  // McNemar where paired, else Fisher; both exact, NaN of shared layouts
  statistics::PairedCounts counts;  // zero where not paired
};

struct ColumnComparison {
  std::string name;
  std::string unit;
  std::int64_t count = 0;         // pairs with two finite values (not paired: values of the first)
  std::int64_t second_count = 0;  // values of the second; paired: the same
  double first_mean = 0.0;
  double second_mean = 0.0;
  double difference = 0.0;          // of the means, second less first
  statistics::Interval interval{};  // 95 %, of the difference
};

struct RunComparison {
  bool paired = false;
  std::int64_t pairs = 0;  // trials that both runs finished without a simulator fault
  // Trials share their rocks with another one (course.trials_per_layout), in either run: every
  // interval is of layouts (statistics/clustered_rate.h), and there are no p-values.
  bool shared_layouts = false;
  bool same_terrain = true;  // equal seed and index mean equal rocks, start and goal
  std::vector<SuccessComparison> successes;  // none where nothing drives
  std::vector<ColumnComparison> columns;     // of both schemas, all trials
  // The columns over drives that ended in declared success: paired, in both runs. A distance to the
  // goal exists there only, but these are the easier fields: `columns` belongs beside it.
  std::vector<ColumnComparison> arrived_columns;
  // What navigators count for themselves of which one run alone has values, as its own navigator
  // counts it: names of columns. There is nothing to compare these with.
  std::vector<std::string> only_first;
  std::vector<std::string> only_second;
};

// Compares two runs. Equal seed and index mean equal rocks and equal noise, so that differences
// have far less variance than two samples. Paired intervals: success by the score (Tango 1998), of
// shared layouts by Agresti and Min (2005) of effective numbers; columns by the interval of the
// mean of the differences. Not paired: success by Newcombe (1998), method 10, from the Wilson
// intervals; columns in the same way from the intervals of both means. A mean difference has no
// interval where a mean of as many values has none (statistics/sample_statistics.h). No correction
// for the number of columns: they describe. Columns that one schema lacks are left out.
RunComparison CompareRuns(const ComparedRun& first, const ComparedRun& second);

// Returns text of at most 100 columns: what differs between the runs, `settings` (lines), success,
// and the columns that metrics are made of (statistics/metrics.h), with a value; with
// `every_column` all of them. What only one run's navigator counts is named.
std::string RunComparisonText(const ComparedRun& first, const ComparedRun& second,
                              const RunComparison& comparison, std::string_view settings = "",
                              bool every_column = false);

// Returns what is left out, as only one of the runs has it, in a sentence each.
std::vector<std::string> OneSidedNotes(const RunComparison& comparison, std::string_view first,
                                       std::string_view second);

// Returns `columns` and `arrived_columns` as one table: trials (all, arrived), column, unit, how
// many values (least of both runs, n, n_second: none where paired), first and second mean, their
// difference and its interval (low, high).
ResultTable ColumnsOf(const RunComparison& comparison);

// Returns ColumnsOf as CSV: trials (all, arrived), column, unit, n (least), both means, their
// difference and its interval.
std::string RunComparisonCsv(const RunComparison& comparison);

// Returns the comparison of two measurements as text of at most 100 columns: what was compared, the
// verdict, and a line for each rate; then, where there are tests, the cells: all of the main rate,
// and of every other rate those that differ, of each rate at most the forty with the smallest
// p-values.
std::string CellComparisonText(const ComparedRun& first, const ComparedRun& second,
                               const statistics::CellComparison& comparison);

// One line for each rate of each cell: rate, factors, then for A and B count, trials and rate,
// difference, its 95 % interval, the simultaneous one (_all_), p, p after Holm, whether it differs.
std::string CellComparisonCsv(const statistics::CellComparison& comparison);

}  // namespace rockyard::report
