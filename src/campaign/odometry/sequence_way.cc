#include "campaign/odometry/sequence_way.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "math/angles.h"

namespace rockyard::campaign {
namespace {

using math::Pose2;

constexpr double kSamePlace_m = 1e-3;
// Below this a circle's chord is its arc, to every digit.
constexpr double kNoTurn_rad = 1e-9;
// Quotients of lengths or angles that are whole but for rounding.
constexpr double kRounding = 1e-9;

Pose2 OnCircle(const Pose2& from, double step_m, double turn_rad) {
  const double half_rad = 0.5 * turn_rad;
  const double chord_m =
      std::abs(half_rad) < kNoTurn_rad ? step_m : step_m * std::sin(half_rad) / half_rad;
  const double along_rad = from.heading_rad + half_rad;
  return {from.x_m + chord_m * std::cos(along_rad), from.y_m + chord_m * std::sin(along_rad),
          from.heading_rad + turn_rad};
}

// Of so many parts, which may be more than any integer, those that are wanted.
std::int64_t PartsOf(double parts, std::int64_t most) {
  return static_cast<std::int64_t>(std::min(parts, static_cast<double>(most)));
}

}  // namespace

std::vector<Pose2> CircleWay(const Pose2& start, std::int64_t count, double step_m,
                             double turn_rad) {
  EXPECT(count >= 1);
  std::vector<Pose2> way{start};
  way.reserve(static_cast<std::size_t>(count));
  while (std::ssize(way) < count) way.push_back(OnCircle(way.back(), step_m, turn_rad));
  return way;
}

std::vector<Pose2> CornerWay(const Pose2& start, std::span<const messages::Goal> corners,
                             std::int64_t count, double step_m, double turn_rad) {
  EXPECT(count >= 1 && step_m > 0.0 && turn_rad > 0.0);
  std::vector<Pose2> way{start};
  for (const messages::Goal& corner : corners) {
    if (std::ssize(way) >= count) break;
    const Pose2 from = way.back();
    const double distance_m = std::hypot(corner.x_m - from.x_m, corner.y_m - from.y_m);
    if (distance_m < kSamePlace_m) continue;
    const double heading_rad = std::atan2(corner.y_m - from.y_m, corner.x_m - from.x_m);
    const double turn = math::WrapAngle(heading_rad - from.heading_rad);
    const double turns = std::ceil(std::abs(turn) / turn_rad - kRounding);
    for (std::int64_t i = 1; i <= PartsOf(turns, count); ++i) {
      way.push_back({from.x_m, from.y_m, from.heading_rad + turn * static_cast<double>(i) / turns});
    }
    const std::int64_t steps = PartsOf(std::ceil(distance_m / step_m - kRounding), count);
    for (std::int64_t i = 1; i <= steps; ++i) {
      const double share = std::min(1.0, static_cast<double>(i) * step_m / distance_m);
      way.push_back({from.x_m + share * (corner.x_m - from.x_m),
                     from.y_m + share * (corner.y_m - from.y_m), heading_rad});
    }
  }
  if (std::ssize(way) > count) way.resize(static_cast<std::size_t>(count));
  return way;
}

}  // namespace rockyard::campaign
