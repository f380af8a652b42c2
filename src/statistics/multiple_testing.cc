#include "statistics/multiple_testing.h"

#include <algorithm>
#include <numeric>

#include "core/check.h"

namespace rockyard::statistics {

std::vector<double> HolmAdjust(std::span<const double> p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
  std::vector<double> adjusted(p_values.size());
  double largest = 0.0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const double factor = static_cast<double>(order.size() - rank);
    largest = std::max(largest, std::min(1.0, factor * p_values[order[rank]]));
    adjusted[order[rank]] = largest;
  }
  return adjusted;
}

double HolmLevel(std::span<const double> p_values, std::size_t index, double alpha) {
  EXPECT(index < p_values.size());
  std::vector<double> others(p_values.begin(), p_values.end());
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(index));
  std::sort(others.begin(), others.end());
  const double family = static_cast<double>(p_values.size());
  double rejected = 0.0;
  for (const double p : others) {
    if (p > alpha / (family - rejected)) break;
    rejected += 1.0;
  }
  return alpha / (family - rejected);
}

}  // namespace rockyard::statistics
