// A list of a scenario whose values name cells of an experiment; the parameters of every experiment
// with cells give their lists so. Must stay: the order of values in a list that runs were stored
// with. Cells are numbered by their places, and no stored run fits into the table of another list.
#pragma once

#include <string_view>
#include <vector>

namespace rockyard::experiments {

struct CellFactor {
  std::string_view column;  // name of a factor among the experiment's columns
  std::vector<double> values;
};

// Returns the number of cells: the product of the lengths of the factors' lists.
inline double CellsOf(const std::vector<CellFactor>& factors) {
  double cells = 1.0;
  for (const CellFactor& factor : factors) cells *= static_cast<double>(factor.values.size());
  return cells;
}

// Most cells of an experiment: nobody can read a larger table, and a list may have been typed
// wrongly.
inline constexpr double kMaxCells = 2000.0;

}  // namespace rockyard::experiments
