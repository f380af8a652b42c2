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
  Interval simultaneous;  // exact; all of this column hold together with 95 % (Bonferroni)
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
// the number of runs of the whole plan, 0 for those given. Scenes of a cell are independent, so
// counts add up to binomial counts. Where the base of a count is not made of independent trials
// (hazards share fields), intervals are somewhat too narrow. `method` is that of a cell alone.
// Simultaneous intervals are Clopper and Pearson's at the level 1 - 0.05 / planned_cells: Wilson's
// keep their level on average over rates only, and far out in the tails not even that. Cost:
// linear.
MeasurementSummary SummarizeCells(const truth::RecordSchema& schema,
                                  std::span<const truth::Record> records, std::int64_t planned = 0,
                                  IntervalMethod method = IntervalMethod::kWilson);

}  // namespace rockyard::statistics
