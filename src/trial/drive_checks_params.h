// Conditions across modules of a drive: combinations that every module accepts and that mislead.
#pragma once

#include "core/fields.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

// Lengths that are written in two places of a file agree to this.
inline constexpr double kSame_m = 1e-9;

// Requires of groups that are in use, and of no others:
// - stereo cameras are on the rover: from its rear edge to half its length ahead of its front;
// - the elevation array that the behaviour controller takes from stereo lies on level ground that
//   the cameras ahead can show (bounds that no view exceeds; the view may be narrower), and asks
//   for no more points than an image has pixels;
// - the soil holds the braked rover on the slope of the ground;
// - listed rocks leave start, waypoints and goal of a drive free by terrain.rocks.clear_radius_m;
// - goals and waypoints that a lander designates stay between the mirror lines of a
//   virtual_reflected arena, and so do targets: they stand;
// - an oracle's route leads to one goal that nobody tracks;
// - a route has somebody who follows it or drives along its corners, not both, and no other
//   waypoints; the map of a lander has a lander (course.designation);
// - GESTALT takes its vehicle for at most twice and at least half as long and wide as it is.
// Each failure names the parameter, what is wrong and a remedy.
void RequireSoundDrive(const DriveParams& drive, core::FieldVisitor& v);

}  // namespace rockyard::trial
