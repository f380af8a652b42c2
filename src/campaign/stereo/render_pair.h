// What `rockyard render` does, for that command: what the stereo cameras of a scenario's rover see,
// as files that `rockyard stereo` reads. The stage that the rover stands on, of terrain, rover and
// cameras of a trial, serves sequences (odometry/render_sequence.h), too. No record depends on it.
// A pair has the noise of look 0 of its trial.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "campaign/output_folder.h"
#include "core/random.h"
#include "math/pose.h"
#include "messages/point_cloud.h"
#include "rover/rover.h"
#include "scenario/scenario.h"
#include "sensing/stereo_imager.h"
#include "terrain/terrain.h"
#include "vision/cameras/camera_types.h"

namespace rockyard::campaign {

struct RenderRequest {
  std::filesystem::path scenario;
  std::vector<std::string> overrides;  // PATH=VALUE of the scenario
  std::optional<std::uint64_t> seed;   // absent: the scenario's
  std::uint32_t trial = 0;
  std::filesystem::path out;  // a folder, which is made
  ExistingFiles existing = ExistingFiles::kRefuse;
  messages::LookDirection direction = messages::LookDirection::kAhead;

  // Where the rover stands, in W. What is absent is taken from the start of the trial.
  std::optional<double> x_m;
  std::optional<double> y_m;
  std::optional<double> heading_rad;
};

struct RenderResult {
  math::Pose2 pose;           // of the rover, in W
  vision::ImageSize size;     // of either image
  double exposure_s = 0.0;    // of both
  double nearest_m = 0.0;     // depth of the nearest point that both eyes see; 0: there is none
  double seen_by_both = 0.0;  // share of the left image's pixels
  std::vector<OutputFile> files;
};

// Stands the rover on the terrain of the trial and takes one look. Writes left.png, right.png,
// cameras.json (both cameras in the frame R of the rover), disparity.pfm (what is true of the left
// image) and disparity.png (a picture of that). Throws core::UserError for what is wrong with
// scenario, place or folder. Cost: some 0.5 s for images of 512 x 512 pixels.
RenderResult RenderPair(const RenderRequest& request);

// The terrain, rover and cameras of a trial, at rest: the rover settles on the ground and whatever
// else stands there.
class RenderStage {
 public:
  // Takes scenario with overrides, seed and trial of the request. A scenario whose stereo sensor
  // has another fidelity has cameras all the same. Throws core::UserError for what is wrong with
  // scenario or overrides.
  explicit RenderStage(const RenderRequest& request);
  RenderStage(const RenderStage&) = delete;  // the rover stands on this very terrain
  RenderStage& operator=(const RenderStage&) = delete;

  const scenario::Scenario& scenario() const { return scenario_; }
  const terrain::Terrain& terrain() const { return terrain_; }
  const sensing::StereoImager& imager() const { return imager_; }
  vision::StereoRig CalibratedRig(messages::LookDirection direction) const {
    return sensing::CalibratedRig(scenario_.drive.sensors.stereo, scenario_.drive.rover.geometry,
                                  direction);
  }

  // Stands the rover at a pose and returns where it came to rest.
  const math::Transform& Stand(const math::Pose2& X_WR);

 private:
  scenario::Scenario scenario_;
  core::TrialKey key_;
  terrain::Terrain terrain_;
  std::unique_ptr<rover::Rover> rover_;
  sensing::StereoImager imager_;
};

// Returns where the rover is to stand at first: the place of the request, and where that is absent,
// the start of the trial.
math::Pose2 FirstPose(const RenderRequest& request, const math::Pose2& start);

}  // namespace rockyard::campaign
