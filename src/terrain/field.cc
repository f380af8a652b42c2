#include "terrain/field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "core/error.h"
#include "math/functions.h"
#include "math/simpson.h"
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

// Returns the mean of D^power over a law's rocks, where rocks count zero that n clear zones of
// radius r around start, waypoints and goal remove from an area A. A rock of diameter D is removed
// from within r + D/2: where zones do not overlap, with the chance n pi (r + D/2)^2 / A. So the
// mean is
//   E[D^power] - n pi (r^2 E[D^power] + r E[D^(power+1)] + E[D^(power+2)] / 4) / A.
double MeanPowerOutsideClearZones(const RockSizeLaw& law, double power, double radius_m,
                                  double zones, double area_m2) {
  const double removed = radius_m * radius_m * law.MeanPower(power) +
                         radius_m * law.MeanPower(power + 1.0) + 0.25 * law.MeanPower(power + 2.0);
  return law.MeanPower(power) - zones * std::numbers::pi * removed / area_m2;
}

// Adds what the law of the random rocks lets expect.
void AddRandom(const TerrainParams& params, const Course& course, FieldAudit& audit) {
  const std::unique_ptr<RockSizeLaw> law = MakeSizeLaw(params.rocks);
  if (!law) return;
  // Mean number: density times area.
  const double drawn = params.rocks.RocksPerM2() * audit.layout_area_m2;
  double placed_share = 1.0;
  double mean_square_m2 = law->MeanPower(2.0);
  // Only rocks of a law are dropped in clear zones; exact counts are drawn again elsewhere.
  if (params.rocks.FollowsLaw()) {
    const double r = params.rocks.clear_radius_m;
    const auto zones = static_cast<double>(course.Points().size());
    placed_share = MeanPowerOutsideClearZones(*law, 0.0, r, zones, audit.layout_area_m2);
    mean_square_m2 = MeanPowerOutsideClearZones(*law, 2.0, r, zones, audit.layout_area_m2);
  }
  audit.expected_drawn += drawn;
  audit.expected_placed += drawn * placed_share;
  // Cover per area: pi/4 E[D^2] times the number of rocks.
  audit.expected_cover += 0.25 * std::numbers::pi * drawn * mean_square_m2 / audit.layout_area_m2;
}

// Adds the listed rocks, of which all are there.
void AddListed(const ListedRocksParams& listed, FieldAudit& audit) {
  for (const double diameter_m : listed.diameter_m) {
    audit.expected_drawn += 1.0;
    audit.expected_placed += 1.0;
    audit.expected_cover +=
        0.25 * std::numbers::pi * diameter_m * diameter_m / audit.layout_area_m2;
  }
}

FieldAudit AuditLayout(const TerrainParams& params, const Course& course,
                       const RockLayout& layout) {
  FieldAudit audit;
  audit.layout_area_m2 = params.LayoutArea();
  AddRandom(params, course, audit);
  if (params.rocks.kind == RockFieldKind::kListed) AddListed(params.rocks.listed, audit);
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
    // Images must follow all rocks of the strip: lists and fields of growing k rely on it.
    for (const Rock& image : MirrorImages(params.arena, rock)) rocks.push_back(image);
  }
  audit.mirror_images = static_cast<int>(rocks.size() - layout.rocks.size());
  if (course.goal_rock.diameter_m > 0.0) {
    rocks.push_back(GivenRock(params.rocks, {course.goal_x_m, course.goal_y_m},
                              course.goal_rock.diameter_m, course.goal_rock.height_m));
  }

  Ground ground(params.ground, key);
  for (Rock& rock : rocks) {
    // Layouts know heights above the ground; a mirror image gets the ground of its own place.
    rock.center_W.z() += ground.Height(rock.center_W.x(), rock.center_W.y());
  }
  return {Terrain(std::move(ground), std::move(rocks), ArenaWalls(params.arena)), audit};
}

namespace {

// Returns the area of the quarter of a disc of radius r about the origin that lies in [0, a] x [0,
// b]. It is odd in a and in b, so that sums over corners give any rectangle.
double QuarterArea(double a, double b, double r) {
  const double sign = (a < 0.0) == (b < 0.0) ? 1.0 : -1.0;
  const double right = std::min(std::abs(a), r);
  const double top = std::min(std::abs(b), r);
  // The circle is above `top` as far as `flat`; beyond it the integral of sqrt(r^2 - x^2) is
  // (x sqrt(r^2 - x^2) + r^2 asin(x / r)) / 2.
  const double flat = std::min(std::sqrt(r * r - top * top), right);
  const auto integral = [r](double x) {
    return 0.5 * (x * std::sqrt(r * r - x * x) + r * r * math::Asin(x / r));
  };
  return sign * (top * flat + integral(right) - integral(flat));
}

Rectangle CorridorOf(const Course& course) {
  const auto [low, high] = std::minmax(course.start_x_m, course.goal_x_m);
  return {low, high, course.start_y_m - kCorridorHalfWidth_m,
          course.start_y_m + kCorridorHalfWidth_m};
}

// Returns the area in which the centre of a rock of that diameter may lie.
double AllowedArea(const Rectangle& area, const Course& course, double clear_radius_m,
                   double diameter_m) {
  const double reach_m = clear_radius_m + 0.5 * diameter_m;
  return area.Area() - AreaNear(area, course.start_x_m, course.start_y_m, reach_m) -
         AreaNear(area, course.goal_x_m, course.goal_y_m, reach_m);
}

bool Within(const Rectangle& inner, const Rectangle& outer) {
  return outer.Contains(inner.x_min_m, inner.y_min_m) &&
         outer.Contains(inner.x_max_m, inner.y_max_m);
}

// Returns the bounds of a law's classes: those of the law, and .2, .3 and .5 m between them.
std::vector<double> ClassBounds(const RockFieldParams& rocks) {
  std::vector<double> bounds{rocks.min_diameter_m};
  for (const double bound_m : {0.2, 0.3, 0.5}) {
    if (bound_m > rocks.min_diameter_m && bound_m < rocks.max_diameter_m) {
      bounds.push_back(bound_m);
    }
  }
  bounds.push_back(rocks.max_diameter_m);
  return bounds;
}

}  // namespace

double AreaNear(const Rectangle& area, double x_m, double y_m, double radius_m) {
  if (radius_m <= 0.0) return 0.0;
  const double left = area.x_min_m - x_m;
  const double right = area.x_max_m - x_m;
  const double low = area.y_min_m - y_m;
  const double high = area.y_max_m - y_m;
  return QuarterArea(right, high, radius_m) - QuarterArea(left, high, radius_m) -
         QuarterArea(right, low, radius_m) + QuarterArea(left, low, radius_m);
}

std::vector<CorridorClass> ExpectedInCorridor(const TerrainParams& params, const Course& course) {
  const RockFieldParams& rocks = params.rocks;
  const std::unique_ptr<RockSizeLaw> law = MakeSizeLaw(rocks);
  if (!law || rocks.kind == RockFieldKind::kListed || course.start_y_m != course.goal_y_m ||
      !course.waypoints.empty()) {
    return {};
  }
  const bool exact = rocks.kind == RockFieldKind::kUniformCount;
  const Rectangle layout = exact ? CountArea(rocks) : LayoutBounds(params);
  const Rectangle corridor = CorridorOf(course);
  const double largest_m = exact ? rocks.uniform_max_diameter_m : rocks.max_diameter_m;
  const double zones_m = 2.0 * rocks.clear_radius_m + largest_m;
  if (!Within(corridor, layout) || corridor.x_max_m - corridor.x_min_m < zones_m) return {};

  const std::vector<double> bounds =
      exact ? std::vector{rocks.uniform_min_diameter_m, rocks.uniform_max_diameter_m}
            : ClassBounds(rocks);
  const double drawn = exact ? static_cast<double>(rocks.count) : rocks.RocksPerM2();
  // Mean number of centres for a rock that is drawn with that diameter.
  const auto chance = [&](double diameter_m) {
    const double allowed = AllowedArea(corridor, course, rocks.clear_radius_m, diameter_m);
    if (!exact) return allowed;
    return allowed / AllowedArea(layout, course, rocks.clear_radius_m, diameter_m);
  };
  std::vector<CorridorClass> classes;
  for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
    // Over the distribution function instead of the diameter: its density is 1, and rocks of a
    // single size need no case of their own.
    const bool last = i + 2 == bounds.size();
    const double low = i == 0 ? 0.0 : law->Cdf(bounds[i]);
    const double high = last ? 1.0 : law->Cdf(bounds[i + 1]);
    const double expected =
        drawn * math::Simpson(low, high, [&](double u) { return chance(law->Diameter(u)); });
    classes.push_back({bounds[i], bounds[i + 1], expected, 0});
  }
  return classes;
}

void CountInCorridor(std::span<const Rock> rocks, const Course& course,
                     std::vector<CorridorClass>& classes) {
  const Rectangle corridor = CorridorOf(course);
  for (const Rock& rock : rocks) {
    if (!corridor.Contains(rock.center_W.x(), rock.center_W.y())) continue;
    // Bounds of neighbours touch, and the largest diameter belongs to the last class.
    const auto found =
        std::find_if(classes.begin(), classes.end(),
                     [&rock](const CorridorClass& c) { return rock.diameter_m < c.to_m; });
    if (found != classes.end()) {
      ++found->observed;
    } else if (!classes.empty()) {
      ++classes.back().observed;
    }
  }
}

}  // namespace rockyard::terrain
