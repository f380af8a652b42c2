#include "campaign/stereo/render_pair.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "campaign/run_source.h"
#include "campaign/stereo/match_pair.h"
#include "core/json_text.h"
#include "image_files/float_files.h"
#include "image_files/png_file.h"
#include "sensing/stereo_imager.h"
#include "terrain/field.h"
#include "trial/course/layout.h"
#include "vision/cameras/camera_file.h"
#include "vision/cameras/rectification.h"

namespace rockyard::campaign {
namespace {

using vision::Image;

// Returns the disparities as a matcher stores them: pictures are made of such.
vision::DisparityImage Stored(const Image<float>& disparities) {
  vision::DisparityImage stored(disparities.width(), disparities.height(),
                                vision::Dropped(vision::Drop::kOutside));
  for (int y = 0; y < stored.height(); ++y) {
    for (int x = 0; x < stored.width(); ++x) {
      const float px = disparities.At(x, y);
      if (!std::isfinite(px)) continue;
      stored.At(x, y) = static_cast<std::int16_t>(std::lround(px * vision::kDisparityOne));
    }
  }
  return stored;
}

struct Seen {
  float most_px = 0.0F;
  double share = 0.0;
};

Seen Summary(const Image<float>& disparities) {
  Seen seen;
  std::size_t count = 0;
  for (const float px : disparities.values()) {
    if (!std::isfinite(px)) continue;
    ++count;
    seen.most_px = std::max(seen.most_px, px);
  }
  seen.share = static_cast<double>(count) / static_cast<double>(disparities.values().size());
  return seen;
}

void Write(const sensing::StereoImages& images, const vision::StereoRig& rig,
           const Image<float>& disparities, float most_px, OutputFolder& folder) {
  folder.Write("left", "left.png", image_files::EncodePng(images.left));
  folder.Write("right", "right.png", image_files::EncodePng(images.right));
  folder.Write("cameras", "cameras.json",
               core::DumpJson(vision::CameraPairJson({rig.left, rig.right})) + "\n");
  folder.Write("disparity", "disparity.pfm", image_files::EncodePfm(disparities));
  vision::CorrelatorParams range;
  range.disparities = static_cast<std::int64_t>(std::ceil(most_px)) + 1;
  folder.Write("disparity_picture", "disparity.png",
               image_files::EncodePng(DisparityPicture(Stored(disparities), range)));
  folder.Finish();
}

scenario::Scenario LoadWithImages(const RenderRequest& request) {
  std::vector<std::string> overrides = request.overrides;
  overrides.emplace_back("sensors.stereo.fidelity=image");
  return LoadScenarioFrom(request.scenario, overrides);
}

core::TrialKey KeyOf(const RenderRequest& request, const scenario::Scenario& scenario) {
  return {request.seed.value_or(static_cast<std::uint64_t>(scenario.seed)), request.trial};
}

terrain::Terrain TerrainOf(const trial::DriveParams& drive, core::TrialKey key) {
  return terrain::BuildField(drive.terrain, trial::LayoutKey(drive, key),
                             trial::TerrainCourse(drive.course))
      .terrain;
}

}  // namespace

RenderResult RenderPair(const RenderRequest& request) {
  OutputFolder folder(
      request.out, request.existing,
      {.command = "render",
       .names = {"left.png", "right.png", "cameras.json", "disparity.pfm", "disparity.png"},
       .inputs = {request.scenario}});
  RenderStage stage(request);
  RenderResult result;
  result.pose = FirstPose(request, stage.scenario().drive.course.Start());
  const math::Transform& X_WR = stage.Stand(result.pose);
  const sensing::StereoImager& imager = stage.imager();
  const vision::StereoRig rig = stage.CalibratedRig(request.direction);
  const sensing::StereoImages images = imager.Expose(stage.terrain(), X_WR, 0, request.direction);
  const Image<float> disparities = imager.TrueDisparities(stage.terrain(), X_WR, request.direction);
  const Seen seen = Summary(disparities);
  const auto pair = vision::AlignedPair(rig.left, rig.right);
  result.size = rig.left.size;
  result.exposure_s = images.exposure_s;
  result.seen_by_both = seen.share;
  if (pair && seen.most_px > 0.0F) {
    result.nearest_m = pair->focal_px * pair->baseline_m / static_cast<double>(seen.most_px);
  }
  Write(images, rig, disparities, seen.most_px, folder);
  result.files = folder.files();
  return result;
}

RenderStage::RenderStage(const RenderRequest& request)
    : scenario_(LoadWithImages(request)),
      key_(KeyOf(request, scenario_)),
      terrain_(TerrainOf(scenario_.drive, key_)),
      rover_(rover::MakeRover(scenario_.drive.rover, terrain_)),
      imager_(scenario_.drive.sensors.stereo, scenario_.drive.sensors.sun,
              scenario_.drive.sensors.look, scenario_.drive.rover.geometry, key_) {}

const math::Transform& RenderStage::Stand(const math::Pose2& X_WR) {
  rover_->Place(X_WR);
  return rover_->state().X_WR;
}

math::Pose2 FirstPose(const RenderRequest& request, const math::Pose2& start) {
  return {request.x_m.value_or(start.x_m), request.y_m.value_or(start.y_m),
          request.heading_rad.value_or(start.heading_rad)};
}

}  // namespace rockyard::campaign
