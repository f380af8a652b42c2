#include "experiments/mission/mission_experiment.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "experiments/mission/mission.h"
#include "experiments/mission/sol.h"
#include "math/angles.h"

namespace rockyard::experiments {

const truth::RecordSchema& MissionColumns() {
  static const truth::RecordSchema kColumns = ColumnsOf<MissionRecord>({}, {{}, {}});
  return kColumns;
}

namespace {

// Missions that a seed can have: sols of all of them have keys of their own (SolKey).
constexpr std::uint64_t kMissions = (std::uint64_t{1} << 32) / kMostSols;

truth::RecordSchema ColumnsWithSols(const MissionParams& params) {
  truth::RecordSchema columns = MissionColumns();
  if (!params.sol_columns) return columns;
  for (std::int64_t sol = 1; sol <= params.sols; ++sol) {
    ForEachSolColumn(sol, nullptr,
                     [&](const truth::ValueInfo& column, double) { columns.push_back(column); });
  }
  return columns;
}

}  // namespace

MissionExperiment::MissionExperiment(const MissionParams& params, trial::DriveParams drive)
    : CellExperiment({}, ColumnsWithSols(params)), params_(params), drive_(std::move(drive)) {}

std::vector<double> MissionExperiment::Measure(std::size_t /*cell*/, core::TrialKey key) const {
  if (key.trial >= kMissions) {
    throw std::out_of_range("missions end at 2^22 - 1: their sols share the random key's 2^32");
  }
  const MissionRecord mission(params_, Mission(params_, drive_, key).Run());
  std::vector<double> values = ValuesOf(mission);
  if (!params_.sol_columns) return values;
  const std::vector<Sol>& sols = mission.course.sols;
  for (std::int64_t sol = 1; sol <= params_.sols; ++sol) {
    const auto i = static_cast<std::size_t>(sol - 1);
    ForEachSolColumn(sol, i < sols.size() ? &sols[i] : nullptr,
                     [&](const truth::ValueInfo&, double value) { values.push_back(value); });
  }
  return values;
}

namespace {

Checkpoint CheckpointAfter(std::int64_t sols, const MissionCourse& course) {
  const auto lasted = static_cast<std::int64_t>(course.sols.size());
  if (lasted == 0) return {};
  const Sol& sol = course.sols[static_cast<std::size_t>(std::min(sols, lasted) - 1)];
  return {.lasted = lasted >= sols,
          .position_error_m = sol.PositionError_m(),
          .heading_error_deg = math::RadToDeg(sol.HeadingError_rad()),
          .position_sd_m = sol.position_sd_m.value_or(0.0),
          .judged = sol.inside_95.has_value(),
          .inside_95 = sol.inside_95.value_or(false),
          .goal_frame_error_m = sol.goal_frame_error_m,
          .goal_frame_inside_95 = sol.goal_frame_inside_95.value_or(false)};
}

}  // namespace

namespace mission_columns {

truth::ValueInfo Count(const std::string& name, const std::string& meaning, const std::string& of) {
  return {name, "1", meaning, truth::ColumnRole::kCount, of};
}

truth::ValueInfo Sum(const std::string& name, const std::string& unit, const std::string& meaning,
                     const std::string& of) {
  return {name, unit, meaning, truth::ColumnRole::kSum, of};
}

}  // namespace mission_columns

MissionRecord::MissionRecord(const MissionParams& params, MissionCourse of)
    : goals(static_cast<std::int64_t>(params.goals.Places().size())),
      spare_images(SpareImages(params.day)),
      course(std::move(of)),
      battery_left_wh(params.power.battery_wh) {
  for (std::size_t i = 0; i < kCheckpoints.size(); ++i) {
    checkpoints[i] = CheckpointAfter(kCheckpoints[i], course);
  }
  for (const Sol& sol : course.sols) {
    distance_m += sol.distance_m;
    longest_sol_m = std::max(longest_sol_m, sol.distance_m);
    ++sol_ends[static_cast<std::size_t>(sol.end)];
    const bool unseen_there = sol.sight == LanderSight::kUnseen;
    if (unseen_there || sol.sight == LanderSight::kFound) ++sights;
    if (unseen_there) ++unseen;
    energy += sol.energy;
    battery_left_wh = sol.battery_left_wh;
  }
}

}  // namespace rockyard::experiments
