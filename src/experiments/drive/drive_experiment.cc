#include "experiments/drive/drive_experiment.h"

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

#include "experiments/cell_experiment.h"
#include "trial/run_trial.h"

namespace rockyard::experiments {
namespace {

// Returns the values of a record. A number that is none is a fault of the simulation (RecordOf),
// unless its column may lack one.
std::vector<double> Values(const truth::DriveRecord& drive) {
  std::vector<double> values;
  values.reserve(truth::kDriveColumns.size());
  for (const truth::DriveColumn& column : truth::kDriveColumns) {
    const double value = drive.*column.member;
    if (!std::isfinite(value) && !(column.may_lack && std::isnan(value))) {
      throw std::runtime_error("the record holds a non-finite " + std::string(column.name));
    }
    values.push_back(value);
  }
  return values;
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

DriveExperiment::DriveExperiment(trial::DriveParams params, trial::Watchers watchers)
    : params_(std::move(params)), watchers_(std::move(watchers)) {}

const truth::RecordSchema& DriveExperiment::schema() const { return DriveSchema(); }

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
    return {index, drive.outcome, drive.detail, Values(drive.record)};
  });
}

}  // namespace rockyard::experiments
