#include "navigation/enav/linkage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/check.h"
#include "math/functions.h"

namespace rockyard::navigation {
namespace {

using messages::PerWheel;

double Facing(const messages::RoverBelief& rover) {
  return rover.suspension.bogies_at_front ? -1.0 : 1.0;
}

std::array<std::size_t, 3> Axles(const messages::RoverBelief& rover) {
  return rover.suspension.bogies_at_front ? std::array<std::size_t, 3>{2, 1, 0}
                                          : std::array<std::size_t, 3>{0, 1, 2};
}

double MeanRadius_m(const messages::DriveCalibration& drive) {
  double sum = 0.0;
  for (const double ratio : drive.radius_ratio) sum += ratio;
  return drive.wheel_radius_m * sum / static_cast<double>(messages::kWheelCount);
}

// Of the left side.
JointTriangle::Point WheelCentre(const messages::RoverBelief& rover, std::size_t place) {
  return {Facing(rover) * rover.drive.wheel_x_m[Axles(rover)[place]], MeanRadius_m(rover.drive)};
}

JointTriangle::Point BogieJoint(const messages::RoverBelief& rover) {
  return {Facing(rover) * rover.suspension.bogie_pivot_x_m, rover.suspension.bogie_pivot_z_m};
}

JointTriangle::Point RockerJoint(const messages::RoverBelief& rover) {
  return {Facing(rover) * rover.suspension.rocker_pivot_x_m, rover.suspension.rocker_pivot_z_m};
}

double Distance_m(const JointTriangle::Point& p, const JointTriangle::Point& q) {
  return math::Hypot(p.x_m - q.x_m, p.z_m - q.z_m);
}

// Half of it each, of two intervals.
Interval Mean(const Interval& p, const Interval& q) {
  return {0.5 * (p.low + q.low), 0.5 * (p.high + q.high)};
}

Interval Less(const Interval& p, const Interval& q) { return {p.low - q.high, p.high - q.low}; }

// The smallest and the largest cosine of angles within a quarter turn.
Interval Cosines(const Interval& angle_rad) {
  const bool straddles = angle_rad.low <= 0.0 && angle_rad.high >= 0.0;
  const double low = std::abs(angle_rad.low);
  const double high = std::abs(angle_rad.high);
  return {math::Cos(std::max(low, high)), straddles ? 1.0 : math::Cos(std::min(low, high))};
}

Interval Times(const Interval& p, const Interval& q) {
  const auto [low, high] =
      std::minmax({p.low * q.low, p.low * q.high, p.high * q.low, p.high * q.high});
  return {low, high};
}

Interval Scaled(double factor, const Interval& p) { return Times({factor, factor}, p); }

}  // namespace

Interval NoInterval() {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  return {kNone, -kNone};
}

void Include(double value, Interval& interval) {
  interval.low = std::min(interval.low, value);
  interval.high = std::max(interval.high, value);
}

JointTriangle::JointTriangle(const Point& a, const Point& b, const Point& c)
    : ca_m_(Distance_m(c, a)),
      ab_m_(Distance_m(a, b)),
      rest_rad_(math::Atan2(c.z_m - a.z_m, a.x_m - c.x_m)) {
  EXPECT(a.x_m > c.x_m && c.x_m > b.x_m);
  included_rad_ = rest_rad_ - math::Asin((b.z_m - a.z_m) / ab_m_);
}

double JointTriangle::Angle_rad(double z_a_m, double z_b_m) const {
  return included_rad_ + math::Asin((z_a_m - z_b_m) / ab_m_);
}

double JointTriangle::JointZ_m(double z_a_m, double angle_rad) const {
  return z_a_m - ca_m_ * math::Sin(angle_rad);
}

// With u = z_a - z_b the joint lies at the share s(u) = l_ca cos(kappa) / (l_ab cos(asin(u /
// l_ab))) of the way from a to b, seen from above; dz_c/dz_a = 1 - s and dz_c/dz_b = s. s falls as
// u grows.
bool JointTriangle::IsMonotone(const Interval& z_a_m, const Interval& z_b_m) const {
  const Interval u_m = Less(z_a_m, z_b_m);
  if (!(std::max(-u_m.low, u_m.high) < ab_m_)) return false;
  const auto share = [&](double difference_m) {
    const double slope_rad = math::Asin(difference_m / ab_m_);
    return ca_m_ * math::Cos(included_rad_ + slope_rad) / (ab_m_ * math::Cos(slope_rad));
  };
  return share(u_m.low) <= 1.0 && share(u_m.high) >= 0.0;
}

// One side: wheels first, then joints.
struct AceLinkage::Side {
  Interval bogie_rad;   // kappa_b
  Interval rocker_rad;  // kappa_d
  Interval joint_z_m;   // z_d
};

AceLinkage::AceLinkage(const messages::RoverBelief& rover)
    : facing_(Facing(rover)),
      axles_(Axles(rover)),
      wheel_radius_m_(MeanRadius_m(rover.drive)),
      pivot_x_m_(RockerJoint(rover).x_m),
      pivot_y_m_(rover.suspension.pivot_y_m),
      pivot_z_m_(-rover.suspension.rocker_pivot_z_m),
      bogie_(WheelCentre(rover, 1), WheelCentre(rover, 2), BogieJoint(rover)),
      rocker_(WheelCentre(rover, 0), BogieJoint(rover), RockerJoint(rover)) {
  EXPECT(pivot_y_m_ > 0.0);
}

std::optional<SuspensionState<double>> AceLinkage::Stand(const PerWheel<double>& ground_z_m) const {
  PerWheel<Interval> exact;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) exact[i] = {ground_z_m[i], ground_z_m[i]};
  const auto bounds = Bound(exact);
  if (!bounds) return std::nullopt;
  return SuspensionState<double>{bounds->roll_rad.low,
                                 bounds->pitch_rad.low,
                                 bounds->rocker_rad.low,
                                 {bounds->bogie_rad[0].low, bounds->bogie_rad[1].low},
                                 bounds->origin_z_m.low};
}

std::optional<SuspensionState<Interval>> AceLinkage::Bound(
    const PerWheel<Interval>& ground_z_m) const {
  std::array<Side, 2> sides;
  for (std::size_t side = 0; side < 2; ++side) {
    // Centres of the wheels: above the ground by their radius, which counts here once.
    const auto centre = [&](std::size_t place) -> Interval {
      const Interval& ground = ground_z_m[3 * side + axles_[place]];
      return {ground.low - wheel_radius_m_, ground.high - wheel_radius_m_};
    };
    const Interval f = centre(0), m = centre(1), r = centre(2);
    if (!bogie_.IsMonotone(m, r)) return std::nullopt;
    const auto joint = [](const JointTriangle& triangle, double z_a_m, double z_b_m) {
      return triangle.JointZ_m(z_a_m, triangle.Angle_rad(z_a_m, z_b_m));
    };
    const Interval b{joint(bogie_, m.low, r.low), joint(bogie_, m.high, r.high)};  // [13]
    if (!rocker_.IsMonotone(f, b)) return std::nullopt;
    sides[side] = {{bogie_.Angle_rad(m.low, r.high), bogie_.Angle_rad(m.high, r.low)},
                   {rocker_.Angle_rad(f.low, b.high), rocker_.Angle_rad(f.high, b.low)},
                   {joint(rocker_, f.low, b.low), joint(rocker_, f.high, b.high)}};  // [14]
  }
  const auto& [left, right] = sides;
  const Interval drop_m = Less(right.joint_z_m, left.joint_z_m);
  if (!(std::max(-drop_m.low, drop_m.high) < 2.0 * pivot_y_m_)) return std::nullopt;

  SuspensionState<Interval> state;
  state.roll_rad = {math::Asin(drop_m.low / (2.0 * pivot_y_m_)),  // [19]
                    math::Asin(drop_m.high / (2.0 * pivot_y_m_))};
  const double rest_rad = rocker_.rest_rad();
  const Interval mean_rad = Mean(left.rocker_rad, right.rocker_rad);
  state.pitch_rad = {rest_rad - mean_rad.high, rest_rad - mean_rad.low};    // [20]
  state.rocker_rad = Scaled(0.5, Less(right.rocker_rad, left.rocker_rad));  // [16]
  for (std::size_t side = 0; side < 2; ++side) {                            // [17, 18]
    const Interval both = Less(sides[side].rocker_rad, sides[side].bogie_rad);
    const double at_rest_rad = rest_rad - bogie_.rest_rad();
    state.bogie_rad[side] = {both.low - at_rest_rad, both.high - at_rest_rad};
  }
  // [21]: z_o = mean z_d + x_od sin(pitch) cos(roll) - z_od cos(pitch) cos(roll).
  const Interval sines{math::Sin(state.pitch_rad.low), math::Sin(state.pitch_rad.high)};
  const Interval cos_roll = Cosines(state.roll_rad);
  const Interval ahead = Scaled(pivot_x_m_, Times(sines, cos_roll));
  const Interval below = Scaled(-pivot_z_m_, Times(Cosines(state.pitch_rad), cos_roll));
  const Interval joints = Mean(left.joint_z_m, right.joint_z_m);
  state.origin_z_m = {joints.low + ahead.low + below.low, joints.high + ahead.high + below.high};
  return state;
}

}  // namespace rockyard::navigation
