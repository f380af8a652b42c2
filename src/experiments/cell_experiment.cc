#include "experiments/cell_experiment.h"

#include "truth/measurement_record.h"

namespace rockyard::experiments {
namespace {

std::vector<std::string_view> Measured(const truth::RecordSchema& known) {
  std::vector<std::string_view> names;
  for (const truth::ValueInfo& column : known) {
    if (column.role != truth::ColumnRole::kFactor) names.push_back(column.name);
  }
  return names;
}

}  // namespace

CellExperiment::CellExperiment(std::vector<CellFactor> factors, const truth::RecordSchema& known)
    : CellExperiment(std::move(factors), known, Measured(known)) {}

CellExperiment::CellExperiment(std::vector<CellFactor> factors, const truth::RecordSchema& known,
                               const std::vector<std::string_view>& measured)
    : table_(std::move(factors)) {
  std::vector<std::string_view> names = table_.columns();
  names.insert(names.end(), measured.begin(), measured.end());
  schema_ = truth::MeasurementSchema(known, names);
}

truth::Record CellExperiment::Run(std::uint64_t seed, std::uint64_t index) const {
  return RecordOf(seed, index, [&](const core::TrialKey& key) {
    const std::size_t cell = index % table_.size();
    std::vector<double> values = table_.Values(cell);
    values.insert(values.begin(), static_cast<double>(cell));
    const std::vector<double> measured = Measure(cell, key);
    values.insert(values.end(), measured.begin(), measured.end());
    return truth::Record{index, truth::TrialOutcome::kMeasured, "", std::move(values)};
  });
}

}  // namespace rockyard::experiments
