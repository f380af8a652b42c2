#include "trial/look_time.h"

#include <cmath>

#include "trial/compute_profile.h"
#include "trial/scan_time.h"

namespace rockyard::trial {
namespace {

ComputeTimes ComputeTimesOf(const DriveParams& drive) {
  const navigation::GestaltGridParams& grid = drive.navigation.gestalt.map.grid;
  return MakeComputeTimes(drive.clock.compute,
                          {.cell_m = std::sqrt(grid.xstep_m * grid.ystep_m),
                           .area_m2 = (grid.xN_m - grid.x0_m) * (grid.yN_m - grid.y0_m)});
}

bool UsesNavigationSoftware(const DriveParams& drive) {
  return drive.navigation.navigator == NavigatorKind::kGestalt;
}

bool JudgesElevations(const DriveParams& drive) {
  return drive.clock.compute.computer != Computer::kNone && !UsesNavigationSoftware(drive);
}

}  // namespace

LookTime MakeLookTime(const DriveParams& drive) {
  const ComputeTimes times = ComputeTimesOf(drive);
  LookTime look;
  if (UsesNavigationSoftware(drive)) look.computing_s += times.navigation_s;
  if (drive.sensors.terrain_sensor == TerrainSensor::kLightStripe) {
    look.scanning_s = ScanTime(drive.clock, drive.sensors.light_stripe);
    return look;
  }
  look.imaging_s = times.acquisition_s;
  look.computing_s += times.stereo_s;
  if (JudgesElevations(drive)) look.computing_s += drive.clock.compute.behaviour_s;
  return look;
}

double StartUpTime(const DriveParams& drive) {
  const bool stereo = drive.sensors.terrain_sensor == TerrainSensor::kStereo;
  return stereo || UsesNavigationSoftware(drive) ? ComputeTimesOf(drive).start_up_s : 0.0;
}

}  // namespace rockyard::trial
