#include "sensing/cylinder_law.h"

#include <cmath>
#include <numbers>

#include "math/angles.h"
#include "vision/cylinder/colour_cylinder.h"
#include "vision/cylinder/cylinder_equations.h"

namespace rockyard::sensing {
namespace {

constexpr double kQuadrant_rad = 0.5 * std::numbers::pi;
constexpr double kWidthOfIntercept_px = 20.0;

bool ShowsNoBlue(double theta_rad) {
  const double theta = math::WrapAngle(theta_rad);
  return theta > -std::numbers::pi && theta < -kQuadrant_rad;
}

double ToNearestBoundary_rad(double theta_rad) {
  return std::abs(std::remainder(theta_rad, kQuadrant_rad));
}

double RootSum(const CylinderDeviationParams& deviation, double step) {
  return std::hypot(deviation.least, deviation.pixels * step);
}

}  // namespace

double CylinderLaw::Width_px(double distance_m) const {
  const vision::ViewOfCylinder view{.image_width_px = params_.image_width_px,
                                    .field_of_view_rad = params_.field_of_view_rad,
                                    .radius_m = 0.5 * vision::ColourCylinder{}.diameter_m};
  return 2.0 / vision::FinestTurnAt(view, distance_m);
}

double CylinderLaw::Chance(const CylinderChanceParams& chance, const CylinderStance& stance) const {
  const double odds = chance.intercept +
                      chance.width * std::log(Width_px(stance.distance_m) / kWidthOfIntercept_px) +
                      (ShowsNoBlue(stance.theta_rad) ? chance.no_blue : 0.0) +
                      chance.pink_aside * std::sin(2.0 * stance.theta_rad) +
                      chance.light * std::sin(stance.sun_elevation_rad);
  return 1.0 / (1.0 + std::exp(-odds));
}

double CylinderLaw::FindChance(const CylinderStance& stance) const {
  if (stance.distance_m < params_.nearest_m || stance.sun_elevation_rad <= 0.0) return 0.0;
  return Chance(params_.found, stance);
}

double CylinderLaw::WrongChance(const CylinderStance& stance) const {
  return Chance(params_.wrong, stance);
}

CylinderDeviations CylinderLaw::Deviations(const CylinderStance& stance) const {
  const double m_px = Width_px(stance.distance_m);
  const double turn_step = 2.0 / (m_px * std::cos(ToNearestBoundary_rad(stance.theta_rad)));
  const double pixel_rad = 2.0 * std::tan(0.5 * params_.field_of_view_rad) / params_.image_width_px;
  return {.heading_rad = RootSum(params_.heading, turn_step),
          .range = RootSum(params_.range, 1.0 / m_px),
          .bearing_rad = RootSum(params_.bearing, pixel_rad)};
}

}  // namespace rockyard::sensing
