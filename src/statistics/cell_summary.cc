#include "statistics/cell_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/check.h"
#include "statistics/clustered_rate.h"
#include "statistics/multiple_testing.h"
#include "statistics/proportions.h"

namespace rockyard::statistics {

namespace {

using truth::ColumnRole;
using truth::ValueInfo;

// A column of the records that has a role in a cell.
struct KnownColumn {
  const ValueInfo* what;
  std::size_t index;
};

struct Sums {
  std::int64_t runs = 0;
  std::vector<double> values;        // by index in the schema; factors are not added up
  std::vector<std::size_t> records;  // of the cell
};

std::vector<KnownColumn> KnownColumns(const truth::RecordSchema& schema) {
  std::vector<KnownColumn> columns;
  // The first column is the number of the cell (truth/measurement_record.h).
  for (std::size_t i = 1; i < schema.size(); ++i) {
    if (schema[i].role != ColumnRole::kValue) columns.push_back({&schema[i], i});
  }
  return columns;
}

std::map<std::int64_t, Sums> Pool(std::span<const truth::Record> records,
                                  const std::vector<KnownColumn>& columns, std::size_t width) {
  std::map<std::int64_t, Sums> cells;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const truth::Record& record = records[i];
    if (IsFault(record) || record.values.size() != width) continue;
    Sums& sums = cells[static_cast<std::int64_t>(record.values.front())];
    sums.values.resize(width, 0.0);
    ++sums.runs;
    sums.records.push_back(i);
    for (const KnownColumn& column : columns) {
      const double value = record.values[column.index];
      double& sum = sums.values[column.index];
      sum = column.what->role == ColumnRole::kFactor ? value : sum + value;
    }
  }
  return cells;
}

// Returns the base of a column that is a count or a sum.
const KnownColumn& BaseOf(const std::vector<KnownColumn>& columns, const ValueInfo& of_column) {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const KnownColumn& column) {
    return column.what->name == of_column.of;
  });
  EXPECT(found != columns.end());
  return *found;
}

// How intervals of rates are made.
struct Intervals {
  double cells = 1.0;                               // that hold at once
  IntervalMethod method = IntervalMethod::kWilson;  // of the interval of one cell alone
};

CellRate MakeRate(std::span<const CountOfRun> runs, bool independent, const Intervals& intervals) {
  const double level = 1.0 - (1.0 - kConfidence) / intervals.cells;
  return {RateOfRuns(runs, independent, kConfidence, intervals.method),
          RateOfRuns(runs, independent, level, IntervalMethod::kClopperPearson).interval};
}

// Returns the number of cells of the whole run, or a larger one: no cell takes a second turn before
// each had its first, so until then every run that is still to come may belong to a new one.
std::int64_t PlannedCells(const MeasurementSummary& summary,
                          const std::map<std::int64_t, Sums>& pooled) {
  const auto seen = static_cast<std::int64_t>(pooled.size());
  const bool again = std::any_of(pooled.begin(), pooled.end(),
                                 [](const auto& cell) { return cell.second.runs > 1; });
  return again ? seen : seen + std::max<std::int64_t>(0, summary.planned - summary.completed);
}

double MakeMean(ColumnRole role, double sum, double base) {
  if (!(base > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  return role == ColumnRole::kSquares ? std::sqrt(sum / base) : sum / base;
}

void NameColumns(const std::vector<KnownColumn>& columns, MeasurementSummary& summary) {
  for (const KnownColumn& column : columns) {
    switch (column.what->role) {
      case ColumnRole::kValue:
        break;
      case ColumnRole::kFactor:
        summary.factors.push_back(*column.what);
        break;
      case ColumnRole::kTrials:
      case ColumnRole::kBase:
        summary.bases.push_back(*column.what);
        break;
      case ColumnRole::kCount:
      case ColumnRole::kMainCount:
        summary.rates.push_back(*column.what);
        break;
      case ColumnRole::kSum:
      case ColumnRole::kSquares:
        summary.means.push_back(*column.what);
        break;
    }
  }
}

std::vector<CountOfRun> CountsOfRuns(std::span<const truth::Record> records, const Sums& sums,
                                     std::size_t count, std::size_t base) {
  std::vector<CountOfRun> runs;
  runs.reserve(sums.records.size());
  for (const std::size_t i : sums.records) {
    const CountOfRun run{records[i].values[count], records[i].values[base]};
    if (run.base > 0.0) runs.push_back(run);
  }
  return runs;
}

Cell MakeCell(std::int64_t number, std::span<const truth::Record> records, const Sums& sums,
              const std::vector<KnownColumn>& columns, const Intervals& intervals) {
  Cell cell;
  cell.number = number;
  cell.runs = sums.runs;
  for (const KnownColumn& column : columns) {
    const double value = sums.values[column.index];
    switch (column.what->role) {
      case ColumnRole::kValue:
        break;
      case ColumnRole::kFactor:
        cell.factors.push_back(value);
        break;
      case ColumnRole::kTrials:
      case ColumnRole::kBase:
        cell.bases.push_back(value);
        break;
      case ColumnRole::kCount:
      case ColumnRole::kMainCount: {
        const KnownColumn& base = BaseOf(columns, *column.what);
        cell.rates.push_back(MakeRate(CountsOfRuns(records, sums, column.index, base.index),
                                      base.what->role == ColumnRole::kTrials, intervals));
        break;
      }
      case ColumnRole::kSum:
      case ColumnRole::kSquares:
        cell.means.push_back(
            MakeMean(column.what->role, value, sums.values[BaseOf(columns, *column.what).index]));
        break;
    }
  }
  return cell;
}

}  // namespace

double MeasurementSummary::WidestInterval(std::size_t rate) const {
  double widest = 0.0;
  for (const Cell& cell : cells) {
    const Interval& interval = cell.rates[rate].rate.interval;
    widest = std::max(widest, interval.high - interval.low);
  }
  return widest;
}

std::size_t MeasurementSummary::FindRate(std::string_view name) const {
  const auto found = std::find_if(rates.begin(), rates.end(),
                                  [&](const ValueInfo& rate) { return rate.name == name; });
  return static_cast<std::size_t>(found - rates.begin());
}

MeasurementSummary SummarizeCells(const truth::RecordSchema& schema,
                                  std::span<const truth::Record> records, std::int64_t planned,
                                  IntervalMethod method) {
  EXPECT(truth::IsMeasurement(schema));
  MeasurementSummary summary;
  summary.completed = static_cast<std::int64_t>(records.size());
  summary.planned = planned > 0 ? planned : summary.completed;
  summary.faults = std::count_if(records.begin(), records.end(), truth::IsFault);
  const std::vector<KnownColumn> columns = KnownColumns(schema);
  NameColumns(columns, summary);
  const std::map<std::int64_t, Sums> pooled = Pool(records, columns, schema.size());
  summary.planned_cells = PlannedCells(summary, pooled);
  const Intervals intervals{static_cast<double>(summary.planned_cells), method};
  for (const auto& [number, sums] : pooled) {
    summary.cells.push_back(MakeCell(number, records, sums, columns, intervals));
  }
  return summary;
}

namespace {

// Positions of a rate in both summaries.
using ColumnPair = std::pair<std::size_t, std::size_t>;

std::vector<ColumnPair> SharedRates(const MeasurementSummary& first,
                                    const MeasurementSummary& second) {
  std::vector<ColumnPair> shared;
  for (std::size_t i = 0; i < first.rates.size(); ++i) {
    const std::size_t other = second.FindRate(first.rates[i].name);
    if (other < second.rates.size()) shared.emplace_back(i, other);
  }
  return shared;
}

bool SameNames(const truth::RecordSchema& first, const truth::RecordSchema& second) {
  return std::equal(
      first.begin(), first.end(), second.begin(), second.end(),
      [](const truth::ValueInfo& a, const truth::ValueInfo& b) { return a.name == b.name; });
}

RateDifference Compare(const Proportion& first, const Proportion& second) {
  RateDifference result;
  result.first = first;
  result.second = second;
  result.tested = first.trials > 0 && second.trials > 0;
  result.difference = second.rate - first.rate;
  result.interval = DifferenceInterval(first, second, kConfidence);
  result.simultaneous = result.interval;
  if (result.tested) {
    result.p_value = FisherExactPValue(
        {first.count, first.trials - first.count, second.count, second.trials - second.count});
  }
  return result;
}

// Fills what depends on the whole family: adjusted p-values and simultaneous intervals.
void Adjust(CellComparison& comparison) {
  std::vector<RateDifference*> tests;
  std::vector<double> p_values;
  for (ComparedCell& cell : comparison.cells) {
    for (RateDifference& rate : cell.rates) {
      if (!rate.tested) continue;
      tests.push_back(&rate);
      p_values.push_back(rate.p_value);
    }
  }
  comparison.tests = tests.size();
  const std::vector<double> adjusted = HolmAdjust(p_values);
  for (std::size_t i = 0; i < tests.size(); ++i) {
    RateDifference& test = *tests[i];
    test.adjusted = adjusted[i];
    const double level = 1.0 - (1.0 - kConfidence) / static_cast<double>(tests.size());
    test.simultaneous = DifferenceInterval(test.first, test.second, level);
  }
}

}  // namespace

std::size_t CellComparison::Differing(std::size_t rate) const {
  return static_cast<std::size_t>(
      std::count_if(cells.begin(), cells.end(),
                    [&](const ComparedCell& cell) { return Differs(cell.rates[rate]); }));
}

std::size_t CellComparison::Differing() const {
  return static_cast<std::size_t>(
      std::count_if(cells.begin(), cells.end(), [&](const ComparedCell& cell) {
        return std::any_of(cell.rates.begin(), cell.rates.end(),
                           [&](const RateDifference& rate) { return Differs(rate); });
      }));
}

CellComparison CompareCells(const MeasurementSummary& first, const MeasurementSummary& second,
                            double alpha) {
  CellComparison result;
  result.alpha = alpha;
  result.factors = first.factors;
  const std::vector<ColumnPair> rates = SharedRates(first, second);
  for (const ColumnPair& pair : rates) result.rates.push_back(first.rates[pair.first]);
  std::map<std::vector<double>, const Cell*> others;
  if (SameNames(first.factors, second.factors)) {
    for (const Cell& cell : second.cells) others.emplace(cell.factors, &cell);
  }
  for (const Cell& cell : first.cells) {
    const auto other = others.find(cell.factors);
    if (other == others.end()) continue;
    ComparedCell& compared = result.cells.emplace_back();
    compared.factors = cell.factors;
    for (const auto& [a, b] : rates) {
      compared.rates.push_back(Compare(cell.rates[a].rate, other->second->rates[b].rate));
    }
    others.erase(other);  // where a list repeats a value, each cell still counts once
  }
  result.only_first = first.cells.size() - result.cells.size();
  result.only_second = second.cells.size() - result.cells.size();
  Adjust(result);
  return result;
}

}  // namespace rockyard::statistics
