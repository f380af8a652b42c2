// Holm's step-down procedure (Holm 1979): keeps the chance of any false rejection in a family of
// tests at or below alpha, whatever the dependence between them. Checks, comparisons and sweeps
// adjust their p-values by it. Their verdicts and exit codes, not records, depend on it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace rockyard::statistics {

// Returns adjusted p-values, in the order given: reject where adjusted <= alpha.
std::vector<double> HolmAdjust(std::span<const double> p_values);

// Returns the level at which each test is rejected by the procedure given the other p-values: alpha
// / (m - r), where r of the others are rejected before it. Power is computed at this level. Cost:
// sorting them once.
std::vector<double> HolmLevels(std::span<const double> p_values, double alpha);

}  // namespace rockyard::statistics
