// Cells of an experiment: every combination of the values of its factors, numbered.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/cell_factor_params.h"
#include "truth/measurement_record.h"

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

// The columns of `known` that records of cells have: the factors, `more`, and what ForEachSum lists
// of Sums.
template <typename Sums>
truth::RecordSchema CellSchema(const truth::RecordSchema& known, const CellTable& table,
                               const std::vector<std::string>& more = {}) {
  const std::vector<std::string_view> factors = table.columns();
  std::vector<std::string> names(factors.begin(), factors.end());
  names.insert(names.end(), more.begin(), more.end());
  ForEachSum(Sums{}, [&](const std::string& name, double) { names.push_back(name); });
  const std::vector<std::string_view> views(names.begin(), names.end());
  return truth::MeasurementSchema(known, views);
}

// Such a record; `values` are those of the factors and of `more`.
template <typename Sums>
truth::Record CellRecord(std::uint64_t index, std::size_t cell, std::vector<double> values,
                         const Sums& sums) {
  values.insert(values.begin(), static_cast<double>(cell));
  ForEachSum(sums, [&](const std::string&, double value) { values.push_back(value); });
  return {index, truth::TrialOutcome::kMeasured, "", std::move(values)};
}

}  // namespace rockyard::experiments
