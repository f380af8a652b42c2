// Cells of an experiment: every combination of the values of its factors, numbered.
#pragma once

#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/cell_factor_params.h"

namespace rockyard::experiments {

class CellTable {
 public:
  // No list may be empty.
  explicit CellTable(std::vector<CellFactor> factors) : factors_(std::move(factors)) {
    for (const CellFactor& factor : factors_) size_ *= factor.values.size();
  }

  std::size_t size() const { return size_; }

  std::vector<std::string_view> columns() const {
    std::vector<std::string_view> columns;
    for (const CellFactor& factor : factors_) columns.push_back(factor.column);
    return columns;
  }

  // Values of the factors in one cell; the last factor changes fastest.
  std::vector<double> Values(std::size_t cell) const {
    std::vector<double> values(factors_.size());
    for (std::size_t i = factors_.size(); i-- > 0;) {
      const std::vector<double>& list = factors_[i].values;
      values[i] = list[cell % list.size()];
      cell /= list.size();
    }
    return values;
  }

 private:
  std::vector<CellFactor> factors_;
  std::size_t size_ = 1;
};

}  // namespace rockyard::experiments
