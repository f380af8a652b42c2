#include "statistics/multiple_testing.h"

#include <algorithm>
#include <numeric>

#include "core/check.h"

namespace rockyard::statistics {
namespace {

std::vector<std::size_t> Ascending(std::span<const double> p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
  return order;
}

}  // namespace

std::vector<double> HolmAdjust(std::span<const double> p_values) {
  const std::vector<std::size_t> order = Ascending(p_values);
  std::vector<double> adjusted(p_values.size());
  double largest = 0.0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    // Holm 1979: the p-value of rank r (from 0) of m counts (m - r) times, and never less than
    // those before it.
    const double factor = static_cast<double>(order.size() - rank);
    largest = std::max(largest, std::min(1.0, factor * p_values[order[rank]]));
    adjusted[order[rank]] = largest;
  }
  return adjusted;
}

std::vector<double> HolmLevels(std::span<const double> p_values, double alpha) {
  const std::vector<std::size_t> order = Ascending(p_values);
  const std::size_t m = order.size();
  const auto level = [&](std::size_t rejected) {
    return alpha / static_cast<double>(m - rejected);
  };
  const auto p_at = [&](std::size_t rank) { return p_values[order[rank]]; };
  std::size_t prefix = 0;  // tests that are rejected with every test in its place
  while (prefix < m && p_at(prefix) <= level(prefix)) ++prefix;
  // Without the test of rank k those after it move up by one: from k on, rank j + 1 is held against
  // level(j), and the first that is not rejected ends it.
  std::vector<double> levels(m);
  std::size_t end = m;
  for (std::size_t k = m; k-- > 0;) {
    if (k + 1 == m || p_at(k + 1) > level(k)) end = k;
    levels[order[k]] = level(k <= prefix ? end : prefix);
  }
  return levels;
}

}  // namespace rockyard::statistics
