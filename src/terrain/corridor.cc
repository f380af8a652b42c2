#include "terrain/corridor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "math/simpson.h"
#include "terrain/rock_size_law.h"

namespace rockyard::terrain {
namespace {

// Area of the quarter of a disc of radius r about the origin that lies in [0, a] x [0, b]; odd in a
// and in b, so that sums over corners give any rectangle.
double QuarterArea(double a, double b, double r) {
  const double sign = (a < 0.0) == (b < 0.0) ? 1.0 : -1.0;
  const double right = std::min(std::abs(a), r);
  const double top = std::min(std::abs(b), r);
  // The circle is above `top` as far as `flat`; beyond it the integral of sqrt(r^2 - x^2) is
  // (x sqrt(r^2 - x^2) + r^2 asin(x / r)) / 2.
  const double flat = std::min(std::sqrt(r * r - top * top), right);
  const auto integral = [r](double x) {
    return 0.5 * (x * std::sqrt(r * r - x * x) + r * r * std::asin(x / r));
  };
  return sign * (top * flat + integral(right) - integral(flat));
}

Rectangle CorridorOf(const Course& course) {
  const auto [low, high] = std::minmax(course.start_x_m, course.goal_x_m);
  return {low, high, course.start_y_m - kCorridorHalfWidth_m,
          course.start_y_m + kCorridorHalfWidth_m};
}

// What of the area the centre of a rock of that diameter may lie in.
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

// Bounds of Moore's classes: the law's own, and .2, .3 and .5 m between them.
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
  if (!law || course.start_y_m != course.goal_y_m || !course.waypoints.empty()) return {};
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
