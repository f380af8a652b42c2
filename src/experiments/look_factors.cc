#include "experiments/look_factors.h"

#include "math/angles.h"

namespace rockyard::experiments {

trial::DriveParams WithLookFactors(trial::DriveParams drive,
                                   const std::vector<std::string_view>& columns,
                                   const std::vector<double>& values) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i] == "soil_graininess") {
      drive.sensors.look.soil_graininess = values[i];
    } else if (columns[i] == "sun_elevation_deg") {
      drive.sensors.sun.elevation_rad = math::DegToRad(values[i]);
    } else if (columns[i] == "baseline_m") {
      drive.sensors.stereo.baseline_m = values[i];
    }
  }
  return drive;
}

}  // namespace rockyard::experiments
