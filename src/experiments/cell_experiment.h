// What the experiments have in common that measure rather than drive to a goal: cells, and the
// records of their runs. Each of them derives from CellExperiment, missions and three-rock runs,
// which have one cell, included.
//
// Words: a factor is a list of a scenario, a cell is one combination of the values of all factors,
// a scene is one independent measurement (a view, a walk, a look, ...) with a random key of its
// own, and a run is a block of scenes of one cell. Run i belongs to cell i modulo their number, so
// that every prefix of the runs covers the cells evenly. Its record holds the cell's factors, then
// counts and sums, so that the records of a cell add up. Its outcome is `measured`.
//
// The sums of an experiment list their columns themselves: ForEachColumn(sums, visit) calls
// visit(column, value) for every column in the order of the records, `column` being a
// truth::ValueInfo. It is one list for the schema (ColumnsOf) and for the values (ValuesOf).
//
// Must stay: which cell a run belongs to, SceneKey's number, under which every scene draws, and
// names and order of the columns, which are part of a stored run. Where one is renamed, moved or
// added, the run cannot be resumed; where one is moved or added, it has another hash.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/random.h"
#include "experiments/cell_factor_params.h"
#include "experiments/experiment.h"
#include "truth/record.h"

namespace rockyard::experiments {

// Returns the record that `measure` gives of the trial's key. What `measure` throws comes back as a
// simulator fault, but for failures of the machine, which tell nothing of the trial: they are
// thrown on. The experiment `drive` uses it, too.
template <typename Measure>
truth::Record RecordOf(std::uint64_t seed, std::uint64_t index, const Measure& measure) {
  try {
    if (index > std::numeric_limits<std::uint32_t>::max()) {
      throw std::out_of_range("trial indices end at 2^32 - 1, the size of their random key");
    }
    return measure(core::TrialKey{seed, static_cast<std::uint32_t>(index)});
  } catch (const std::exception& error) {
    if (core::IsMachineFailure(error)) throw;
    return truth::MakeFault(seed, index, error.what());
  }
}

// Returns a key of its own for every scene of every run, so that nothing that lasts from scan to
// scan (outliers that persist) links two scenes. Throws std::out_of_range where 32 bits end.
inline core::TrialKey SceneKey(core::TrialKey run, std::int64_t scenes_per_run,
                               std::int64_t scene) {
  const std::uint64_t number =
      std::uint64_t{run.trial} * static_cast<std::uint64_t>(scenes_per_run) +
      static_cast<std::uint64_t>(scene);
  if (number > std::numeric_limits<std::uint32_t>::max()) {
    throw std::out_of_range("scenes end at 2^32 - 1, the size of their random key");
  }
  return {run.seed, static_cast<std::uint32_t>(number)};
}

// Cells of an experiment: every combination of the values of its factors, numbered.
class CellTable {
 public:
  // No list may be empty. Without factors there is one cell.
  explicit CellTable(std::vector<CellFactor> factors) : factors_(std::move(factors)) {
    for (const CellFactor& factor : factors_) size_ *= factor.values.size();
  }

  std::size_t size() const { return size_; }

  std::vector<std::string_view> columns() const {
    std::vector<std::string_view> columns;
    for (const CellFactor& factor : factors_) columns.push_back(factor.column);
    return columns;
  }

  // Returns the values of the factors in one cell; the last factor changes fastest.
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

// Returns `factors`, then the columns of Sums.
template <typename Sums>
truth::RecordSchema ColumnsOf(truth::RecordSchema factors = {}, const Sums& sums = {}) {
  ForEachColumn(sums, [&](const truth::ValueInfo& column, double) { factors.push_back(column); });
  return factors;
}

// Returns `before`, then the values of the columns of `sums`.
template <typename Sums>
std::vector<double> ValuesOf(const Sums& sums, std::vector<double> before = {}) {
  ForEachColumn(sums, [&](const truth::ValueInfo&, double value) { before.push_back(value); });
  return before;
}

// Sum and sum of squares of an error.
struct ErrorSums {
  double sum = 0.0;
  double squares = 0.0;

  void Add(double error) {
    sum += error;
    squares += error * error;
  }
};

// Visits the two columns of an error: <name>_bias<ending> and <name>_error<ending>, with the unit,
// meaning and base of `like`.
template <typename Visitor>
void VisitError(const std::string& name, const std::string& ending, const truth::ValueInfo& like,
                const ErrorSums& sums, const Visitor& visit) {
  using enum truth::ColumnRole;
  visit(truth::ValueInfo{name + "_bias" + ending, like.unit, like.meaning, kSum, like.of},
        sums.sum);
  visit(truth::ValueInfo{name + "_error" + ending, like.unit, like.meaning, kSquares, like.of},
        sums.squares);
}

class CellExperiment : public Experiment {
 public:
  const truth::RecordSchema& schema() const final { return schema_; }

  // Returns a record of the number of the cell, its factors and what Measure gives; the outcome is
  // `measured`.
  truth::Record Run(std::uint64_t seed, std::uint64_t index) const final;

 protected:
  // `known` are all columns that a record of the experiment may have but the number of the cell.
  // `measured` are the names of the columns that follow the factors, in the order in which Measure
  // gives them; by default all that are no factors.
  CellExperiment(std::vector<CellFactor> factors, const truth::RecordSchema& known);
  CellExperiment(std::vector<CellFactor> factors, const truth::RecordSchema& known,
                 const std::vector<std::string_view>& measured);

  const CellTable& table() const { return table_; }

 private:
  // Returns the values of the measured columns for a block of scenes of one cell. Must be a pure
  // function of its arguments, and draw under keys made of `key` alone (SceneKey).
  virtual std::vector<double> Measure(std::size_t cell, core::TrialKey key) const = 0;

  CellTable table_;
  truth::RecordSchema schema_;
};

}  // namespace rockyard::experiments
