#include "vision/cylinder/cylinder_resolution.h"

#include <cmath>
#include <numbers>

namespace rockyard::vision {

double FinestTurn(double m_px) { return 2.0 / m_px; }

double CoarsestTurn(double m_px) { return std::numbers::sqrt2 * FinestTurn(m_px); }

double FinestTurnAt(const ViewOfCylinder& view, double d_m) {
  return 2.0 / view.image_width_px * (d_m / view.radius_m - view.radius_m / d_m) *
         std::tan(0.5 * view.field_of_view_rad);
}

double CoarsestTurnAt(const ViewOfCylinder& view, double d_m) {
  return std::numbers::sqrt2 * FinestTurnAt(view, d_m);
}

double RelativeStepBySize(const ViewOfCylinder& view, double d_m) {
  return d_m * std::tan(0.5 * view.field_of_view_rad) / (view.image_width_px * view.radius_m);
}

double RelativeStepByStereo(const ViewOfCylinder& view, double d_m) {
  return 2.0 * d_m * std::tan(0.5 * view.field_of_view_rad) /
         (view.image_width_px * view.baseline_m);
}

}  // namespace rockyard::vision
