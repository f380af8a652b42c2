#include "trial/look_time.h"

#include "trial/compute_profile.h"
#include "trial/scan_time.h"

namespace rockyard::trial {
namespace {

using scenario::NavigatorKind;
using scenario::TerrainSensor;

ComputeTimes ComputeTimesOf(const scenario::Scenario& scenario) {
  return MakeComputeTimes(scenario.clock.compute, {});
}

bool UsesNavigationSoftware(const scenario::Scenario& scenario) {
  return scenario.navigation.navigator == NavigatorKind::kGestalt;
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
  return look;
}

double StartUpTime(const scenario::Scenario& scenario) {
  const bool stereo = scenario.sensors.terrain_sensor == TerrainSensor::kStereo;
  return stereo || UsesNavigationSoftware(scenario) ? ComputeTimesOf(scenario).start_up_s : 0.0;
}

}  // namespace rockyard::trial
