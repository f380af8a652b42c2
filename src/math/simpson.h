// Integrals of smooth functions. Only terrain uses them, for tables of `rockyard terrain`: rocks in
// a corridor (field.h, good to 1e-5) and the extent of ellipses (blind_swath.h, to 1e-10). No draw
// and no record depends on them: while these accuracies hold, the rule is free.
#pragma once

namespace rockyard::math {

// Returns the integral of f from low to high by Simpson's composite rule with 64 intervals:
// h/3 (f_0 + 4 f_1 + 2 f_2 + ... + 4 f_63 + f_64), h their width; their number must be even. Its
// error is (high - low) h^4 / 180 times a fourth derivative of f somewhere between low and high.
template <class Function>
double Simpson(double low, double high, const Function& f) {
  constexpr int kIntervals = 64;
  const double step = (high - low) / kIntervals;
  double sum = f(low) + f(high);
  for (int i = 1; i < kIntervals; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * f(low + i * step);
  return sum * step / 3.0;
}

}  // namespace rockyard::math
