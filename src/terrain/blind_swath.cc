#include "terrain/blind_swath.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>

#include "terrain/rock_size_law.h"

namespace rockyard::terrain {
namespace {

double Simpson(double low, double high, const std::function<double(double)>& f) {
  constexpr int kIntervals = 64;
  const double step = (high - low) / kIntervals;
  double sum = f(low) + f(high);
  for (int i = 1; i < kIntervals; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * f(low + i * step);
  return sum * step / 3.0;
}

// Mean over all directions of the extent of an ellipse with axes 1 and q.
double MeanExtent(double q) {
  return 2.0 / std::numbers::pi * Simpson(0.0, 0.5 * std::numbers::pi, [q](double angle) {
           return std::hypot(std::cos(angle), q * std::sin(angle));
         });
}

double MeanExtent(const RockFieldParams& rocks) {
  const double low = rocks.min_width_ratio;
  const double high = rocks.max_width_ratio;
  if (high - low < 1e-9) return MeanExtent(low);
  return Simpson(low, high, [](double q) { return MeanExtent(q); }) / (high - low);
}

// Integral of D^power over the share of the law at or above low_m.
double UpperMoment(const RockFieldParams& rocks, double power, double low_m) {
  RockFieldParams upper = rocks;
  double kept = 1.0;
  if (rocks.kind == RockFieldKind::kMoore) {
    if (low_m >= rocks.max_diameter_m) return 0.0;
    kept = 1.0 - MakeSizeLaw(rocks)->Cdf(low_m);
    upper.min_diameter_m = std::max(low_m, rocks.min_diameter_m);
  } else {
    if (low_m > rocks.uniform_max_diameter_m) return 0.0;
    if (low_m > rocks.uniform_min_diameter_m) {
      kept = 1.0 - MakeSizeLaw(rocks)->Cdf(low_m);
      upper.uniform_min_diameter_m = low_m;
    }
  }
  return kept * MakeSizeLaw(upper)->MeanPower(power);
}

// Where the front first meets an outline, whose half extents are (along, across): an ellipse
// rho(theta) = p cos + q sin per axis.
double ContactX(const Rock& rock, double low_y, double high_y) {
  const double c = std::cos(rock.yaw_rad);
  const double s = std::sin(rock.yaw_rad);
  const double a_m = rock.semi_axes_m.x();
  const double b_m = rock.semi_axes_m.y();
  const double along_m = std::hypot(a_m * c, b_m * s);
  const double across_m = std::hypot(a_m * s, b_m * c);
  const double y = rock.center_W.y();
  if (y + across_m <= low_y || y - across_m >= high_y) {
    return std::numeric_limits<double>::infinity();
  }
  // At height v above the centre the outline reaches back to
  //   slope v - along_m' sqrt(1 - v^2 / across_m^2), along_m' = a b / across_m.
  const double slope = (a_m * a_m - b_m * b_m) * c * s / (across_m * across_m);
  const double depth_m = a_m * b_m / across_m;
  const double lowest_v = -slope * across_m * across_m / along_m;  // of the rearmost point
  const double v =
      std::clamp(lowest_v, std::max(low_y - y, -across_m), std::min(high_y - y, across_m));
  const double share = std::max(0.0, 1.0 - v * v / (across_m * across_m));
  return rock.center_W.x() + slope * v - depth_m * std::sqrt(share);
}

}  // namespace

double BlindContactsPerM(const RockFieldParams& rocks, const BlindSwath& swath) {
  const double per_m2 = rocks.RocksPerM2();
  if (per_m2 <= 0.0) return 0.0;
  return per_m2 * (swath.width_m * UpperMoment(rocks, 0.0, swath.min_diameter_m) +
                   MeanExtent(rocks) * UpperMoment(rocks, 1.0, swath.min_diameter_m));
}

double FirstContact_m(const std::vector<Rock>& rocks, const BlindSwath& swath, double x0_m,
                      double y_m) {
  double first_m = std::numeric_limits<double>::infinity();
  for (const Rock& rock : rocks) {
    if (rock.diameter_m < swath.min_diameter_m) continue;
    const double x_m = ContactX(rock, y_m - 0.5 * swath.width_m, y_m + 0.5 * swath.width_m);
    if (x_m >= x0_m) first_m = std::min(first_m, x_m);
  }
  return first_m;
}

}  // namespace rockyard::terrain
