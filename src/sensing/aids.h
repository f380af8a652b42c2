// Aids of localization: the rover's pose as the lander's cameras find it, the direction to the sun,
// range and bearing by radio (Matthies 1995, sections 5 and 8 and appendix A). The world of a drive
// measures with them; the designation of goals shares the lander's place and pan error. A
// measurement is a pure function of pose and number. The trial decides when one is due and when its
// data arrive. All ranges and distances here are horizontal. Records depend on the order of draws.
// Sun: dropout, then both errors. Radio: range, bearing. Fix: range, bearing, heading; its chances:
// found, wrong, turn, range.
#pragma once

#include <cstdint>
#include <optional>

#include "core/random.h"
#include "messages/aids.h"
#include "sensing/aid_params.h"
#include "terrain/terrain.h"

namespace rockyard::sensing {

// How the coloured cylinder on the rover stands before the lander's cameras. theta is the azimuth
// of the cameras in the cylinder's frame (vision/cylinder/colour_cylinder.h).
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

// How well the lander finds the cylinder: a law fitted to rendered views (fit_lander_fix.py). m is
// the width of the cylinder in pixels (2 / m is equation 18 of Matthies 1995), e the sun's
// elevation, phi the camera's angle of view, M the width of the image in pixels, and delta the
// angle from the middle of what is seen to the nearest boundary of quadrants:
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

  // Returns the chance that the cylinder is found: 0 nearer than `nearest_m` and where the sun is
  // not above the horizon.
  double FindChance(const CylinderStance& stance) const;
  // Returns the chance that a cylinder that was found was found wrongly.
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

// The lander's fixes of the rover's pose. A fix is a place in polar coordinates about the lander's
// cameras, and a heading.
//
// By the law `constant` it is range (1 + f n1), bearing + b n2 and heading + h n3, with the
// deviations f, b, h of the parameters and standard normal n; the pan error is added to both
// angles. The covariance of the fix holds these deviations. It leaves out what errors have in
// common from fix to fix, and the pan error. Limits: any colour, light and stance of the rover is
// seen as well as any other; deviations do not depend on the angle of view.
//
// By the law `cylinder` (CylinderLaw) deviations depend on the stance of the rover, errors have
// biases, a fix may be missed, and a fix may be wrong: its heading is off by anything up to
// wrong_turn, its range is multiplied by exp(wrong_range n). A wrong fix has the covariance of a
// right one, as the lander does not know.
class LanderFix {
 public:
  LanderFix(const LanderFixParams& params, const LanderPlace& lander, core::TrialKey key);

  // Returns the fix of the rover at X_WR; nothing beyond the range, or where something hides the
  // rover's top from the mast. `number` counts measurements from 0. Records depend on the
  // substreams of kLanderFix: 0 holds what the fixes of a trial have in common, number + 1 the
  // errors of this fix, kChances + number what becomes of it by the law of the cylinder. Where no
  // sun is given, it stands at that law's `sun_elevation`.
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
  // Returns the errors of a fix: what is drawn anew plus what all fixes share, with variances that
  // add up to 1.
  Draws DrawFix(std::int64_t number) const;
  Outcome ByConstantLaw(const Draws& draws) const;
  // Returns nothing where the cylinder is not found.
  std::optional<Outcome> ByCylinderLaw(const CylinderStance& stance, const Draws& draws,
                                       std::int64_t number) const;

  LanderFixParams params_;
  LanderPlace lander_;
  core::TrialKey key_;
};

// A sun sensor on the rover. The measured direction is the true one, turned about each of two axes
// across it by N(0, sd(e)) with sd(e) = sd exp(depth (1 / sin(e) - 1) / 2) for a sun at elevation
// e: the noise of counted photons, of which exp(-depth / sin e) come through the dust. Limits: the
// sensor tilts with the rover; no bias, no distortion at the edge of its view; the sky's own light
// is left out.
class SunSensor {
 public:
  SunSensor(const SunSensorParams& params, core::TrialKey key) : params_(params), key_(key) {}

  // Returns the measured direction in R. `sun_W` is the unit vector to the true sun. Returns
  // nothing where the sun is out of view, not 1 deg above the horizon, hidden by terrain, or
  // dropped out. `number` counts measurements from 0 (stream kSunSensor, substream number).
  std::optional<messages::SunSighting> Observe(const math::Transform& X_WR,
                                               const math::Vector3& sun_W,
                                               const terrain::Terrain& terrain,
                                               std::int64_t number) const;

  // Returns sd(e), rad, for a sun whose sine of elevation is above 0.
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

  // Returns the reading; nothing beyond the range. `number` counts measurements from 0 (stream
  // kRadioBeacon, substream number).
  std::optional<messages::BeaconReading> Observe(const math::Transform& X_WR,
                                                 std::int64_t number) const;

 private:
  RadioBeaconParams params_;
  LanderPlace station_;
  core::TrialKey key_;
};

}  // namespace rockyard::sensing
