#include "trial/course/goal_designation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

#include "core/random.h"
#include "math/angles.h"
#include "math/functions.h"
#include "terrain/rock.h"
#include "trial/course/route_planner.h"

namespace rockyard::trial {

namespace {

using math::Vector3;

// Points are looked at on rings at these shares of a rock's outline. The last ring lies just inside
// the outline and has many points, as they tell how wide a rock looks (0.4 % too narrow at 5 deg
// from the tangent's point). Records of lander maps depend on the points, and on kMargin_m.
struct Ring {
  double share;
  int points;
};
constexpr std::array kRings{Ring{0.2, 12}, Ring{0.4, 12},  Ring{0.6, 24},
                            Ring{0.8, 24}, Ring{0.92, 24}, Ring{0.999, 72}};
// Ends of rays are shortened by this, so that a point is not hidden by the surface that it lies on.
// The sensors of the rover share another margin (rendering/occlusion.h).
constexpr double kMargin_m = 0.002;

// Returns the points of a rock that a camera might show: its top and rings of its surface, none
// below the ground.
std::vector<Vector3> SurfacePoints(const terrain::Rock& rock, const terrain::Ground& ground) {
  const terrain::RockShape shape(rock);
  const Vector3& centre = rock.center_W;
  std::vector<Vector3> points{{centre.x(), centre.y(), shape.Top(centre.x(), centre.y())}};
  const auto [s, c] = math::SinCos(rock.yaw_rad);
  for (const Ring& ring : kRings) {
    for (int i = 0; i < ring.points; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / ring.points;
      const double u = ring.share * rock.semi_axes_m.x() * math::Cos(angle);
      const double v = ring.share * rock.semi_axes_m.y() * math::Sin(angle);
      const double x_m = centre.x() + c * u - s * v;
      const double y_m = centre.y() + s * u + c * v;
      const double z_m = shape.Top(x_m, y_m);
      if (z_m > ground.Height(x_m, y_m)) points.emplace_back(x_m, y_m, z_m);
    }
  }
  return points;
}

// What is seen of a rock. Angles are about the mast, from the bearing of the rock's centre.
struct Sight {
  int seen = 0;   // points that are seen
  int alone = 0;  // points that would be seen if no other rock stood in the way
  double nearest_m = std::numeric_limits<double>::infinity();  // horizontal
  double left_rad = -std::numeric_limits<double>::infinity();
  double right_rad = std::numeric_limits<double>::infinity();
  double high_rad = -std::numeric_limits<double>::infinity();
  double low_rad = std::numeric_limits<double>::infinity();
  double top_z_m = -std::numeric_limits<double>::infinity();

  void Add(const Vector3& p_MastPoint_W, double bearing_rad, double z_m) {
    ++seen;
    const double level_m = math::Hypot(p_MastPoint_W.x(), p_MastPoint_W.y());
    const double across_rad =
        math::WrapAngle(math::Atan2(p_MastPoint_W.y(), p_MastPoint_W.x()) - bearing_rad);
    const double up_rad = math::Atan2(p_MastPoint_W.z(), level_m);
    nearest_m = std::min(nearest_m, level_m);
    left_rad = std::max(left_rad, across_rad);
    right_rad = std::min(right_rad, across_rad);
    high_rad = std::max(high_rad, up_rad);
    low_rad = std::min(low_rad, up_rad);
    top_z_m = std::max(top_z_m, z_m);
  }
};

// Returns what is seen of a rock. `before` holds every rock that may hide it, and the rock itself.
Sight Look(const terrain::Terrain& terrain, int index, std::span<const int> before,
           const Vector3& mast_W) {
  const terrain::Rock& rock = terrain.rocks()[static_cast<std::size_t>(index)];
  const double bearing_rad =
      math::Atan2(rock.center_W.y() - mast_W.y(), rock.center_W.x() - mast_W.x());
  const std::array itself{index};
  Sight sight;
  for (const Vector3& point_W : SurfacePoints(rock, terrain.ground())) {
    if (terrain.Occluded(mast_W, point_W, kMargin_m, itself)) continue;
    ++sight.alone;
    if (terrain.Occluded(mast_W, point_W, kMargin_m, before)) continue;
    sight.Add(point_W - mast_W, bearing_rad, point_W.z());
  }
  return sight;
}

// A rock seen from above, in polar coordinates about the mast.
struct Outline {
  double nearest_m = 0.0;
  double farthest_m = 0.0;
  double bearing_rad = 0.0;
  double half_rad = 0.0;  // of the circle around it
};

Outline OutlineOf(const terrain::Rock& rock, const Vector3& mast_W) {
  const double dx = rock.center_W.x() - mast_W.x();
  const double dy = rock.center_W.y() - mast_W.y();
  const double centre_m = math::Hypot(dx, dy);
  const double radius_m = rock.semi_axes_m.x();
  const bool beside = centre_m > radius_m;
  return {centre_m - radius_m, centre_m + radius_m, math::Atan2(dy, dx),
          beside ? math::Asin(radius_m / centre_m) : std::numbers::pi};
}

// Standard normal numbers of one rock, by which its errors are scaled.
struct RockErrors {
  double downrange = 0.0;
  double left = 0.0;
  double right = 0.0;
  double top = 0.0;
  double base = 0.0;
};

RockErrors DrawErrors(core::TrialKey key, std::size_t index) {
  core::RandomStream stream(key, core::Purpose::kLanderMap, static_cast<std::uint32_t>(index));
  RockErrors draws;
  // Records depend on it: all five are drawn in this order, whichever are used.
  for (double* draw : {&draws.downrange, &draws.left, &draws.right, &draws.top, &draws.base}) {
    *draw = core::SampleNormal(stream, 0.0, 1.0);
  }
  return draws;
}

// The lander's stereo pair, as it maps rocks.
class Mapper {
 public:
  Mapper(const CourseParams& course, const terrain::Terrain& terrain, core::TrialKey key)
      : terrain_(terrain),
        params_(course.lander_map),
        cameras_(course.designation),
        key_(key),
        pan_rad_(PanError_rad(course.designation, key)) {
    cameras_.pixel_sd_px = params_.edge_sd_px;
    cameras_.disparity_sd_px = params_.disparity_sd_px;
    const messages::Goal lander = course.LanderPlace();
    mast_W_ = {lander.x_m, lander.y_m,
               terrain.ground().Height(lander.x_m, lander.y_m) + params_.mast_height_m};
    for (const terrain::Rock& rock : terrain.rocks()) outlines_.push_back(OutlineOf(rock, mast_W_));
  }

  std::optional<MappedRock> Map(std::size_t index) const {
    const terrain::Rock& truth = terrain_.rocks()[index];
    const Outline& outline = outlines_[index];
    if (outline.nearest_m <= 0.0 || outline.nearest_m > params_.reach_m) return std::nullopt;
    // Most rocks are too small, whatever is seen of them.
    if (2.0 * outline.half_rad < params_.resolved_px * cameras_.pixel_rad) return std::nullopt;
    const Sight sight = Look(terrain_, static_cast<int>(index), RocksBefore(outline), mast_W_);
    if (sight.seen == 0 || sight.nearest_m > params_.reach_m) return std::nullopt;
    const double resolved_px =
        std::min(sight.left_rad - sight.right_rad, sight.high_rad - sight.low_rad) /
        cameras_.pixel_rad;
    if (resolved_px < params_.resolved_px) return std::nullopt;
    std::optional<terrain::Rock> believed = Believe(truth, sight, DrawErrors(key_, index));
    if (!believed) return std::nullopt;
    const double share = static_cast<double>(sight.seen) / sight.alone;
    return MappedRock{*believed, index, sight.nearest_m, share, resolved_px};
  }

 private:
  // Returns the rocks that may hide a rock: their outlines share a bearing with it and begin before
  // it ends. The rock itself is included.
  std::vector<int> RocksBefore(const Outline& rock) const {
    std::vector<int> before;
    for (std::size_t i = 0; i < outlines_.size(); ++i) {
      const Outline& other = outlines_[i];
      if (other.nearest_m > rock.farthest_m) continue;
      const double apart_rad = std::abs(math::WrapAngle(other.bearing_rad - rock.bearing_rad));
      if (apart_rad <= other.half_rad + rock.half_rad) before.push_back(static_cast<int>(i));
    }
    return before;
  }

  // Returns the rock as it is believed to be; nothing where the errors leave nothing of its size.
  std::optional<terrain::Rock> Believe(const terrain::Rock& truth, const Sight& sight,
                                       const RockErrors& draws) const {
    const double ground_m = terrain_.ground().Height(truth.center_W.x(), truth.center_W.y());
    const double range_m = math::Hypot(sight.nearest_m, mast_W_.z() - ground_m);
    const double edge_rad = cameras_.pixel_sd_px * cameras_.pixel_rad;
    const double left_rad = sight.left_rad + edge_rad * draws.left;
    const double right_rad = sight.right_rad + edge_rad * draws.right;
    const double nearest_m =
        sight.nearest_m + cameras_.ErrorsAt(range_m).downrange_sd_m * draws.downrange;
    const double half_rad = 0.5 * (left_rad - right_rad);
    const double height_m =
        nearest_m * ((sight.top_z_m - ground_m) / sight.nearest_m +
                     edge_rad * (draws.top - draws.base) * range_m / sight.nearest_m);
    if (half_rad <= 0.0 || nearest_m <= 0.0 || height_m <= 0.0) return std::nullopt;
    const double sine = math::Sin(half_rad);
    const double radius_m = nearest_m * sine / (1.0 - sine);
    const double bearing_rad =
        math::Atan2(truth.center_W.y() - mast_W_.y(), truth.center_W.x() - mast_W_.x()) +
        0.5 * (left_rad + right_rad);
    // The pan error displaces the rock across the line of sight by pan error times range, to first
    // order, as a designated goal (Designated).
    const double centre_m = nearest_m + radius_m;
    const auto [y, x] = math::SinCos(bearing_rad);
    terrain::Rock rock;
    rock.center_W = {mast_W_.x() + centre_m * (x - pan_rad_ * y),
                     mast_W_.y() + centre_m * (y + pan_rad_ * x), ground_m};
    rock.semi_axes_m = {radius_m, radius_m, height_m};
    rock.diameter_m = 2.0 * radius_m;
    rock.height_m = height_m;
    return rock;
  }

  const terrain::Terrain& terrain_;
  const LanderMapParams& params_;
  DesignationParams cameras_;  // with the errors of the map
  core::TrialKey key_;
  double pan_rad_;
  Vector3 mast_W_;
  std::vector<Outline> outlines_;  // of all rocks
};

}  // namespace

std::vector<MappedRock> MapFromLander(const CourseParams& course, const terrain::Terrain& terrain,
                                      core::TrialKey key) {
  const Mapper mapper(course, terrain, key);
  std::vector<MappedRock> map;
  for (std::size_t i = 0; i < terrain.rocks().size(); ++i) {
    if (std::optional<MappedRock> rock = mapper.Map(i)) map.push_back(*rock);
  }
  return map;
}

namespace {

// The line from the lander's cameras to a place.
struct LineOfSight {
  double range_m = 0.0;
  double along_x = 1.0;  // unit vector
  double along_y = 0.0;
};

// Returns the place less CourseParams::LanderPlace. Records depend on this order of operations, by
// the last bits of all told goals, so that LanderPlace must not replace it.
LineOfSight SightOf(const messages::Goal& place, const CourseParams& course) {
  const double dx = course.goal_x_m - course.start_x_m;
  const double dy = course.goal_y_m - course.start_y_m;
  const double straight_m = math::Hypot(dx, dy);
  const double ahead = course.designation.lander_ahead_m / straight_m;
  const double left = course.designation.lander_left_m / straight_m;
  const double sight_x_m = (place.x_m - course.start_x_m) - ahead * dx + left * dy;
  const double sight_y_m = (place.y_m - course.start_y_m) - ahead * dy - left * dx;
  const double range_m = math::Hypot(sight_x_m, sight_y_m);
  if (range_m <= 0.0) return {};
  return {range_m, sight_x_m / range_m, sight_y_m / range_m};
}

// The random numbers of one substream, in the order in which they are drawn.
struct Draws {
  double crossrange = 0.0;  // standard normal, as the next
  double downrange = 0.0;
  double pan = 0.0;  // uniform from -1 to 1
};

Draws Draw(core::TrialKey key, std::uint32_t substream) {
  core::RandomStream stream(key, core::Purpose::kGoalDesignation, substream);
  Draws draws;
  draws.crossrange = core::SampleNormal(stream, 0.0, 1.0);
  draws.downrange = core::SampleNormal(stream, 0.0, 1.0);
  draws.pan = core::SampleUniform(stream, -1.0, 1.0);
  return draws;
}

// Returns a place as it is told. Its pan error, `pan` times crossrange_bias_m, must be PanError_rad
// times the range.
messages::Goal Designated(const messages::Goal& truth, const CourseParams& course,
                          const Draws& draws) {
  if (!course.designation.enabled) return truth;
  const LineOfSight sight = SightOf(truth, course);
  const DesignationErrors errors = course.designation.ErrorsAt(sight.range_m);
  const double pan = course.designation.pan_kind == PanError::kFixed ? 1.0 : draws.pan;
  const double downrange_m = draws.downrange * errors.downrange_sd_m;
  const double left_m = draws.crossrange * errors.crossrange_sd_m + pan * errors.crossrange_bias_m;
  return {truth.x_m + downrange_m * sight.along_x - left_m * sight.along_y,
          truth.y_m + downrange_m * sight.along_y + left_m * sight.along_x};
}

bool AreSpaced(const messages::Goal& a, const messages::Goal& b, double spacing_m) {
  return math::Hypot(b.x_m - a.x_m, b.y_m - a.y_m) >= spacing_m;
}

// Returns the corners that are far enough from the place kept before them and from the goal, then
// the goal.
std::vector<messages::Goal> Thinned(const messages::Route& route, const messages::Goal& start,
                                    const messages::Goal& goal, double spacing_m) {
  std::vector<messages::Goal> places;
  messages::Goal from = start;
  for (std::size_t i = 0; i + 1 < route.corners.size(); ++i) {
    const messages::Goal& corner = route.corners[i];
    if (!AreSpaced(from, corner, spacing_m) || !AreSpaced(corner, goal, spacing_m)) continue;
    places.push_back(corner);
    from = corner;
  }
  places.push_back(goal);
  return places;
}

}  // namespace

double PanError_rad(const DesignationParams& designation, core::TrialKey key) {
  if (!designation.enabled) return 0.0;
  const bool fixed = designation.pan_kind == PanError::kFixed;
  return designation.pan_error_rad * (fixed ? 1.0 : Draw(key, 0).pan);
}

messages::Goal DesignatedGoal(const CourseParams& course, core::TrialKey key) {
  return Designated({course.goal_x_m, course.goal_y_m}, course, Draw(key, 0));
}

std::vector<messages::Goal> DesignatedGoals(const CourseParams& course, core::TrialKey key) {
  std::vector<messages::Goal> goals = course.waypoints.Places();
  const double pan = Draw(key, 0).pan;
  for (std::size_t i = 0; i < goals.size(); ++i) {
    Draws draws = Draw(key, static_cast<std::uint32_t>(i + 1));
    draws.pan = pan;
    goals[i] = Designated(goals[i], course, draws);
  }
  goals.push_back(DesignatedGoal(course, key));
  return goals;
}

sensing::LanderPlace LanderPlaceOf(const CourseParams& course, core::TrialKey key) {
  const messages::Goal place = course.LanderPlace();
  return {
      .x_m = place.x_m, .y_m = place.y_m, .pan_error_rad = PanError_rad(course.designation, key)};
}

messages::Route ToldRoute(const DriveParams& drive, const terrain::Terrain& terrain,
                          core::TrialKey key, const messages::Goal& goal) {
  if (drive.course.route_map.source == RouteMap::kOracle) {
    return PlanRoute(drive, terrain.rocks(), goal);
  }
  std::vector<terrain::Rock> rocks;
  for (const MappedRock& known : MapFromLander(drive.course, terrain, key)) {
    rocks.push_back(known.rock);
  }
  return PlanRoute(drive, rocks, goal);
}

std::vector<messages::Goal> ToldPlaces(const DriveParams& drive, const terrain::Terrain& terrain,
                                       core::TrialKey key) {
  const RouteMapParams& map = drive.course.route_map;
  if (map.use != RouteUse::kWaypoints) return DesignatedGoals(drive.course, key);
  const messages::Goal goal = DesignatedGoal(drive.course, key);
  return Thinned(ToldRoute(drive, terrain, key, goal),
                 {drive.course.start_x_m, drive.course.start_y_m}, goal, map.spacing_m);
}

}  // namespace rockyard::trial
