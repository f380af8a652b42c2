// The best way to a goal among rocks that somebody knows: an oracle, or operators with a map; never
// on-board code.
#pragma once

#include <span>

#include "messages/estimates.h"
#include "messages/route.h"
#include "terrain/rock.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

// The shortest path from the start of the course to `goal` among `rocks` on a grid (A*, eight
// neighbours; Hart, Nilsson and Raphael 1968), its corners pulled straight. The first of these that
// there is:
//
//   |   | rocks that it keeps clear of | by, from the rover's centre                           |
//   | 1 | of low_rock_m and higher     | half its diagonal and margin_m: it may turn anywhere  |
//   | 2 | of low_rock_m and higher     | half its width and margin_m: it may touch as it turns |
//   | 3 | belly_clearance_m and higher | as 1                                                  |
//   | 4 | belly_clearance_m and higher | as 2                                                  |
//   | 5 | belly_clearance_m and higher | half its width                                        |
//   | 6 | belly_clearance_m and higher | that to the middle of its wheels, which climb flanks  |
//
// An empty route where there is none: what no path selection could cure, as far as this grid tells.
// Outlines are ellipses, their half axes lengthened by the room that is kept (the true parallel
// curve lies up to 1 cm further out). The way stays inside of the arena: one across a mirror line
// has another inside the lines that is as long. Limits: rocks only, no slopes; rocks that the rover
// pushes are taken as fixed. Deterministic, no random numbers. Cost: 1 to 3 ms for the nominal
// arena, 10 ms among the rocks of VL-2.
messages::Route PlanRoute(const DriveParams& drive, std::span<const terrain::Rock> rocks,
                          const messages::Goal& goal);

}  // namespace rockyard::trial
