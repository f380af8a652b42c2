#include "campaign/site/site_course.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/archive.h"
#include "core/error.h"
#include "math/angles.h"
#include "math/functions.h"

namespace rockyard::campaign {
namespace {

using Place = std::array<double, 2>;

// Largest margin beyond the arena, and its largest share of a model's side.
constexpr double kMargin_m = 4.0;
constexpr double kMarginShare = 0.1;
constexpr double kShortestSide_m = 2.0;
// What a course keeps from the ends of the arena.
constexpr double kEnd_m = 1.0;

// Whole millimetres inwards, so that rounding takes nothing out of the model.
double Inwards(double metres) { return std::floor(metres * 1000.0) / 1000.0; }

Place DefaultStart(const terrain::ArenaParams& arena, double& length_m) {
  const double from_m = arena.x_min_m + kEnd_m;
  const double room_m = arena.length_m - 2.0 * kEnd_m;
  length_m = Inwards(std::min(length_m, room_m));
  // Shifted where half of the course does not fit beside the origin.
  return {Inwards(std::clamp(-0.5 * length_m, from_m, from_m + room_m - length_m)), 0.0};
}

void CheckPlaceIn(const char* option, const Place& place, const terrain::ArenaParams& arena) {
  if (arena.HoldsCoursePoint(place[0], place[1])) return;
  throw core::UserError(
      option, fmt::format("lies at {:g}, {:g}, outside of the arena", place[0], place[1]),
      fmt::format("use x from {:g} to {:g} and y from {:g} to {:g}", arena.x_min_m,
                  arena.x_min_m + arena.length_m, -0.5 * arena.width_m, 0.5 * arena.width_m));
}

}  // namespace

core::JsonValue ArenaOfSite(const SiteElevation& site, const terrain::ArenaParams& base) {
  const HeightGrid& grid = site.grid;
  const auto extent = [&](std::int64_t nodes) { return static_cast<double>(nodes) * grid.cell_m; };
  const double behind_m = extent(site.origin_column);
  const double ahead_m = extent(grid.columns - 1 - site.origin_column);
  const double beside_m = extent(std::min(site.origin_row, grid.rows - 1 - site.origin_row));
  const double shorter_m = std::min(behind_m + ahead_m, 2.0 * beside_m);
  const double margin_m =
      Inwards(std::min({base.open_margin_m, kMargin_m, kMarginShare * shorter_m}));
  terrain::ArenaParams arena;
  arena.kind = terrain::ArenaKind::kOpen;
  arena.open_margin_m = margin_m;
  arena.x_min_m = -Inwards(behind_m - margin_m);
  arena.length_m = Inwards(behind_m - margin_m) + Inwards(ahead_m - margin_m);
  arena.width_m = 2.0 * Inwards(beside_m - margin_m);
  if (std::min(arena.length_m, arena.width_m) < kShortestSide_m + 2.0 * kEnd_m) {
    throw core::UserError(
        "--size",
        fmt::format("leaves an arena of {:.2f} x {:.2f} m", arena.length_m, arena.width_m),
        "take a larger part of the model: 6 x 6 m at least");
  }
  core::JsonValue json = core::JsonValue::Object();
  json.Set("kind", core::JsonValue("open"));
  json.Set("x_min_m", core::JsonValue(arena.x_min_m));
  json.Set("length_m", core::JsonValue(arena.length_m));
  json.Set("width_m", core::JsonValue(arena.width_m));
  json.Set("open_margin_m", core::JsonValue(arena.open_margin_m));
  return json;
}

core::JsonValue CourseOfSite(const scenario::Scenario& base, const terrain::ArenaParams& arena,
                             const std::optional<Place>& start, const std::optional<Place>& goal,
                             std::vector<std::string>& notes) {
  const trial::CourseParams& old = base.drive.course;
  const double dx_m = old.goal_x_m - old.start_x_m;
  const double dy_m = old.goal_y_m - old.start_y_m;
  const double wanted_m = math::Hypot(dx_m, dy_m);
  double length_m = wanted_m;
  Place from = DefaultStart(arena, length_m);
  Place to{from[0] + length_m, 0.0};
  if (start) from = *start;
  if (goal) to = *goal;
  CheckPlaceIn("--start", from, arena);
  CheckPlaceIn("--goal", to, arena);
  if (!start && !goal && length_m < wanted_m) {
    notes.push_back(fmt::format("the course is {:g} m long, as the {:g} m of {} do not fit",
                                length_m, wanted_m, base.name));
  }
  // The rover begins turned from the goal as much as in the base.
  const double turned_rad = old.start_heading_rad - math::Atan2(dy_m, dx_m);
  const double heading_rad = turned_rad + math::Atan2(to[1] - from[1], to[0] - from[0]);
  constexpr double kPerDegree = 1000.0;
  const double heading_deg = math::RadToDeg(std::remainder(heading_rad, 2.0 * std::numbers::pi));
  core::JsonValue json = core::JsonValue::Object();
  json.Set("start_x_m", core::JsonValue(from[0]));
  json.Set("start_y_m", core::JsonValue(from[1]));
  json.Set("start_heading_deg",
           core::JsonValue(std::round(heading_deg * kPerDegree) / kPerDegree + 0.0));
  json.Set("goal_x_m", core::JsonValue(to[0]));
  json.Set("goal_y_m", core::JsonValue(to[1]));
  if (!old.waypoints.x_m.empty()) {
    core::JsonValue none = core::JsonValue::Object();
    none.Set("x_m", core::JsonValue(core::JsonValue::List{}));
    none.Set("y_m", core::JsonValue(core::JsonValue::List{}));
    json.Set("waypoints", std::move(none));
    notes.push_back(fmt::format("the waypoints of {} are left out", base.name));
  }
  return json;
}

}  // namespace rockyard::campaign
