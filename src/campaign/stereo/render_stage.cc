#include "campaign/stereo/render_stage.h"

#include <cstdint>
#include <string>
#include <vector>

#include "campaign/stereo/render_pair.h"
#include "scenario/load.h"
#include "terrain/field.h"
#include "trial/layout.h"

namespace rockyard::campaign {
namespace {

scenario::Scenario LoadWithImages(const RenderRequest& request) {
  std::vector<std::string> overrides = request.overrides;
  overrides.emplace_back("sensors.stereo.fidelity=image");
  return scenario::LoadScenario(request.scenario, overrides);
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
