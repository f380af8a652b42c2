// What `rockyard render` does: what the stereo cameras of a scenario's rover see, as files that
// `rockyard stereo` reads.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "campaign/output_folder.h"
#include "math/pose.h"
#include "messages/point_cloud.h"
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

  // Where the rover stands, in W; what is absent is of the trial's start.
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

// Stands the rover on the terrain of the trial and takes one look, at rest on the ground and
// whatever else stands there. Writes left.png, right.png, cameras.json (both cameras in the frame
// of the rover), disparity.pfm (what is true of the left image) and disparity.png (the same to look
// at). Throws core::UserError for what is wrong with scenario, place or folder. Cost: some 0.5 s
// for images of 512 x 512 pixels.
RenderResult RenderPair(const RenderRequest& request);

}  // namespace rockyard::campaign
