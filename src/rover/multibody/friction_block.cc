#include "rover/multibody/friction_block.h"

#include <algorithm>
#include <cmath>

namespace rockyard::rover {
namespace {

// Ends the iteration, relative to the bound.
constexpr double kTolerance = 1e-9;
// Never reached: Newton doubles the digits in each iteration.
constexpr int kMaxIterations = 30;

// Without the care for overflow that std::hypot pays for.
double Length(const std::array<double, 2>& p) { return std::sqrt(p[0] * p[0] + p[1] * p[1]); }

}  // namespace

void FrictionBlock::Set(double a0, double a1, double a01) {
  a0_ = a0;
  a1_ = a1;
  a01_ = a01;
  shift_ = 0.0;
}

std::array<double, 2> FrictionBlock::SolveShifted(const std::array<double, 2>& b) const {
  // p = (A + s I)^-1 b, by Cramer's rule.
  const double a0 = a0_ + shift_;
  const double a1 = a1_ + shift_;
  const double inverse = 1.0 / (a0 * a1 - a01_ * a01_);
  return {inverse * (a1 * b[0] - a01_ * b[1]), inverse * (a0 * b[1] - a01_ * b[0])};
}

std::array<double, 2> FrictionBlock::Solve(const std::array<double, 2>& b, double softness,
                                           double most) {
  if (most <= 0.0) return {0.0, 0.0};
  shift_ = std::max(shift_, softness);
  std::array<double, 2> p = SolveShifted(b);
  for (int i = 0; i < kMaxIterations; ++i) {
    // |p| falls as s grows. Within the bound at s = c the contact holds; otherwise s is the root of
    // |p(s)| = most, where A p - b = -s p: what slides on is opposite to the friction.
    const double size = Length(p);
    const bool holds = shift_ == softness && size <= most;
    if (holds || std::abs(size - most) <= kTolerance * most) return p;
    // dp/ds = -(A + s I)^-1 p = -q, so d|p|/ds = -p . q / |p|. Newton's method on 1/|p| = 1/most,
    // nearly linear in s: ds = (|p| / most - 1) |p| / slope.
    const std::array<double, 2> q = SolveShifted(p);
    const double slope = (p[0] * q[0] + p[1] * q[1]) / size;  // -d|p| / ds
    shift_ = std::max(softness, shift_ + (size / most - 1.0) * size / slope);
    p = SolveShifted(b);
  }
  return p;
}

}  // namespace rockyard::rover
