#include "experiments/mission/mission_experiment.h"

#include <stdexcept>
#include <utility>
#include <vector>

#include "experiments/mission/mission.h"
#include "experiments/mission/mission_record.h"
#include "experiments/record_of.h"
#include "truth/measurement_record.h"

namespace rockyard::experiments {

const truth::RecordSchema& MissionColumns() {
  static const truth::RecordSchema kColumns = [] {
    truth::RecordSchema columns;
    ForEachMissionColumn(MissionRecord({}, {}), [&](const truth::ValueInfo& column, double) {
      columns.push_back(column);
    });
    return columns;
  }();
  return kColumns;
}

namespace {

// Sols of all missions of a seed have keys of their own.
constexpr std::uint64_t kMissions = (std::uint64_t{1} << 32) / kMostSols;

truth::RecordSchema SchemaOf(const MissionParams& params) {
  truth::RecordSchema schema = truth::MeasurementSchema(MissionColumns());
  if (!params.sol_columns) return schema;
  for (std::int64_t sol = 1; sol <= params.sols; ++sol) {
    ForEachSolColumn(sol, nullptr,
                     [&](const truth::ValueInfo& column, double) { schema.push_back(column); });
  }
  return schema;
}

}  // namespace

MissionExperiment::MissionExperiment(const MissionParams& params, trial::DriveParams drive)
    : params_(params), drive_(std::move(drive)), schema_(SchemaOf(params)) {}

truth::Record MissionExperiment::Run(std::uint64_t seed, std::uint64_t index) const {
  return RecordOf(seed, index, [&](const core::TrialKey& key) -> truth::Record {
    if (index >= kMissions) {
      throw std::out_of_range("missions end at 2^22 - 1: their sols share the random key's 2^32");
    }
    const MissionRecord mission(params_, Mission(params_, drive_, key).Run());
    std::vector<double> values{0.0};
    const auto keep = [&](const truth::ValueInfo&, double value) { values.push_back(value); };
    ForEachMissionColumn(mission, keep);
    if (params_.sol_columns) {
      const std::vector<Sol>& sols = mission.course.sols;
      for (std::int64_t sol = 1; sol <= params_.sols; ++sol) {
        const auto i = static_cast<std::size_t>(sol - 1);
        ForEachSolColumn(sol, i < sols.size() ? &sols[i] : nullptr, keep);
      }
    }
    return {index, truth::TrialOutcome::kMeasured, "", std::move(values)};
  });
}

}  // namespace rockyard::experiments
