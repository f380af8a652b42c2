// Aids of localization: the rover's pose as the lander's cameras find it, the direction to the sun,
// range and bearing by radio (Matthies 1995, sections 5 and 8 and appendix A). Here a measurement
// is a pure function of pose and number; when one is due and when its data arrive is the trial's.
#pragma once

#include <cstdint>
#include <optional>

#include "core/random.h"
#include "messages/aids.h"
#include "sensing/aid_params.h"
#include "terrain/terrain.h"

namespace rockyard::sensing {

// How well the lander finds the coloured cylinder on the rover: a law fitted to rendered views
// (Matthies 1995, section 5 and appendix A; fit_lander_fix.py).

// How the cylinder stands before the lander's cameras. theta is the azimuth of the cameras in the
// cylinder's frame (vision/cylinder/colour_cylinder.h).
struct CylinderStance {
  double distance_m = 0.0;
  double theta_rad = 0.0;
  double sun_elevation_rad = 0.0;
};

struct CylinderDeviations {
  double heading_rad = 0.0;
  double range = 0.0;  // over the range
  double bearing_rad = 0.0;
};

// With m the width in pixels, 2 / m being equation 18 of Matthies 1995, and delta the angle from
// the middle of what is seen to the nearest boundary of quadrants:
//
//   chances      1 / (1 + exp(-odds)), odds = intercept + width ln(m / 20) + no_blue B
//                + pink_aside sin(2 theta) + light sin(e)
//   sd^2 heading   least^2 + (pixels 2 / (m cos(delta)))^2   equations 18 and 19 at 0 and 45 deg
//   sd^2 range     least^2 + (pixels / m)^2                  equation 22
//   sd^2 bearing   least^2 + (pixels 2 tan(phi / 2) / M)^2   one pixel of the image
//
// B is 1 where no blue is seen, -180 < theta < -90 deg, else 0. Limits: light from any side; the
// sun's elevation changes chances and no deviation; one clutter, the mix of the fitted views.
class CylinderLaw {
 public:
  explicit CylinderLaw(const CylinderLawParams& params) : params_(params) {}

  // 0 nearer than `nearest_m` and where the sun is not above the horizon.
  double FindChance(const CylinderStance& stance) const;
  // Of what was found.
  double WrongChance(const CylinderStance& stance) const;
  CylinderDeviations Deviations(const CylinderStance& stance) const;

 private:
  double Width_px(double distance_m) const;
  double Chance(const CylinderChanceParams& chance, const CylinderStance& stance) const;

  CylinderLawParams params_;
};

// Where the lander's cameras stand, in W, and by how much their pan axis is wrong, positive left.
struct LanderPlace {
  double x_m = 0.0;
  double y_m = 0.0;
  double pan_error_rad = 0.0;
};

// Of law `constant`: a fix is a place in polar coordinates about the cameras and a heading: range
// (1 + f n1), bearing + b n2, heading + h n3 with the deviations f, b, h of the parameters and
// standard normal n; pan error added to both angles. The covariance that comes with it knows the
// deviations and neither what they have in common from fix to fix nor the pan error. Limits: any
// colour, light and stance of the rover is seen as well as any other; deviations do not go with the
// angle of view.
//
// Of law `cylinder` (CylinderLaw) the deviations go with the stance of the rover, there
// are biases, a fix may be missed, and one may be wrong: its heading off by anything up to
// wrong_turn, its range times exp(wrong_range n). The covariance is that of a right fix: the lander
// does not know.
class LanderFix {
 public:
  LanderFix(const LanderFixParams& params, const LanderPlace& lander, core::TrialKey key);

  // The fix of the rover at X_WR; nothing beyond the range, or where something hides the rover's
  // top from the mast. `number` counts measurements from 0: stream kLanderFix, substream number +
  // 1; 0 is what the fixes of a trial have in common; kChances + number is what becomes of one by
  // the law of the cylinder. Where no sun is given, it stands at that law's `sun_elevation`.
  std::optional<messages::PoseFix> Observe(
      const math::Transform& X_WR, const terrain::Terrain& terrain, std::int64_t number,
      std::optional<double> sun_elevation_rad = std::nullopt) const;

 private:
  struct Draws {
    double range = 0.0;  // standard normal, as the next
    double bearing = 0.0;
    double heading = 0.0;
  };

  // How a fix comes out: its deviations, known to the lander, and its errors, which are not.
  struct Outcome {
    CylinderDeviations sd;
    double heading_rad = 0.0;
    double range_factor = 1.0;
    double bearing_rad = 0.0;
  };

  Draws Draw(std::uint32_t substream) const;
  // What is drawn anew and what all fixes share, with variances that add up to 1.
  Draws DrawFix(std::int64_t number) const;
  Outcome ByConstantLaw(const Draws& draws) const;
  // Nothing where the cylinder is not found.
  std::optional<Outcome> ByCylinderLaw(const CylinderStance& stance, const Draws& draws,
                                       std::int64_t number) const;

  LanderFixParams params_;
  LanderPlace lander_;
  core::TrialKey key_;
};

// The measured direction is the true one, turned about each of two axes across it by N(0, sd(e))
// with sd(e) = sd exp(depth (1 / sin(e) - 1) / 2) for a sun at elevation e: the noise of counted
// photons, of which exp(-depth / sin e) come through the dust. Limits: the sensor stands as the
// rover does; no bias, no distortion at the edge of its view; the sky's own light is left out.
class SunSensor {
 public:
  SunSensor(const SunSensorParams& params, core::TrialKey key) : params_(params), key_(key) {}

  // `sun_W`: unit vector to the true sun. Nothing where the sun is out of view, not 1 deg above the
  // horizon, hidden by terrain, or dropped out. `number` counts measurements from 0 (stream
  // kSunSensor, substream number).
  std::optional<messages::SunSighting> Observe(const math::Transform& X_WR,
                                               const math::Vector3& sun_W,
                                               const terrain::Terrain& terrain,
                                               std::int64_t number) const;

  // sd(e), rad, of a sun whose sine of elevation is above 0.
  double DirectionSd_rad(double sine_of_elevation) const;

 private:
  SunSensorParams params_;
  core::TrialKey key_;
};

// Range and bearing of the rover as seen from the lander, each with normal errors. Ranges are never
// below 0. Limits: radio is heard through rocks, and reflections disturb nothing.
class RadioBeacon {
 public:
  RadioBeacon(const RadioBeaconParams& params, const LanderPlace& station, core::TrialKey key)
      : params_(params), station_(station), key_(key) {}

  // Nothing beyond the range. `number` counts measurements from 0 (stream kRadioBeacon, substream
  // number).
  std::optional<messages::BeaconReading> Observe(const math::Transform& X_WR,
                                                 std::int64_t number) const;

 private:
  RadioBeaconParams params_;
  LanderPlace station_;
  core::TrialKey key_;
};

}  // namespace rockyard::sensing
