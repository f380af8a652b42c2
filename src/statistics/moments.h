// Moments that can be accumulated in parts and merged, and the growth of a variance.
#pragma once

#include <cstdint>
#include <span>

namespace rockyard::statistics {

// Count, mean, variance and extremes of a stream of values in one pass (Welford 1962), mergeable
// (Chan, Golub and LeVeque 1983). Values that are not finite are counted apart and otherwise left
// out. Merging in a fixed order gives the same bits whatever the threads did.
class Moments {
 public:
  void Add(double value);
  void Merge(const Moments& other);

  std::int64_t count() const { return count_; }
  std::int64_t not_finite() const { return not_finite_; }
  double mean() const;                // NaN when empty
  double variance() const;            // unbiased; NaN below two values
  double standard_deviation() const;  // root of the unbiased variance
  double min() const;                 // NaN when empty
  double max() const;                 // NaN when empty

 private:
  std::int64_t count_ = 0;
  std::int64_t not_finite_ = 0;
  double mean_ = 0.0;
  double sum_of_squares_ = 0.0;  // of the deviations from the mean
  double min_ = 0.0;
  double max_ = 0.0;
};

Moments MomentsOf(std::span<const double> values);

}  // namespace rockyard::statistics
