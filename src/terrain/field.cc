#include "terrain/field.h"

#include <algorithm>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "core/error.h"
#include "terrain/arena.h"
#include "terrain/rock_layout.h"
#include "terrain/rock_size_law.h"

namespace rockyard::terrain {
namespace {

void RequireCourseInArena(const ArenaParams& arena, const Course& course) {
  const std::vector<CoursePoint> points = course.Points();
  if (std::all_of(points.begin(), points.end(), [&](const CoursePoint& point) {
        return arena.HoldsCoursePoint(point.x_m, point.y_m);
      })) {
    return;
  }
  throw core::UserError("terrain.arena",
                        "does not hold the start, the waypoints and the goal of the course",
                        "use a larger arena, or a course inside it (between the mirror lines where "
                        "it is virtual)");
}

// Mean of D^power over a law's rocks when those that n clear zones of radius r around start,
// waypoints and goal remove from an area A count zero: a rock of diameter D is removed from within
// r + D/2, that is, where zones do not overlap, with the chance n pi (r + D/2)^2 / A, so the mean
// is
//   E[D^power] - n pi (r^2 E[D^power] + r E[D^(power+1)] + E[D^(power+2)] / 4) / A.
double MeanPowerOutsideClearZones(const RockSizeLaw& law, double power, double radius_m,
                                  double zones, double area_m2) {
  const double removed = radius_m * radius_m * law.MeanPower(power) +
                         radius_m * law.MeanPower(power + 1.0) + 0.25 * law.MeanPower(power + 2.0);
  return law.MeanPower(power) - zones * std::numbers::pi * removed / area_m2;
}

void AddExpectations(const TerrainParams& params, const Course& course, FieldAudit& audit) {
  const std::unique_ptr<RockSizeLaw> law = MakeSizeLaw(params.rocks);
  if (!law) return;
  // Mean number: density times area.
  audit.expected_drawn = params.rocks.RocksPerM2() * audit.layout_area_m2;
  double placed_share = 1.0;
  double mean_square_m2 = law->MeanPower(2.0);
  // Only Moore rocks are dropped in clear zones; exact counts are drawn again elsewhere.
  if (params.rocks.kind == RockFieldKind::kMoore) {
    const double r = params.rocks.clear_radius_m;
    const auto zones = static_cast<double>(course.Points().size());
    placed_share = MeanPowerOutsideClearZones(*law, 0.0, r, zones, audit.layout_area_m2);
    mean_square_m2 = MeanPowerOutsideClearZones(*law, 2.0, r, zones, audit.layout_area_m2);
  }
  audit.expected_placed = audit.expected_drawn * placed_share;
  // Cover per area: pi/4 E[D^2] times the number of rocks.
  audit.expected_cover =
      0.25 * std::numbers::pi * audit.expected_drawn * mean_square_m2 / audit.layout_area_m2;
}

FieldAudit AuditLayout(const TerrainParams& params, const Course& course,
                       const RockLayout& layout) {
  FieldAudit audit;
  audit.layout_area_m2 = params.LayoutArea();
  AddExpectations(params, course, audit);
  audit.drawn = layout.drawn;
  audit.dropped_in_clear_zones = layout.dropped_in_clear_zones;
  audit.dropped_for_overlap = layout.dropped_for_overlap;
  audit.relocated = layout.relocated;
  audit.placed = static_cast<int>(layout.rocks.size());
  for (const Rock& rock : layout.rocks) {
    const double a_m = rock.semi_axes_m.x();
    // Discs of the drawn diameter 2 a, and the ellipses a b that they stand for.
    audit.disc_cover += std::numbers::pi * a_m * a_m / audit.layout_area_m2;
    audit.outline_cover += std::numbers::pi * a_m * rock.semi_axes_m.y() / audit.layout_area_m2;
    if (rock.height_m >= kDetectableHeight_m) audit.detectable_per_m2 += 1.0;
    if (rock.height_m >= kBellyHeight_m) audit.belly_high_per_m2 += 1.0;
  }
  audit.detectable_per_m2 /= audit.layout_area_m2;
  audit.belly_high_per_m2 /= audit.layout_area_m2;
  return audit;
}

}  // namespace

Field BuildField(const TerrainParams& params, core::TrialKey key, const Course& course) {
  RequireCourseInArena(params.arena, course);
  RockLayout layout = LayOutRocks(params, key, course);
  FieldAudit audit = AuditLayout(params, course, layout);

  std::vector<Rock> rocks = layout.rocks;
  for (const Rock& rock : layout.rocks) {
    // Images follow all rocks of the strip, so that the strip's own come first in every list.
    for (const Rock& image : MirrorImages(params.arena, rock)) rocks.push_back(image);
  }
  audit.mirror_images = static_cast<int>(rocks.size() - layout.rocks.size());
  if (course.goal_rock.diameter_m > 0.0) {
    rocks.push_back(GivenRock(params.rocks, {course.goal_x_m, course.goal_y_m},
                              course.goal_rock.diameter_m, course.goal_rock.height_m));
  }

  Ground ground(params.ground, key);
  for (Rock& rock : rocks) {
    // Layouts know heights above the ground; mirror images get that of their own place.
    rock.center_W.z() += ground.Height(rock.center_W.x(), rock.center_W.y());
  }
  return {Terrain(std::move(ground), std::move(rocks), ArenaWalls(params.arena)), audit};
}

}  // namespace rockyard::terrain
