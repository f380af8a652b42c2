// One list of a scenario whose values name cells of an experiment. Cells are numbered by their
// places in these lists: another list is another table, into which no stored run fits.
#pragma once

#include <string_view>
#include <vector>

namespace rockyard::experiments {

struct CellFactor {
  std::string_view column;  // of the record, by the experiment's columns
  std::vector<double> values;
};

// Number of cells: the product of the lengths of the factors' lists.
inline double CellsOf(const std::vector<CellFactor>& factors) {
  double cells = 1.0;
  for (const CellFactor& factor : factors) cells *= static_cast<double>(factor.values.size());
  return cells;
}

// A table that nobody can read, and a guard against a list typed wrongly.
inline constexpr double kMaxCells = 2000.0;

}  // namespace rockyard::experiments
