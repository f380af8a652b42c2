#include "terrain/rock_profile.h"

#include "core/check.h"

namespace rockyard::terrain {

Rock ShapeRock(const RockOutline& outline, double pointedness) {
  EXPECT(pointedness >= 0.0 && pointedness < 1.0);
  const double h_m = outline.height_m;
  Rock rock;
  rock.diameter_m = outline.diameter_m;
  rock.height_m = h_m;
  const double a_m = 0.5 * outline.diameter_m;
  rock.semi_axes_m = {a_m, a_m * outline.width_ratio, outline.half_height_m};
  // What has no height has no profile.
  if (pointedness > 0.0 && h_m > 0.0) {
    const double growth = (1.0 - pointedness) * 2.0 * h_m / outline.half_height_m;
    if (growth < 2.0) {
      rock.semi_axes_m.z() = h_m;
      rock.cap_growth = growth;
    } else {
      // A = 2 h / c solved for c.
      rock.semi_axes_m.z() = 2.0 * h_m / growth;
    }
  }
  // The top stands at h, an ellipsoid's centre c below it; that of a cap is its height below.
  rock.center_W.z() = h_m - rock.semi_axes_m.z();
  return rock;
}

}  // namespace rockyard::terrain
