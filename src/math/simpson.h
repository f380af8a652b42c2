// Integrals of smooth functions: numbers of rocks that are expected in a corridor and on a blind
// swath are found by them. No rock is drawn by them.
#pragma once

namespace rockyard::math {

// Returns the integral of f from low to high by Simpson's composite rule with 64 intervals:
// h/3 (f_0 + 4 f_1 + 2 f_2 + ... + 4 f_63 + f_64). Its error is (high - low) h^4 / 180 times a
// fourth derivative of f between low and high.
template <class Function>
double Simpson(double low, double high, const Function& f) {
  constexpr int kIntervals = 64;
  const double step = (high - low) / kIntervals;
  double sum = f(low) + f(high);
  for (int i = 1; i < kIntervals; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * f(low + i * step);
  return sum * step / 3.0;
}

}  // namespace rockyard::math
