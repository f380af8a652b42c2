#include "trial/look_time.h"

#include <cmath>

#include "trial/compute_profile.h"
#include "trial/scan_time.h"

namespace rockyard::trial {
namespace {

using scenario::NavigatorKind;
using scenario::TerrainSensor;

ComputeTimes ComputeTimesOf(const scenario::Scenario& scenario) {
  const navigation::GestaltGridParams& grid = scenario.navigation.gestalt.map.grid;
  return MakeComputeTimes(scenario.clock.compute,
                          {.cell_m = std::sqrt(grid.xstep_m * grid.ystep_m),
                           .area_m2 = (grid.xN_m - grid.x0_m) * (grid.yN_m - grid.y0_m)});
}

bool UsesNavigationSoftware(const scenario::Scenario& scenario) {
  return scenario.navigation.navigator == NavigatorKind::kGestalt;
}

bool JudgesElevations(const scenario::Scenario& scenario) {
  return scenario.clock.compute.computer != Computer::kNone && !UsesNavigationSoftware(scenario);
}

}  // namespace

LookTime MakeLookTime(const scenario::Scenario& scenario) {
  const ComputeTimes times = ComputeTimesOf(scenario);
  LookTime look;
  if (UsesNavigationSoftware(scenario)) look.computing_s += times.navigation_s;
  if (scenario.sensors.terrain_sensor == TerrainSensor::kLightStripe) {
    look.scanning_s = ScanTime(scenario.clock, scenario.sensors.light_stripe);
    return look;
  }
  look.imaging_s = times.acquisition_s;
  look.computing_s += times.stereo_s;
  if (JudgesElevations(scenario)) look.computing_s += scenario.clock.compute.behaviour_s;
  return look;
}

double StartUpTime(const scenario::Scenario& scenario) {
  const bool stereo = scenario.sensors.terrain_sensor == TerrainSensor::kStereo;
  return stereo || UsesNavigationSoftware(scenario) ? ComputeTimesOf(scenario).start_up_s : 0.0;
}

}  // namespace rockyard::trial
