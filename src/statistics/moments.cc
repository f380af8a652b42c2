#include "statistics/moments.h"

#include <algorithm>
#include <cmath>

#include "core/numbers.h"

namespace rockyard::statistics {
namespace {

using core::kNaN;

}  // namespace

void Moments::Add(double value) {
  if (!std::isfinite(value)) {
    ++not_finite_;
    return;
  }
  min_ = count_ == 0 ? value : std::min(min_, value);
  max_ = count_ == 0 ? value : std::max(max_, value);
  ++count_;
  // Welford 1962: m' = m + (x - m)/n, S' = S + (x - m)(x - m').
  const double before = value - mean_;
  mean_ += before / static_cast<double>(count_);
  sum_of_squares_ += before * (value - mean_);
}

void Moments::Merge(const Moments& other) {
  not_finite_ += other.not_finite_;
  if (other.count_ == 0) return;
  if (count_ == 0) {
    const std::int64_t not_finite = not_finite_;
    *this = other;
    not_finite_ = not_finite;
    return;
  }
  // Chan, Golub and LeVeque 1983: with the difference d of the means, m' = m + d n_2/(n_1 + n_2)
  // and S' = S_1 + S_2 + d^2 n_1 n_2/(n_1 + n_2).
  const double here = static_cast<double>(count_);
  const double there = static_cast<double>(other.count_);
  const double difference = other.mean_ - mean_;
  mean_ += difference * there / (here + there);
  sum_of_squares_ +=
      other.sum_of_squares_ + difference * difference * here * there / (here + there);
  count_ += other.count_;
  min_ = std::min(min_, other.min_);
  max_ = std::max(max_, other.max_);
}

double Moments::mean() const { return count_ == 0 ? kNaN : mean_; }
double Moments::variance() const {
  return count_ < 2 ? kNaN : sum_of_squares_ / static_cast<double>(count_ - 1);
}
double Moments::standard_deviation() const { return std::sqrt(variance()); }
double Moments::min() const { return count_ == 0 ? kNaN : min_; }
double Moments::max() const { return count_ == 0 ? kNaN : max_; }

Moments MomentsOf(std::span<const double> values) {
  Moments moments;
  for (const double value : values) moments.Add(value);
  return moments;
}

}  // namespace rockyard::statistics
