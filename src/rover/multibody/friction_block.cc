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
  const double a0 = a0_ + shift_;
  const double a1 = a1_ + shift_;
  const double inverse = 1.0 / (a0 * a1 - a01_ * a01_);
  return {inverse * (a1 * b[0] - a01_ * b[1]), inverse * (a0 * b[1] - a01_ * b[0])};
}

std::array<double, 2> FrictionBlock::Solve(const std::array<double, 2>& b, double most) {
  if (most <= 0.0) return {0.0, 0.0};
  std::array<double, 2> p = SolveShifted(b);
  for (int i = 0; i < kMaxIterations; ++i) {
    const double size = Length(p);
    const bool free = shift_ == 0.0 && size <= most;
    if (free || std::abs(size - most) <= kTolerance * most) return p;
    const std::array<double, 2> q = SolveShifted(p);
    const double slope = (p[0] * q[0] + p[1] * q[1]) / size;  // -d|p| / ds
    shift_ = std::max(0.0, shift_ + (size / most - 1.0) * size / slope);
    p = SolveShifted(b);
  }
  return p;
}

}  // namespace rockyard::rover
