// Where a rover that drives straight along x first touches a rock, and how far a blind swath gets
// through a rock field before that: yardsticks of fields (rockyard terrain --blind-swath) and of
// studies of hazard detection. No drive asks for them.
#pragma once

#include <optional>
#include <vector>

#include "terrain/rock.h"
#include "terrain/rock_params.h"

namespace rockyard::terrain {

// Returns the smallest x of the part of the rock's outline (the ellipse of its horizontal axes)
// that lies within half_width_m of the line y = y_m; none where no part does. The front of the
// rover is taken as a straight edge of that half width.
std::optional<double> FirstContact(const Rock& rock, double y_m, double half_width_m);

// A swath of width W is all that passes between y - W/2 and y + W/2 as its front moves along +x.
// Obstacles are rocks with diameters of at least min_diameter_m, whatever their height.
struct BlindSwath {
  double width_m = 0.48;
  double min_diameter_m = 0.0;
};

// Returns the first contacts per metre in a Poisson field, 1 / lambda:
//   1 / lambda = integral over D >= min_diameter_m of (W + g D) n(D) dD,
// n(D) the number of rocks per m2 and m of diameter by the field's law. Then
//   P(clear to x) = exp(-x / lambda)
// exactly: contacts of a front with convex obstacles at Poisson places are a Poisson process along
// x (displacement theorem; Last and Penrose 2017, ch. 5). g is the mean extent of a rock across the
// swath in diameters: 1 for round rocks; for ellipses of axis ratio q at any yaw their perimeter
// over that of the circle around them (Cauchy), averaged over q. All is closed form but g, which is
// Simpson's rule over 64 ratios of a perimeter by 64 angles, good to 1e-10. Fields without a law
// return 0. The law holds without overlap rule, clear zones and arena edges: rules that keep rocks
// apart shift the distances.
double BlindContactsPerM(const RockFieldParams& rocks, const BlindSwath& swath);

// Returns the x at which the front, from x0_m on, first touches an obstacle; infinite where it
// touches none. Rocks that reach behind x0_m where the swath begins are left out, as the closed
// form has it: it is about contacts made by moving. It is kinematic: outlines count as seen from
// above, at their true shape.
double FirstContact_m(const std::vector<Rock>& rocks, const BlindSwath& swath, double x0_m,
                      double y_m);

}  // namespace rockyard::terrain
