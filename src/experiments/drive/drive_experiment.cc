#include "experiments/drive/drive_experiment.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/numbers.h"
#include "experiments/cell_experiment.h"
#include "trial/run_trial.h"

namespace rockyard::experiments {
namespace {

// Returns the values of a record. A number that is none is a fault of the simulation (RecordOf),
// unless its column may lack one.
std::vector<double> Values(const truth::DriveRecord& drive, std::size_t columns) {
  std::vector<double> values;
  values.reserve(columns);
  for (const truth::DriveColumn& column : truth::kDriveColumns) {
    const double value = drive.*column.member;
    if (!std::isfinite(value) && !(column.may_lack && std::isnan(value))) {
      throw std::runtime_error("the record holds a non-finite " + std::string(column.name));
    }
    values.push_back(value);
  }
  return values;
}

// Appends the own values of all kinds of a set, `own` being those of the chosen one. One that
// failed before it had any has none.
template <typename Set>
void AppendOwn(const Set& set, std::span<const double> own, std::vector<double>& values) {
  for (const auto& kind : set.kinds()) {
    const bool drives = kind.get() == &set.chosen();
    for (std::size_t i = 0; i < kind->own_values().size(); ++i) {
      const bool has = drives && i < own.size() && std::isfinite(own[i]);
      values.push_back(has ? own[i] : core::kNaN);
    }
  }
}

template <typename Set>
void AppendColumns(const Set& set, truth::RecordSchema& schema) {
  for (const auto& kind : set.kinds()) {
    for (const messages::OwnValue& value : kind->own_values()) {
      schema.push_back({truth::OwnColumn(kind->name(), value.name), value.unit, value.meaning});
    }
  }
}

}  // namespace

const truth::RecordSchema& DriveSchema() {
  static const truth::RecordSchema kSchema = [] {
    truth::RecordSchema schema;
    for (const truth::DriveColumn& column : truth::kDriveColumns) {
      schema.push_back(
          {std::string(column.name), std::string(column.unit), std::string(column.meaning)});
    }
    return schema;
  }();
  return kSchema;
}

truth::RecordSchema DriveSchema(const trial::DriveParams& drive) {
  truth::RecordSchema schema = DriveSchema();
  AppendColumns(drive.navigation.navigators, schema);
  AppendColumns(drive.localization.estimators, schema);
  return schema;
}

DriveExperiment::DriveExperiment(trial::DriveParams params, trial::Watchers watchers)
    : params_(trial::ShareTables(std::move(params))),
      watchers_(std::move(watchers)),
      schema_(DriveSchema(params_)) {}

const truth::RecordSchema& DriveExperiment::schema() const { return schema_; }

truth::Record DriveExperiment::Run(std::uint64_t seed, std::uint64_t index) const {
  return RunTrial(seed, index, nullptr);
}

truth::Record DriveExperiment::RunTraced(std::uint64_t seed, std::uint64_t index,
                                         truth::Trace& trace) const {
  return RunTrial(seed, index, &trace);
}

truth::Record DriveExperiment::RunTrial(std::uint64_t seed, std::uint64_t index,
                                        truth::Trace* trace) const {
  return RecordOf(seed, index, [&](const core::TrialKey& key) -> truth::Record {
    const trial::DriveResult drive = trial::RunTrial(params_, key, trace, watchers_);
    std::vector<double> values = Values(drive.record, schema_.size());
    AppendOwn(params_.navigation.navigators, drive.own_values.navigator, values);
    AppendOwn(params_.localization.estimators, drive.own_values.estimator, values);
    return {index, drive.outcome, drive.detail, std::move(values)};
  });
}

}  // namespace rockyard::experiments
