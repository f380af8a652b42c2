// Records of measurements (truth/measurement_record.h) pooled by cell, each column by its role.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "statistics/proportions.h"
#include "truth/measurement_record.h"
#include "truth/record.h"

namespace rockyard::statistics {

// A count of a cell against its base.
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
  // Cells whose intervals hold at once: those of the whole run. While no cell has had two runs,
  // every run to come is counted as one, so that it is too large rather than too small.
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
// IsMeasurement; columns without a role in a cell (kValue) are left out. `planned` is
// the number of runs of the whole plan, 0 for those given. Runs of a cell are independent. Counts
// of independent trials (truth::ColumnRole::kTrials) add up to binomial counts; of what happens
// several times in a run (hazards of a field, goals of a mission) intervals are by runs
// (RateOfRuns). `method` is that of a cell alone. Simultaneous intervals are at the level 1 - 0.05
// / planned_cells, of independent trials Clopper and Pearson's: Wilson's keep their level on
// average over rates only, and far out in the tails not even that. Cost: linear.
MeasurementSummary SummarizeCells(const truth::RecordSchema& schema,
                                  std::span<const truth::Record> records, std::int64_t planned = 0,
                                  IntervalMethod method = IntervalMethod::kWilson);

}  // namespace rockyard::statistics
