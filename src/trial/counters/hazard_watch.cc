#include "trial/counters/hazard_watch.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/functions.h"

namespace rockyard::trial {
namespace {

using Point = Eigen::Vector2d;

double DistanceToSegment(const Point& a, const Point& b) {
  const Point along = b - a;
  const double share = std::clamp(-a.dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (a + share * along).norm();
}

double Cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

double FarthestCorner(const Zone& zone) {
  return math::Hypot(std::max(std::abs(zone.x_low_m), std::abs(zone.x_high_m)),
                     std::max(std::abs(zone.y_low_m), std::abs(zone.y_high_m)));
}

}  // namespace

// In coordinates in which the rock's outline is the unit circle the zone is a parallelogram:
// outline and zone meet where the origin is inside the parallelogram or within 1 of an edge of it.
bool Reaches(const terrain::Rock& rock, const Zone& zone, const math::Transform& X_WR) {
  const math::SineCosine yaw = math::SinCos(rock.yaw_rad);
  const math::Pose2 pose = math::ToPose2(X_WR);
  const math::SineCosine heading = math::SinCos(pose.heading_rad);
  const auto corner = [&](double x_m, double y_m) {
    const double dx = pose.x_m + heading.cos * x_m - heading.sin * y_m - rock.center_W.x();
    const double dy = pose.y_m + heading.sin * x_m + heading.cos * y_m - rock.center_W.y();
    return Point((yaw.cos * dx + yaw.sin * dy) / rock.semi_axes_m.x(),
                 (yaw.cos * dy - yaw.sin * dx) / rock.semi_axes_m.y());
  };
  const std::array corners{corner(zone.x_low_m, zone.y_low_m), corner(zone.x_high_m, zone.y_low_m),
                           corner(zone.x_high_m, zone.y_high_m),
                           corner(zone.x_low_m, zone.y_high_m)};
  bool inside = true;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point& a = corners[i];
    const Point& b = corners[(i + 1) % corners.size()];
    if (DistanceToSegment(a, b) <= 1.0) return true;
    inside = inside && Cross(a, b) >= 0.0;
  }
  return inside;
}

Zone ArrayZone(const sensing::LightStripeParams& sensor) {
  return {sensor.front_x_m, sensor.front_x_m + sensor.row_ahead_m.back(), -sensor.outer_stripe_y_m,
          sensor.outer_stripe_y_m};
}

HazardWatch::HazardWatch(const Zone& view, const rover::RoverGeometryParams& rover,
                         double min_height_m, const terrain::Terrain& terrain)
    : terrain_(terrain), view_(view) {
  const double front_m = 0.5 * rover.length_m;
  const double side_m = 0.5 * rover.width_m;
  const double inner_m = side_m - rover.wheel_width_m;
  front_and_wheels_ = {{front_m - 2.0 * rover.wheel_radius_m, front_m, -side_m, side_m},
                       {-front_m, front_m, inner_m, side_m},
                       {-front_m, front_m, -side_m, -inner_m}};
  reach_m_ = FarthestCorner(view_);
  for (const Zone& zone : front_and_wheels_) reach_m_ = std::max(reach_m_, FarthestCorner(zone));
  const auto rocks = terrain.rocks();
  for (std::size_t i = 0; i < rocks.size(); ++i) {
    if (rocks[i].height_m >= min_height_m) hazards_.push_back({static_cast<int>(i)});
  }
}

void HazardWatch::Observe(const math::Transform& X_WR) {
  if (hazards_.empty()) return;
  const auto moved_W = X_WR.translation() - looked_from_X_WR_.translation();
  const double turn_cosine = X_WR.linear().col(0).dot(looked_from_X_WR_.linear().col(0));
  if (looked_ && moved_W.squaredNorm() < kLook_m * kLook_m && turn_cosine > kLookCosine) return;
  looked_ = true;
  looked_from_X_WR_ = X_WR;
  Look(X_WR);
}

bool HazardWatch::IsNear(const terrain::Rock& rock, const math::Transform& X_WR) const {
  const double far_m = reach_m_ + rock.semi_axes_m.x();
  return (rock.center_W - X_WR.translation()).head<2>().squaredNorm() <= far_m * far_m;
}

void HazardWatch::Look(const math::Transform& X_WR) {
  for (Hazard& hazard : hazards_) {
    if (hazard.settled) continue;
    const terrain::Rock& rock = terrain_.rocks()[static_cast<std::size_t>(hazard.rock)];
    if (!IsNear(rock, X_WR)) continue;
    if (!hazard.met && Reaches(rock, view_, X_WR)) {
      hazard.met = true;
      ++met_;
    }
    if (!hazard.met) continue;
    hazard.settled = std::any_of(front_and_wheels_.begin(), front_and_wheels_.end(),
                                 [&](const Zone& zone) { return Reaches(rock, zone, X_WR); });
    if (hazard.settled) ++missed_;
  }
}

void HazardWatch::OnBelieved(const math::Transform& X_WR) {
  for (Hazard& hazard : hazards_) {
    const terrain::Rock& rock = terrain_.rocks()[static_cast<std::size_t>(hazard.rock)];
    if (hazard.settled || !IsNear(rock, X_WR) || !Reaches(rock, view_, X_WR)) continue;
    // A hazard that is believed before the next look of the watch has been met all the same.
    if (!hazard.met) ++met_;
    hazard.met = true;
    hazard.settled = true;
  }
}

}  // namespace rockyard::trial
