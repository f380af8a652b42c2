// The best way to a goal among rocks that somebody knows: an oracle, or operators with a map; never
// on-board code. Told routes are planned by it (goal_designation.h), and the path of rendered
// sequences for visual odometry. Records of drives with a told route depend on its cells, ties and
// demands; it draws no random numbers, and the order of rocks does not matter.
#pragma once

#include <optional>
#include <span>

#include "messages/estimates.h"
#include "terrain/rock.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

// Returns the shortest path from the start of the course to `goal` among `rocks` on a grid (A*,
// eight neighbours; Hart, Nilsson and Raphael 1968), with its corners pulled straight. It is the
// path of the first of these demands that has one:
//
//   |   | rocks that it keeps clear of | by, from the rover's centre                           |
//   | 1 | of low_rock_m and higher     | half its diagonal and margin_m: it may turn anywhere  |
//   | 2 | of low_rock_m and higher     | half its width and margin_m: it may touch as it turns |
//   | 3 | belly_clearance_m and higher | as 1                                                  |
//   | 4 | belly_clearance_m and higher | as 2                                                  |
//   | 5 | belly_clearance_m and higher | half its width                                        |
//   | 6 | belly_clearance_m and higher | that to the middle of its wheels, which climb flanks  |
//
// The last corner is the goal itself, as messages::Route asks. The route is empty where there is no
// path: no path selection could help the rover, as far as this grid tells. Outlines are ellipses,
// their half axes lengthened by the room that is kept (the true parallel curve lies up to 1 cm
// further out). The way stays inside the arena: a way across a mirror line has another inside the
// lines that is as long. Limits: rocks only, no slopes; rocks that the rover pushes are taken as
// fixed. It draws no random numbers. Cost: 1 to 3 ms for the nominal arena, 10 ms among the rocks
// of VL-2.
messages::Route PlanRoute(const DriveParams& drive, std::span<const terrain::Rock> rocks,
                          const messages::Goal& goal);

// Returns the length of the way of a rover that sees perfectly, but only as far as range_m: what a
// navigator with such eyes could drive, were it never to err. It takes for free what it has not
// seen, follows the shortest way on the grid of PlanRoute, pulled straight, and plans anew where a
// rock comes to light on what is left of it (freespace assumption: Koenig, Tovey and Smirnov 2003;
// Stentz 1994). It sees, all round and behind other rocks, each rock whose outline, lengthened by
// range_m, holds its centre. It meets demand 5, else 6: the more generous ones lead round whole
// fields that rovers cross. Nothing where neither has a route. It ends at the goal itself. It is no
// shorter than the route by that demand of who knows all rocks, which corners pulled straight could
// else undercut by some 1 %, and as long with an infinite range; both are up to 2 % longer than the
// shortest way in the plane. range_m must exceed the demand's room. No random numbers. Cost: some
// plans of PlanRoute.
std::optional<double> OptimisticWay_m(const DriveParams& drive,
                                      std::span<const terrain::Rock> rocks,
                                      const messages::Goal& goal, double range_m);

}  // namespace rockyard::trial
