// One metric of a regression check: what both sides say of it, tested, and what the check would
// have seen. For regression.cc only. Verdicts and exit codes of checks depend on it, no record.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "statistics/equivalence.h"
#include "statistics/proportions.h"
#include "statistics/regression.h"
#include "statistics/sample_size.h"

namespace rockyard::statistics {

// The values that are compared, as many on both sides. Where trials are paired, value i of one
// belongs to value i of the other.
struct RegressionSamples {
  std::vector<double> baseline;
  std::vector<double> run;

  bool empty() const { return run.empty(); }
  std::int64_t count() const { return static_cast<std::int64_t>(run.size()); }
};

// Returns the values to compare, from the trials that both sides have: where paired those of the
// trials with a value on both sides; else the first values of each side, as many as the other has.
RegressionSamples TakeSamples(bool paired, std::span<const double> baseline,
                              std::span<const double> run);

MeanDifference MeansOf(const RegressionSamples& samples, bool paired);
PairedCounts CountPairs(const RegressionSamples& samples);
ContingencyTable CountGroups(const RegressionSamples& samples);

// How many pairs have values that differ, and how far apart any values of both sides are.
struct Spread {
  std::int64_t differing = 0;
  double range = 0.0;
};
Spread SpreadOf(const RegressionSamples& samples);

// Fills the p-values and the interval of the row, of which metric, paired and margin are set.
void TestSamples(const RegressionSamples& samples, RegressionRow& row);

// Fills seen_80, seen_90, to_see, sees_enough and trials_for_margin of rows whose tests and levels
// are known. Keeps Fisher's tests, which many rows share.
class RegressionPower {
 public:
  void Fill(const RegressionSamples& samples, double equivalence_alpha, RegressionRow& row);

 private:
  void FillRate(const RegressionSamples& samples, RegressionRow& row);
  double SeenRateShift(const RegressionSamples& samples, const RegressionRow& row, double power);
  double SeenGroupShift(const RegressionSamples& samples, double level, double power);

  std::map<std::pair<std::int64_t, double>, FisherTest> tests_;  // by trials of a group and level
};

}  // namespace rockyard::statistics
