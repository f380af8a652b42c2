// Looks over the shoulder of a map-based navigator: for pictures of a step, never for decisions.
#pragma once

#include <functional>

#include "core/random.h"
#include "math/pose.h"
#include "messages/look.h"
#include "messages/navigation_view.h"
#include "messages/point_cloud.h"
#include "terrain/terrain.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

// A decision that followed a look, and what was seen. Valid during the call only.
struct WatchedStep {
  const DriveParams& drive;
  const terrain::Terrain& terrain;
  const math::Transform& X_WR;  // true, where it looked
  core::TrialKey key;
  const messages::NavigationView& view;
  const messages::PointCloud& cloud;
  const messages::LookMoment& look;  // when, and where it believed to be then
};

using StepWatcher = std::function<void(const WatchedStep&)>;

}  // namespace rockyard::trial
