// The terrain of a trial with a rover that is stood on it, and the stereo cameras that it carries.
#pragma once

#include <memory>

#include "core/random.h"
#include "math/pose.h"
#include "rover/rover.h"
#include "scenario/scenario.h"
#include "sensing/stereo_imager.h"
#include "terrain/terrain.h"

namespace rockyard::campaign {

struct RenderRequest;

// Everything at rest: the rover settles on the ground and whatever else stands there.
class RenderStage {
 public:
  // Of the request its scenario with overrides, seed and trial. A scenario whose stereo sensor has
  // other fidelities has cameras all the same. Throws core::UserError for what is wrong with them.
  explicit RenderStage(const RenderRequest& request);
  RenderStage(const RenderStage&) = delete;  // the rover stands on this very terrain
  RenderStage& operator=(const RenderStage&) = delete;

  const scenario::Scenario& scenario() const { return scenario_; }
  const terrain::Terrain& terrain() const { return terrain_; }
  const sensing::StereoImager& imager() const { return imager_; }

  // Stands the rover there and gives back where it came to rest.
  const math::Transform& Stand(const math::Pose2& X_WR);

 private:
  scenario::Scenario scenario_;
  core::TrialKey key_;
  terrain::Terrain terrain_;
  std::unique_ptr<rover::Rover> rover_;
  sensing::StereoImager imager_;
};

// Where the rover is to stand at first: of the request, and what is absent there of the trial's
// start.
math::Pose2 FirstPose(const RenderRequest& request, const math::Pose2& start);

}  // namespace rockyard::campaign
