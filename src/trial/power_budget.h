// Electrical power by activity, as the sum of what is switched on.
#pragma once

#include <cstddef>

#include "trial/drive_params.h"

namespace rockyard::trial {

// One major function at a time (Matthies 1995 sec. 2.1.2), unless clock.overlap lets some go on
// beside it.
enum class Activity {
  kDriving,
  kTurning,
  kSteering,
  kScanning,  // with the light stripe sensor
  kStalled,
  kImaging,    // taking stereo images
  kComputing,  // stereo, map and votes
  kOverhead,   // at rest about a move
};
inline constexpr std::size_t kActivityCount = 8;

// Light emitters that are on in the same image, where most are: the lasers of the largest group,
// which are fewer than lasers_per_image where the groups share out evenly (four of five: three and
// two); with a three-scanline fan, one emitter for each row of each of them.
int EmittersAtOnce(const sensing::LightStripeParams& sensor);

struct PowerBudget {
  double base_W = 0.0;      // computer and I/O, gyro
  double guards_W = 0.0;    // sensors that watch the rover while it moves
  double driving_W = 0.0;   // drive motors
  double steering_W = 0.0;  // steering motors
  double imaging_W = 0.0;
  double lasers_W = 0.0;
  double stereo_imaging_W = 0.0;
  double computing_W = 0.0;  // beyond base_W

  // Of everything that an activity needs, W. A scan (Matthies 1995, section 6):
  //   7.33 = 3.77 (computer and I/O) + 0.80 (attitude) + 0.75 (imagers) + 2.01 (two lasers),
  //   2.01 = 2 x 0.66 W of input over the efficiency of the voltage conversion.
  // Accelerometers watch motion and are off while the rover scans: the published sum holds 0.80 W
  // of attitude sensors once.
  double Power(Activity activity) const;
  // Of what an activity adds where it goes on beside another one; 0 where it never does.
  double PowerBeside(Activity activity) const;
};

// The other sensors of table 1 draw their part where they are on; those that table 1 does not list
// (joint encoders, switches, motor currents) draw nothing beyond computer and I/O. A CMOS imager
// takes a tenth of the imaging power (section 6).
PowerBudget MakePowerBudget(const DriveParams& drive);

}  // namespace rockyard::trial
