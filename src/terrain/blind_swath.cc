#include "terrain/blind_swath.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>

#include "math/functions.h"
#include "math/simpson.h"
#include "terrain/rock_size_law.h"

namespace rockyard::terrain {
namespace {

// Returns the mean over all directions of the extent of an ellipse with axes 1 and q, in units of
// its longer axis: its width at an angle t is sqrt(cos^2 t + q^2 sin^2 t), and by Cauchy the mean
// width is perimeter / pi.
double MeanExtent(double q) {
  return 2.0 / std::numbers::pi * math::Simpson(0.0, 0.5 * std::numbers::pi, [q](double angle) {
           return math::Hypot(math::Cos(angle), q * math::Sin(angle));
         });
}

// Returns the mean of MeanExtent over ratios that are uniform between the field's bounds, as
// DrawRock of rock_layout.cc draws them.
double MeanExtent(const RockFieldParams& rocks) {
  const double low = rocks.min_width_ratio;
  const double high = rocks.max_width_ratio;
  if (high - low < 1e-9) return MeanExtent(low);
  return math::Simpson(low, high, [](double q) { return MeanExtent(q); }) / (high - low);
}

// Returns the integral of D^power over the share of the law at or above low_m: (1 - Cdf(low)) times
// the mean of the law cut there. Kinds without RocksPerM2 never come here.
double UpperMoment(const RockFieldParams& rocks, double power, double low_m) {
  RockFieldParams upper = rocks;
  double kept = 1.0;
  if (rocks.FollowsLaw()) {
    // No rock of the law is so large.
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

}  // namespace

// The ellipse is (x, y) = centre + (A cos t + B sin t, C cos t + D sin t) with the semi-axes turned
// by yaw. It meets a line y = const at two t. Its least x, -sqrt(A^2 + B^2), lies at the y
//   -(A C + B D) / sqrt(A^2 + B^2).
std::optional<double> FirstContact(const Rock& rock, double y_m, double half_width_m) {
  const auto [sine, cosine] = math::SinCos(rock.yaw_rad);
  const double a = rock.semi_axes_m.x() * cosine;
  const double b = -rock.semi_axes_m.y() * sine;
  const double c = rock.semi_axes_m.x() * sine;
  const double d = rock.semi_axes_m.y() * cosine;
  const double reach_x_m = math::Hypot(a, b);
  const double reach_y_m = math::Hypot(c, d);
  const double centre_y_m = rock.center_W.y() - y_m;
  if (std::abs(centre_y_m) > half_width_m + reach_y_m) return std::nullopt;
  const double slant = (a * c + b * d) / reach_x_m;  // y of the point of greatest x
  // Least x over the allowed y: the left end of the ellipse where it lies within them, otherwise
  // on the nearer edge, since the left flank is convex.
  const double low_m = std::max(-half_width_m - centre_y_m, -reach_y_m);
  const double high_m = std::min(half_width_m - centre_y_m, reach_y_m);
  const double at_y_m = std::clamp(-slant, low_m, high_m);
  // The ellipse meets the line y first at
  //   x = (y slant reach_x - area sqrt(reach_y^2 - y^2)) / reach_y^2.
  const double area = std::abs(a * d - b * c);
  const double rest = std::max(0.0, reach_y_m * reach_y_m - at_y_m * at_y_m);
  const double x_m =
      (at_y_m * slant * reach_x_m - area * std::sqrt(rest)) / (reach_y_m * reach_y_m);
  return rock.center_W.x() + x_m;
}

double BlindContactsPerM(const RockFieldParams& rocks, const BlindSwath& swath) {
  const double per_m2 = rocks.RocksPerM2();
  if (per_m2 <= 0.0 || rocks.kind == RockFieldKind::kListed) return 0.0;
  // 1 / lambda = n (W P(D >= D_min) + g E[D; D >= D_min]).
  return per_m2 * (swath.width_m * UpperMoment(rocks, 0.0, swath.min_diameter_m) +
                   MeanExtent(rocks) * UpperMoment(rocks, 1.0, swath.min_diameter_m));
}

double FirstContact_m(const std::vector<Rock>& rocks, const BlindSwath& swath, double x0_m,
                      double y_m) {
  double first_m = std::numeric_limits<double>::infinity();
  for (const Rock& rock : rocks) {
    // Too small to be an obstacle, whatever its height.
    if (rock.diameter_m < swath.min_diameter_m) continue;
    const std::optional<double> x_m = FirstContact(rock, y_m, 0.5 * swath.width_m);
    if (x_m && *x_m >= x0_m) first_m = std::min(first_m, *x_m);
  }
  return first_m;
}

}  // namespace rockyard::terrain
