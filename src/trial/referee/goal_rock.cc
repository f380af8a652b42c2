#include "trial/referee/goal_rock.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "math/functions.h"

namespace rockyard::trial {

GoalRock::GoalRock(const terrain::Terrain& terrain, int rock, const Zone& view,
                   const rover::RoverGeometryParams& rover)
    : terrain_(terrain),
      index_(rock),
      view_(view),
      footprint_{-0.5 * rover.length_m, 0.5 * rover.length_m, -0.5 * rover.width_m,
                 0.5 * rover.width_m} {
  EXPECT(rock >= 0 && static_cast<std::size_t>(rock) < terrain.rocks().size());
}

void GoalRock::OnBelieved(const math::Transform& X_WR) {
  if (!found() && Reaches(rock(), view_, X_WR)) sign_ = RockSign::kArray;
}

void GoalRock::Observe(const truth::RoverState& state) {
  if (found()) return;
  const bool touched = std::any_of(
      state.contacts.begin(), state.contacts.end(),
      [&](const auto& contact) { return contact.rock == index_ && contact.normal_force_N > 0.0; });
  if (touched) sign_ = RockSign::kContact;
}

// The rock is round, so that it is the distance of its centre from the rectangle, less its radius.
double GoalRock::Distance_m(const math::Transform& X_WR) const {
  const math::Pose2 pose = math::ToPose2(X_WR);
  const double dx_m = rock().center_W.x() - pose.x_m;
  const double dy_m = rock().center_W.y() - pose.y_m;
  const auto [s, c] = math::SinCos(pose.heading_rad);
  const double ahead_m = std::abs(c * dx_m + s * dy_m) - footprint_.x_high_m;
  const double aside_m = std::abs(c * dy_m - s * dx_m) - footprint_.y_high_m;
  const double centre_m = math::Hypot(std::max(ahead_m, 0.0), std::max(aside_m, 0.0));
  return std::max(centre_m - rock().semi_axes_m.x(), 0.0);
}

double GoalRock::FrontDistance_m(const math::Transform& X_WR) const {
  const math::Pose2 pose = math::ToPose2(X_WR);
  const double front_x_m = pose.x_m + footprint_.x_high_m * math::Cos(pose.heading_rad);
  const double front_y_m = pose.y_m + footprint_.x_high_m * math::Sin(pose.heading_rad);
  const double centre_m =
      math::Hypot(rock().center_W.x() - front_x_m, rock().center_W.y() - front_y_m);
  return std::max(centre_m - rock().semi_axes_m.x(), 0.0);
}

std::optional<GoalRock> GoalRockOf(const DriveParams& drive, const terrain::Terrain& terrain) {
  if (!drive.course.goal_rock.enabled) return std::nullopt;
  // The terrain lists the goal's rock last (terrain/course.h).
  return GoalRock(terrain, static_cast<int>(terrain.rocks().size()) - 1,
                  drive.sensors.terrain_sensors.chosen().reported_zone(drive),
                  drive.rover.geometry);
}

}  // namespace rockyard::trial
