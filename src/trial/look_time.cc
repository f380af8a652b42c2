#include "trial/look_time.h"

#include <optional>
#include <variant>

#include "trial/compute_profile.h"
#include "trial/terrain_sensor_set_params.h"

namespace rockyard::trial {
namespace {

using navigation::CostOfJudgement;
using navigation::CostOfLook;
using navigation::CostOfMap;
using navigation::DecisionCost;

DecisionCost CostOf(const DriveParams& drive) {
  return drive.navigation.navigators.chosen().traits().cost;
}

// The map that the computer sets up when it starts: the navigator's, or where that keeps none, the
// first one of the software, which is on board whoever decides.
GridSize GridOf(const DriveParams& drive) {
  const auto grid_of = [](const DecisionCost& cost) -> std::optional<GridSize> {
    const auto* map = std::get_if<CostOfMap>(&cost);
    if (map == nullptr) return std::nullopt;
    return GridSize{.cell_m = map->cell_m, .area_m2 = map->area_m2};
  };
  if (const auto own = grid_of(CostOf(drive))) return *own;
  for (const auto& kind : drive.navigation.navigators.kinds()) {
    if (const auto other = grid_of(kind->traits().cost)) return *other;
  }
  return {};
}

ComputeTimes ComputeTimesOf(const DriveParams& drive) {
  const sensing::StereoParams* cameras = drive.sensors.terrain_sensors.chosen().cameras(drive);
  const double width_px =
      cameras == nullptr ? kStereoWidth_px : static_cast<double>(cameras->columns);
  return MakeComputeTimes(drive.clock.compute, GridOf(drive), width_px);
}

bool UsesNavigationSoftware(const DriveParams& drive) {
  return std::holds_alternative<CostOfMap>(CostOf(drive));
}

bool JudgesElevations(const DriveParams& drive) {
  return drive.clock.compute.computer != Computer::kNone &&
         std::holds_alternative<CostOfJudgement>(CostOf(drive));
}

}  // namespace

LookTime MakeLookTime(const DriveParams& drive) {
  const ComputeTimes times = ComputeTimesOf(drive);
  LookTime look;
  if (UsesNavigationSoftware(drive)) look.computing_s += times.navigation_s;
  const DecisionCost cost = CostOf(drive);
  if (const auto* own = std::get_if<CostOfLook>(&cost)) look.computing_s += own->time_s;
  const TerrainSensorKind& sensor = drive.sensors.terrain_sensors.chosen();
  const LookTime sensing = sensor.look_time(drive, times);
  look.scanning_s = sensing.scanning_s;
  look.imaging_s = sensing.imaging_s;
  look.computing_s += sensing.computing_s;
  if (sensor.uses_computer() && JudgesElevations(drive)) {
    look.computing_s += drive.clock.compute.behaviour_s;
  }
  return look;
}

double StartUpTime(const DriveParams& drive) {
  const bool computes = drive.sensors.terrain_sensors.chosen().uses_computer();
  return computes || UsesNavigationSoftware(drive) ? ComputeTimesOf(drive).start_up_s : 0.0;
}

}  // namespace rockyard::trial
