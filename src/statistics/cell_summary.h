// Records of measurements (truth/measurement_record.h) pooled by cell, each column by its role; and
// two measurements compared cell by cell. The files, the terminal and the report page of
// experiments that measure take their numbers from here, and so does `rockyard compare`. No record
// depends on them, but the exit code of `rockyard compare` of measurements does: 1 where any cell
// differs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "statistics/proportions.h"
#include "truth/measurement_record.h"
#include "truth/record.h"

namespace rockyard::statistics {

// The rate of one count of a cell over its base.
struct CellRate {
  Proportion rate;        // with its own 95 % interval
  Interval simultaneous;  // all of this column hold together with 95 % (Bonferroni)
};

struct Cell {
  std::int64_t number = 0;
  std::int64_t runs = 0;
  std::vector<double> factors;  // in the order of MeasurementSummary::factors
  std::vector<double> bases;    // sums
  std::vector<CellRate> rates;
  std::vector<double> means;  // sum over base, or the root of it for squares; NaN without base
};

struct MeasurementSummary {
  std::int64_t planned = 0;
  std::int64_t completed = 0;  // records given, faults included
  std::int64_t faults = 0;     // in no number
  // The number of cells whose simultaneous intervals hold at once: the cells of the whole run.
  // While no cell has had two runs, every run still to come counts as a cell of its own, so that
  // the number is too large rather than too small.
  std::int64_t planned_cells = 0;
  truth::RecordSchema factors;
  truth::RecordSchema bases;
  truth::RecordSchema rates;
  truth::RecordSchema means;  // kSum and kSquares
  std::vector<Cell> cells;    // ascending; those with a record

  // Returns the full width of the widest pointwise 95 % interval of one rate over all cells.
  double WidestInterval(std::size_t rate) const;
  // Returns the position in `rates`, or rates.size() where there is none.
  std::size_t FindRate(std::string_view name) const;
};

// Pools records by cell. `records` must be a contiguous prefix of finished runs, of a schema that
// IsMeasurement; columns without a role in a cell (kValue) are left out. `planned` is the number of
// runs of the whole plan; 0 stands for as many as are given. Runs of a cell are taken as
// independent. Counts of independent trials (truth::ColumnRole::kTrials) add up to binomial counts;
// the rate of what happens several times in a run (hazards of a field, goals of a mission) has an
// interval by runs (RateOfRuns). `method` is that of the interval of one cell alone. Simultaneous
// intervals have the level 1 - 0.05 / planned_cells. For independent trials they are Clopper and
// Pearson's: Wilson's keep their level on average over rates only, and far out in the tails not
// even so. Cost: linear.
MeasurementSummary SummarizeCells(const truth::RecordSchema& schema,
                                  std::span<const truth::Record> records, std::int64_t planned = 0,
                                  IntervalMethod method = IntervalMethod::kWilson);

// One rate of one cell in both measurements.
struct RateDifference {
  Proportion first;
  Proportion second;
  bool tested = false;      // both have trials
  double difference = 0.0;  // second less first
  Interval interval;        // 95 %, Newcombe (1998), method 10
  Interval simultaneous;    // those of all tests hold together with 95 % (Bonferroni)
  double p_value = 1.0;     // Fisher, exact, two-sided
  double adjusted = 1.0;    // Holm, over all tests
};

struct ComparedCell {
  std::vector<double> factors;
  std::vector<RateDifference> rates;
};

struct CellComparison {
  truth::RecordSchema factors;
  truth::RecordSchema rates;
  std::vector<ComparedCell> cells;  // in both, in the order of the first
  std::size_t only_first = 0;       // cells
  std::size_t only_second = 0;
  std::size_t tests = 0;  // one for each rate of each cell with trials in both
  double alpha = 0.05;

  bool Differs(const RateDifference& rate) const { return rate.tested && rate.adjusted <= alpha; }
  // Returns the number of cells in which this rate differs.
  std::size_t Differing(std::size_t rate) const;
  // Returns the number of cells in which any rate does.
  std::size_t Differing() const;
};

// Compares the cells that both have. Cells are the same where all factors are equal in name and
// value, whatever their numbers: tables of different size have a part in common. Rates are matched
// by name. The null hypothesis of each test is that both rates are equal. All tests, of every rate
// in every cell, are one family, so that the chance that anything `differs` without a difference is
// at most alpha. The samples are taken as independent: runs of one seed whose cells draw the same
// scenes are closer than that, which makes p-values too large. Where the base of a count is not
// made of independent trials (hazards share fields, points share scenes) p-values are somewhat too
// small. The tests are exact; Newcombe's intervals keep their level on average over rates only, and
// the simultaneous ones, far out in the tails, not always even so. The result has no cells where
// none is shared or the factors differ. Cost: linear in the cells and in the counts.
CellComparison CompareCells(const MeasurementSummary& first, const MeasurementSummary& second,
                            double alpha = 0.05);

}  // namespace rockyard::statistics
