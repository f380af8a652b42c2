#include "navigation/gestalt/felt.h"

#include <cmath>

namespace rockyard::navigation {
namespace {

using messages::HazardSide;
using messages::PoseEstimate;
using messages::VehicleHazard;
using messages::VehicleHazardKind;

// Which side a hazard lies on: +1 left, -1 right, 0 ahead.
double Aside(const VehicleHazard& hazard) {
  if (hazard.side == HazardSide::kLeft) return 1.0;
  return hazard.side == HazardSide::kRight ? -1.0 : 0.0;
}

}  // namespace

void FeltPlaces::Feel(const NavigatorInput& input, int direction, const GestaltRoverParams& rover,
                      double radius_m, GestaltMap& map) {
  const PoseEstimate& e = input.estimate;
  const double cosine = std::cos(e.heading_rad);
  const double sine = std::sin(e.heading_rad);
  const auto add = [&](int end, double aside) {
    // In R: half a vehicle to the end that leads, half a width aside; then by the believed pose
    // into the world, p_W = p_WR + Rz(heading) p_R.
    const double x_m = 0.5 * end * rover.length_m;
    const double y_m = 0.5 * aside * rover.width_m;
    places_.push_back({e.x_m + cosine * x_m - sine * y_m, e.y_m + sine * x_m + cosine * y_m});
    map.MarkObstacle(places_.back().x_m, places_.back().y_m, radius_m);
  };
  if (input.vehicle_hazard != nullptr) {
    const bool contact = input.vehicle_hazard->kind == VehicleHazardKind::kContact;
    add(contact ? 1 : direction, Aside(*input.vehicle_hazard));
  }
  if (direction < 0 && input.touches_behind) add(-1, 0.0);
}

void FeltPlaces::Move(const PoseEstimate& before, const PoseEstimate& after, double radius_m,
                      GestaltMap& map) {
  // The jump of the estimate as a rigid motion: p' = after + Rz(turn) (p - before).
  const double turn_rad = after.heading_rad - before.heading_rad;
  const double cosine = std::cos(turn_rad);
  const double sine = std::sin(turn_rad);
  for (Place& place : places_) {
    const double dx_m = place.x_m - before.x_m;
    const double dy_m = place.y_m - before.y_m;
    place = {after.x_m + cosine * dx_m - sine * dy_m, after.y_m + sine * dx_m + cosine * dy_m};
    map.MarkObstacle(place.x_m, place.y_m, radius_m);
  }
}

}  // namespace rockyard::navigation
