// Where a rover that drives straight along x first touches a rock, and how far a blind swath gets
// through a rock field before that, by closed form and by the rocks of a field. The command
// `terrain --blind-swath` compares both; studies of hazard detection ask for contacts. No drive
// does, so that records of drives do not depend on this file.
#pragma once

#include <optional>
#include <vector>

#include "terrain/rock.h"
#include "terrain/rock_params.h"

namespace rockyard::terrain {

// Returns the smallest x, in W, of the part of the rock's outline (the ellipse of its horizontal
// axes) that lies within half_width_m of the line y = y_m; none where no part does. The front of
// the rover is taken as a straight edge of that half width.
std::optional<double> FirstContact(const Rock& rock, double y_m, double half_width_m);

// A swath of width W is what a front between y - W/2 and y + W/2 sweeps as it moves along +x.
// Obstacles are rocks with diameters of at least min_diameter_m, whatever their height.
struct BlindSwath {
  double width_m = 0.48;
  double min_diameter_m = 0.0;
};

// Returns the rate, per metre of x, at which the front of a swath first touches obstacles in a
// Poisson field, counting the first contact of each obstacle:
//   1 / lambda = integral over D >= min_diameter_m of (W + g D) n(D) dD,
// n(D) the number of rocks per m2 and m of diameter by the field's law. Then
//   P(clear to x) = exp(-x / lambda)
// exactly: contacts of a front with convex obstacles at Poisson places are a Poisson process along
// x (displacement theorem; Last and Penrose 2017, ch. 5). g is the mean extent of a rock across the
// swath in diameters: 1 for round rocks. For an ellipse of axis ratio q at any yaw it is the
// perimeter over that of the circle around the ellipse (Cauchy); g averages it over q, which
// rock_layout.cc draws uniformly. All is closed form but g, which two nested Simpson rules give to
// 1e-10. Returns 0 for fields without a law and for listed rocks. P holds without clusters, overlap
// rule, clear zones and arena edges: rules that keep rocks apart shift the distances.
double BlindContactsPerM(const RockFieldParams& rocks, const BlindSwath& swath);

// Returns the x, in W, at which the front, moving from x0_m on, first touches an obstacle; infinite
// where it touches none. Rocks whose FirstContact lies before x0_m are left out: like
// BlindContactsPerM this counts contacts made by moving. Outlines count as seen from above.
double FirstContact_m(const std::vector<Rock>& rocks, const BlindSwath& swath, double x0_m,
                      double y_m);

}  // namespace rockyard::terrain
