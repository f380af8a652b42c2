// Made-up values for checks of regressions.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/distributions.h"
#include "core/random.h"
#include "statistics/regression.h"

namespace rockyard::statistics {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

inline std::vector<double> Normals(std::uint32_t set, std::size_t n, double mean) {
  core::RandomStream stream({.seed = 81, .trial = set}, core::Purpose::kTest);
  std::vector<double> values(n);
  for (double& x : values) x = core::SampleNormal(stream, mean, 1.0);
  return values;
}

inline std::vector<double> Coins(std::uint32_t set, std::size_t n, double rate) {
  core::RandomStream stream({.seed = 82, .trial = set}, core::Purpose::kTest);
  std::vector<double> values(n);
  for (double& x : values) x = core::SampleBernoulli(stream, rate) ? 1.0 : 0.0;
  return values;
}

// One metric with a mean and one rate.
inline RegressionResult Check(bool paired, const std::vector<BaselineMetric>& baseline,
                              std::vector<std::vector<double>> run) {
  const RegressionCell cell{
      .name = "cell", .paired = paired, .baseline = baseline, .run = std::move(run)};
  return CheckRegression(std::span(&cell, 1));
}

inline std::vector<double> Ones(int ones, int n) {
  std::vector<double> values(static_cast<std::size_t>(n), 0.0);
  std::fill_n(values.begin(), ones, 1.0);
  return values;
}

}  // namespace rockyard::statistics
