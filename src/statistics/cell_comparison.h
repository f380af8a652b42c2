// Two measurements of the same cells: whether their rates differ.
#pragma once

#include <cstddef>
#include <vector>

#include "statistics/cell_summary.h"
#include "statistics/proportions.h"

namespace rockyard::statistics {

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
// the simultaneous ones, far out in the tails, not always that. Without a shared cell, or with
// other factors, there are no cells. Cost: linear in the cells and in the counts.
CellComparison CompareCells(const MeasurementSummary& first, const MeasurementSummary& second,
                            double alpha = 0.05);

}  // namespace rockyard::statistics
