// Ground, course, rocks and paths as scenes of a trace in MCAP (mcap_messages.h declares the
// function).
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "replay/mcap_messages.h"
#include "replay/motion.h"
#include "replay/payload_text.h"

namespace rockyard::replay {
namespace {

using core::JsonList;
using math::Vector3;

constexpr Colour kGroundColour{0.62, 0.47, 0.36};
constexpr Colour kRockColour{0.4, 0.33, 0.3};
constexpr Colour kGoalColour{0.0, 0.62, 0.45, 0.5};
constexpr Colour kToldGoalColour{0.9, 0.62, 0.0, 0.5};
constexpr Colour kWallColour{0.34, 0.71, 0.91, 0.3};
constexpr Colour kTruePathColour{0.0, 0.45, 0.7};
constexpr Colour kBelievedPathColour{0.84, 0.37, 0.0};

// How things are drawn that have no such size themselves; walls as on the page of a replay.
constexpr double kGoalHeight_m = 0.02;
constexpr double kToldGoalRadius_m = 0.1;
constexpr double kWallHeight_m = 0.35;
constexpr double kWallThickness_m = 0.01;
constexpr double kPathLift_m = 0.01;
constexpr double kPathWidth_px = 2.0;

// To 0.1 mm, as on the page of a replay: ground and paths are most of a file.
std::string ShortPointJson(double x_m, double y_m, double z_m) {
  return ObjectJson("x", Length(x_m), "y", Length(y_m), "z", Length(z_m));
}

std::string GroundJson(const ReplayGround& ground) {
  std::vector<std::string> points;
  std::vector<std::size_t> corners;
  for (std::size_t iy = 0; iy < ground.ny; ++iy) {
    for (std::size_t ix = 0; ix < ground.nx; ++ix) {
      const std::size_t low = points.size();
      const std::size_t high = low + ground.nx;
      points.push_back(ShortPointJson(ground.x0_m + static_cast<double>(ix) * ground.step_m,
                                      ground.y0_m + static_cast<double>(iy) * ground.step_m,
                                      ground.z_m[low]));
      if (ix + 1 == ground.nx || iy + 1 == ground.ny) continue;
      corners.insert(corners.end(), {low, low + 1, high + 1, low, high + 1, high});
    }
  }
  const std::string indices = JsonList(corners, [](std::size_t i) { return std::to_string(i); });
  return ObjectJson("pose", PlaceJson(Vector3::Zero()), "points", JsonList(points), "color",
                    ColourJson(kGroundColour), "colors", "[]", "indices", indices);
}

// Returns the height of the nearest point of the ground: what is drawn there stands on it or sinks
// a little.
double GroundHeight(const ReplayGround& ground, double x_m, double y_m) {
  if (ground.z_m.empty()) return 0.0;
  const auto nearest = [&](double from_m, std::size_t count) {
    const double at = std::round(from_m / ground.step_m);
    return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(count - 1)));
  };
  return ground.z_m[nearest(y_m - ground.y0_m, ground.ny) * ground.nx +
                    nearest(x_m - ground.x0_m, ground.nx)];
}

// Returns a wall where it lies within the ground; nothing where it passes it by.
std::optional<std::string> WallJson(const ReplayData& data, const ReplayWall& wall) {
  const ReplayCourse& course = data.course;
  const Vector3 along(-wall.normal_W.y(), wall.normal_W.x(), 0.0);
  const Vector3 foot = wall.offset_m * wall.normal_W;
  // A line is within a rectangle between the last side that it enters by and the first that it
  // leaves by. A wall may lie in a side itself, hence the slack.
  constexpr double kSlack_m = 0.1;
  constexpr double kFar_m = 1e6;
  const std::array low{course.x_min_m - kSlack_m, course.y_min_m - kSlack_m};
  const std::array high{course.x_max_m + kSlack_m, course.y_max_m + kSlack_m};
  double from_m = -kFar_m;
  double to_m = kFar_m;
  for (int axis = 0; axis < 2; ++axis) {
    const auto side = static_cast<std::size_t>(axis);
    if (std::abs(along[axis]) < 1e-9) {
      if (foot[axis] < low.at(side) || foot[axis] > high.at(side)) return std::nullopt;
      continue;
    }
    const auto [enters, leaves] = std::minmax(
        {(low.at(side) - foot[axis]) / along[axis], (high.at(side) - foot[axis]) / along[axis]});
    from_m = std::max(from_m, enters);
    to_m = std::min(to_m, leaves);
  }
  if (to_m <= from_m) return std::nullopt;
  Vector3 middle = foot + 0.5 * (from_m + to_m) * along;
  middle.z() = GroundHeight(data.ground, middle.x(), middle.y()) + 0.5 * kWallHeight_m;
  return SolidJson(PlaceJson(middle, Yaw(std::atan2(along.y(), along.x()))),
                   {to_m - from_m, kWallThickness_m, kWallHeight_m}, kWallColour);
}

void AddCourse(const ReplayData& data, double time_s, McapMessages& to) {
  const auto disc = [&](const messages::Goal& place, double radius_m, const Colour& colour) {
    const Vector3 p(place.x_m, place.y_m, GroundHeight(data.ground, place.x_m, place.y_m));
    return SceneParts{.cylinders = {DrumJson(
                          PlaceJson(p), {2.0 * radius_m, 2.0 * radius_m, kGoalHeight_m}, colour)}};
  };
  SceneParts walls;
  for (const ReplayWall& wall : data.course.walls) {
    if (auto cube = WallJson(data, wall)) walls.cubes.push_back(std::move(*cube));
  }
  const ReplayCourse& course = data.course;
  const auto entity = [&](std::string_view name, const SceneParts& parts) {
    return EntityJson(time_s, kWorldFrame, name, parts);
  };
  AddSceneUpdate("/scene/course", time_s,
                 {entity("ground", {.triangles = {GroundJson(data.ground)}}),
                  entity("goal", disc(course.goal, course.goal_radius_m, kGoalColour)),
                  entity("told_goal", disc(course.told_goal, kToldGoalRadius_m, kToldGoalColour)),
                  entity("walls", walls)},
                 to);
}

// Adds a cap (terrain/rock.h) as a stack of frusta, the top first: there are no messages for
// quadrics but ellipsoids. Layers are denser towards the top, where the surface bends.
void AddCap(const ReplayRock& rock, std::vector<std::string>& cylinders) {
  constexpr int kLayers = 6;
  const double growth = rock.cap_growth;
  const auto radius = [growth](double depth) {
    return std::sqrt((growth + (1.0 - growth) * depth) * depth);
  };
  double above = 0.0;
  for (int layer = 1; layer <= kLayers; ++layer) {
    const double share = static_cast<double>(layer) / kLayers;
    const double below = share * share;
    const double c_m = rock.semi_axes_m.z();
    const Vector3 middle = rock.center_W + Vector3(0.0, 0.0, c_m * (1.0 - 0.5 * (below + above)));
    const double r = radius(below);
    cylinders.push_back(DrumJson(
        PlaceJson(middle, Yaw(rock.yaw_rad)),
        {2.0 * rock.semi_axes_m.x() * r, 2.0 * rock.semi_axes_m.y() * r, c_m * (below - above)},
        kRockColour, radius(above) / r));
    above = below;
  }
}

void AddRock(const ReplayRock& rock, SceneParts& parts) {
  if (rock.cap_growth > 0.0) return AddCap(rock, parts.cylinders);
  parts.spheres.push_back(
      SolidJson(PlaceJson(rock.center_W, Yaw(rock.yaw_rad)), 2.0 * rock.semi_axes_m, kRockColour));
}

// Those that lie still are written once. The others are few, and are written whole at every push.
void AddRocks(const ReplayData& data, double time_s, McapMessages& to) {
  std::vector<ReplayRock> rocks = data.rocks;
  std::set<std::size_t> pushed;
  for (const truth::RockMove& move : data.rock_moves) {
    pushed.insert(static_cast<std::size_t>(move.rock));
  }
  SceneParts still;
  for (std::size_t i = 0; i < rocks.size(); ++i) {
    if (!pushed.contains(i)) AddRock(rocks[i], still);
  }
  AddSceneUpdate("/scene/rocks", time_s, {EntityJson(time_s, kWorldFrame, "rocks", still)}, to);
  const auto tell = [&](double now_s) {
    SceneParts moved;
    for (const std::size_t i : pushed) AddRock(rocks[i], moved);
    AddSceneUpdate("/scene/pushed_rocks", now_s,
                   {EntityJson(now_s, kWorldFrame, "pushed_rocks", moved)}, to);
  };
  if (!pushed.empty()) tell(time_s);
  for (const truth::RockMove& move : data.rock_moves) {
    rocks[static_cast<std::size_t>(move.rock)].center_W = move.center_W;
    tell(move.time_s);
  }
}

// Adds both paths, a line for each stretch without a setting back.
void AddPaths(std::span<const ReplayPose> poses, double time_s, McapMessages& to) {
  using Points = std::vector<std::string>;
  std::vector<std::pair<Points, Points>> stretches;  // true, believed
  for (const std::size_t i : ThinMotion(poses).kept) {
    if (stretches.empty() || poses[i].set_back) stretches.emplace_back();
    const Vector3 p = poses[i].sample.posture.X_WR.translation();
    const messages::PoseEstimate& believed = poses[i].sample.estimate;
    stretches.back().first.push_back(ShortPointJson(p.x(), p.y(), p.z()));
    stretches.back().second.push_back(ShortPointJson(believed.x_m, believed.y_m, p.z()));
  }
  SceneParts real;
  SceneParts believed;
  const auto add = [](const Points& points, const Colour& colour, SceneParts& parts) {
    parts.lines.push_back(LineStripJson(JsonList(points), kPathLift_m, kPathWidth_px, colour));
  };
  for (const auto& [true_points, believed_points] : stretches) {
    add(true_points, kTruePathColour, real);
    add(believed_points, kBelievedPathColour, believed);
  }
  AddSceneUpdate("/scene/paths", time_s,
                 {EntityJson(time_s, kWorldFrame, "true_path", real),
                  EntityJson(time_s, kWorldFrame, "believed_path", believed)},
                 to);
}

}  // namespace

void AddSceneMessages(const ReplayData& data, McapMessages& to) {
  const double start_s = data.poses.empty() ? 0.0 : data.poses.front().sample.time_s;
  AddCourse(data, start_s, to);
  AddRocks(data, start_s, to);
  AddPaths(data.poses, start_s, to);
}

}  // namespace rockyard::replay
