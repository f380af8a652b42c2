// Conditions across modules of a drive: conditions without which no trial can be built or would
// mean anything (RequireConsistency), and combinations that every module accepts and that mislead
// (RequireSoundDrive). Experiments require them when a scenario is read. They decide which
// scenarios are refused; no record depends on them.
#pragma once

#include "core/fields.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

// When the light stripe sensor has a part in an experiment.
enum class LightStripeUse {
  kAsTerrainSensor,  // where sensors.terrain_sensor chooses it
  kAlways,           // the experiment measures it
};

// Requires, for every experiment (drive_consistency_params.cc):
// - start, waypoints and goal lie in the arena, between the mirror lines of a virtual one;
// - the centre of mass lies where every wheel carries something on level ground;
// - no more than one control step per step of the physics, and rocks that move only in multibody;
// - the goal radius holds the tolerance of the navigator in use;
// - a navigator that tells stripes apart names every stripe of the array that it judges;
// - where the light stripe is used: its finder averages no more lines than are read, and the rover
//   hides no point of flat ground from its images.
// Each failure names the parameter, what is wrong and a remedy.
void RequireConsistency(const DriveParams& drive, LightStripeUse light_stripe,
                        core::FieldVisitor& v);

// Difference up to which lengths that are written in two places of a file agree.
inline constexpr double kSame_m = 1e-9;

// Requires, for drives to a goal and only of groups that are in use:
// - stereo cameras are on the rover: from its rear edge to half its length ahead of its front;
// - the elevation array that the behaviour controller takes from stereo lies on level ground that
//   the cameras ahead can show (bounds that no view exceeds; the view may be narrower), and asks
//   for no more points than an image has pixels;
// - the soil holds the braked rover on the slope of the ground;
// - no ditch or pit reaches under the rover at the start;
// - listed rocks leave start, waypoints and goal of a drive free by terrain.rocks.clear_radius_m;
// - goals and waypoints that a lander designates stay between the mirror lines of a
//   virtual_reflected arena, in which targets do not move;
// - an oracle's route leads to one goal that nobody tracks;
// - a route has somebody who follows it or drives along its corners, not both, and no other
//   waypoints; the map of a lander has a lander (course.designation);
// - GESTALT takes its vehicle for at most twice and at least half as long and wide as it is;
// - a stuck rover that runs on has batteries that can be empty;
// - aids, visual odometry and the check of slip have somebody who listens and answers;
// - visual odometry by images has two eyes that stand apart;
// - a navigator that looks or steers on the move has the sensor, overlap and steering rate for it;
// - a navigator that asks for images has cameras that take them, and so has a reader of images, for
//   somebody who wants its points;
// - a rock at the goal can be found by what the navigator reads.
// Each failure names the parameter, what is wrong and a remedy.
void RequireSoundDrive(const DriveParams& drive, core::FieldVisitor& v);

// Refuses images for visual odometry of a pair without a baseline. Drives that use them and the
// study of visual odometry require it.
void RequireTwoEyes(const DriveParams& drive, core::FieldVisitor& v);

}  // namespace rockyard::trial
