// What a regression check would have seen. For regression*.cc only.
#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "statistics/regression_samples.h"
#include "statistics/sample_size.h"

namespace rockyard::statistics {

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
