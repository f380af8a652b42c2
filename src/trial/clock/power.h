// Electrical power: what is switched on for each activity, and what solar cells give over the day.
// The ledger of a drive adds it up, and missions plan their sols by it.
#pragma once

#include <cstddef>

#include "trial/drive_params.h"

namespace rockyard::trial {

// What a rover as a whole does: one major function at a time (Matthies 1995 sec. 2.1.2), unless
// clock.overlap lets some go on beside it.
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
// Must stay: the order above, in which arrays by activity, and the columns of energy in records of
// missions (experiments/mission/mission_experiment.h), are listed.
inline constexpr std::size_t kActivityCount = 8;

// Returns how many light emitters are on in the same image, at most: the lasers of the largest
// group, which are fewer than lasers_per_image where groups share the lasers out evenly (four an
// image of five lasers: three and two); with a three-scanline fan, one emitter for each row of each
// laser.
int EmittersAtOnce(const sensing::LightStripeParams& sensor);

// The power of everything that can be switched on.
struct PowerBudget {
  double base_W = 0.0;      // computer and I/O, gyro
  double guards_W = 0.0;    // sensors that watch the rover while it moves
  double driving_W = 0.0;   // drive motors
  double steering_W = 0.0;  // steering motors
  double imaging_W = 0.0;
  double lasers_W = 0.0;
  double stereo_imaging_W = 0.0;
  double computing_W = 0.0;  // beyond base_W

  // Returns the power of everything that an activity needs, W. A scan (Matthies 1995, section 6):
  //   7.33 = 3.77 (computer and I/O) + 0.80 (attitude) + 0.75 (imagers) + 2.01 (two lasers),
  //   2.01 = 2 x 0.66 W of input over the efficiency of the voltage conversion.
  // Accelerometers watch motion and are off while the rover scans: the published sum holds 0.80 W
  // of attitude sensors once.
  double Power(Activity activity) const;
  // Returns the power that an activity adds where it goes on beside another one, W; 0 for
  // activities that never do.
  double PowerBeside(Activity activity) const;
};

// Makes the budget of a drive. Accelerometers draw their power where the rover has them; sensors
// that table 1 does not list (joint encoders, switches, motor currents) draw nothing beyond
// computer and I/O. A CMOS imager takes energy.cmos_imaging_share of the imaging power.
PowerBudget MakePowerBudget(const DriveParams& drive);

// Electrical power of solar cells over the day, and what a load draws beyond it.
//
// A level panel under a clear sky gives power in proportion to the cosine of the sun's zenith
// angle. With latitude phi, declination delta and hour angle H (math/sun_position.h)
//   S(H) = S_noon max(0, a + b cos H) / (a + b),   a = sin phi sin delta,   b = cos phi cos delta,
// and H grows by 2 pi in a sol. Matthies 1995, section 2.1.2: "a peak output of 16 W at noon". A
// steady load P is supplied by the sun as far as that reaches, min(P, S); the rest is the
// shortfall, which batteries have to give. Surplus is lost: these batteries are not rechargeable.
//
// Limits: neither tilt of the panel nor light that the dust scatters, which broadens the arc.
class SolarSupply {
 public:
  // `noon_W`: power at local noon of that day. `start_solar_time_h`: true solar time at time 0. The
  // sun must rise, |latitude - declination| < 90 deg, and the place must not be a pole.
  SolarSupply(double noon_W, double latitude_rad, double declination_rad,
              double start_solar_time_h);

  double Power_W(double time_s) const;

  // Returns what the sun gives from begin_s to end_s >= begin_s, J.
  double Energy_J(double begin_s, double end_s) const;
  // Returns what a steady load takes of the sun's energy, J: the integral of min(load, S).
  double Used_J(double load_W, double begin_s, double end_s) const;
  // Returns what a steady load draws beyond the sun's power, J: the integral of max(0, load - S).
  double Shortfall_J(double load_W, double begin_s, double end_s) const;

  // Returns for how long on either side of noon the sun alone carries the load, s; 0 where it never
  // does.
  double Carries_s(double load_W) const;

 private:
  double HourAngle(double time_s) const;
  // Returns |H| up to which S >= power, rad.
  double CarryingAngle(double power_W) const;
  // Returns the integral of max(0, load - S) from noon to H, J; it is odd in H.
  double ShortSinceNoon_J(double load_W, double hour_angle_rad) const;

  double noon_W_;
  double a_;
  double b_;
  double start_rad_;  // hour angle at time 0
};

}  // namespace rockyard::trial
