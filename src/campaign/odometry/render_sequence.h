// What `rockyard render --pairs` does, for that command: the pairs of images that a scenario's
// rover takes on its way, with the true poses, as a folder that `rockyard vo` reads.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "campaign/output_folder.h"
#include "campaign/stereo/render_pair.h"
#include "campaign/stop.h"
#include "campaign/work.h"
#include "math/angles.h"
#include "math/pose.h"
#include "messages/estimates.h"
#include "vision/cameras/camera_types.h"

namespace rockyard::campaign {

// Which way a rover takes (CircleWay, CornerWay).
enum class SequenceWay {
  kCircle,  // steps of equal length and turn, whatever is in the way: it is stood on rocks too
  kRoute,   // from the start of the course around its rocks to the goal, as an oracle plans it
};

struct SequenceRequest {
  RenderRequest scene;  // where it begins, and all else that does not move
  SequenceWay way = SequenceWay::kCircle;
  std::int64_t pairs = 2;  // >= 1; of a route at most so many
  double step_m = 0.25;
  double turn_rad = 0.0;  // of a route: the largest turn on the spot between two pairs
  double period_s = 1.0;  // between two pairs, for times.txt; nothing else depends on it
  double slip = 0.0;      // 1 - (true over commanded step), below 1; for wheels.txt alone
};

struct SequenceResult {
  Outcome outcome = Outcome::kDone;  // or kInterrupted: what is there is a shorter sequence
  std::int64_t pairs = 0;
  std::int64_t planned = 0;
  double distance_m = 0.0;  // of the rover, in space
  vision::ImageSize size;   // of every image
  std::vector<OutputFile> files;
};

// Called after each pair: how many there are, of how many.
using SequenceProgress = std::function<void(std::int64_t done, std::int64_t planned)>;

// Writes left/000000.png, right/000000.png and so on, and at the end cameras.json (both cameras in
// the frame R of the rover), left_free.png and right_free.png (0 where a pixel shows the rover
// itself), poses.txt (X_WR of each pair, in KITTI's form), wheels.txt (poses by commanded steps and
// true attitudes, from the identity: what wheels tell) and times.txt (s). The noise of each pair is
// its own. Must stay: names and forms, which EstimatePath reads.
//
// Throws core::UserError for what is wrong with scenario or folder, a way that leaves the arena,
// and a course without a route. Cost: some 0.3 s a pair of 512 x 384 pixels.
SequenceResult RenderSequence(const SequenceRequest& request, const SequenceProgress& progress = {},
                              const Stop& stop = {});

// Returns the name of an image of a sequence.
std::string SequenceImageName(std::int64_t number);

// Returns `count` poses in W, the first of them `start`. From each to the next the rover goes
// `step_m` (backwards where negative; where 0 it stays) along a circle on which the heading grows
// by `turn_rad`:
//
//   chord = step sin(turn / 2) / (turn / 2), in the direction of heading + turn / 2.
//
// Requires count >= 1.
std::vector<math::Pose2> CircleWay(const math::Pose2& start, std::int64_t count, double step_m,
                                   double turn_rad);

// Returns the way from `start` along straight lines through `corners`, in at most `count` poses. At
// each corner the rover turns on the spot, in equal turns of at most `turn_rad`, then it drives in
// steps of `step_m`, the last one as long as it is to the corner. Corners nearer than 1 mm are
// passed over. Requires count >= 1, step_m > 0, turn_rad > 0.
std::vector<math::Pose2> CornerWay(const math::Pose2& start,
                                   std::span<const messages::Goal> corners, std::int64_t count,
                                   double step_m, double turn_rad);

}  // namespace rockyard::campaign
