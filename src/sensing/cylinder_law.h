// How well the lander finds the coloured cylinder on the rover: a law fitted to rendered views
// (Matthies 1995, section 5 and appendix A; fit_lander_fix.py).
#pragma once

#include "sensing/cylinder_law_params.h"

namespace rockyard::sensing {

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
//   sd heading   least^2 + (pixels 2 / (m cos(delta)))^2     equations 18 and 19 at 0 and 45 deg
//   sd range     least^2 + (pixels / m)^2                    equation 22
//   sd bearing   least^2 + (pixels 2 tan(phi / 2) / M)^2     one pixel of the image
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

}  // namespace rockyard::sensing
