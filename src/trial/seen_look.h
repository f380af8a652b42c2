// A look at the terrain on its way to the navigator.
#pragma once

#include "math/pose.h"
#include "messages/look.h"
#include "trial/terrain_sensing.h"

namespace rockyard::trial {

struct SeenLook {
  // Null where the navigator does not read it.
  const messages::HazardReport* report() const {
    return percept.report ? &*percept.report : nullptr;
  }
  const messages::PointCloud* cloud() const { return percept.cloud ? &*percept.cloud : nullptr; }

  Percept percept;
  messages::LookMoment moment;
  math::Transform X_WR = math::Transform::Identity();  // where the rover truly was
};

}  // namespace rockyard::trial
