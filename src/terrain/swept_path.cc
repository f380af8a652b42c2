#include "terrain/swept_path.h"

#include <algorithm>
#include <cmath>

namespace rockyard::terrain {

// The ellipse is (x, y) = centre + (A cos t + B sin t, C cos t + D sin t) with the semi-axes turned
// by yaw. Its line y = const is met at two t; its least x, -sqrt(A^2 + B^2), lies at y = -(A C + B
// D) / sqrt(A^2 + B^2).
std::optional<double> FirstContact(const Rock& rock, double y_m, double half_width_m) {
  const double cosine = std::cos(rock.yaw_rad);
  const double sine = std::sin(rock.yaw_rad);
  const double a = rock.semi_axes_m.x() * cosine;
  const double b = -rock.semi_axes_m.y() * sine;
  const double c = rock.semi_axes_m.x() * sine;
  const double d = rock.semi_axes_m.y() * cosine;
  const double reach_x_m = std::hypot(a, b);
  const double reach_y_m = std::hypot(c, d);
  const double centre_y_m = rock.center_W.y() - y_m;
  if (std::abs(centre_y_m) > half_width_m + reach_y_m) return std::nullopt;
  const double slant = (a * c + b * d) / reach_x_m;  // y of the point of greatest x
  // Least x over the allowed y: the left end of the ellipse where it lies within them, otherwise
  // on the nearer edge, since the left flank is convex.
  const double low_m = std::max(-half_width_m - centre_y_m, -reach_y_m);
  const double high_m = std::min(half_width_m - centre_y_m, reach_y_m);
  const double at_y_m = std::clamp(-slant, low_m, high_m);
  // On the line y: x = (y slant reach_x - area sqrt(reach_y^2 - y^2)) / reach_y^2.
  const double area = std::abs(a * d - b * c);
  const double rest = std::max(0.0, reach_y_m * reach_y_m - at_y_m * at_y_m);
  const double x_m =
      (at_y_m * slant * reach_x_m - area * std::sqrt(rest)) / (reach_y_m * reach_y_m);
  return rock.center_W.x() + x_m;
}

}  // namespace rockyard::terrain
