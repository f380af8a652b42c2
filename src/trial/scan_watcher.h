// Looks over the shoulder of the light stripe sensor: for pictures of a scan, never for decisions.
#pragma once

#include <functional>

#include "core/random.h"
#include "math/pose.h"
#include "messages/measurements.h"
#include "terrain/terrain.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

// A scan that was just taken, and what it was taken of. Valid during the call only.
struct WatchedScan {
  const DriveParams& drive;  // of the sensor: a study may vary it from cell to cell
  const terrain::Terrain& terrain;
  const math::Transform& X_WR;
  core::TrialKey key;
  const messages::StripeScan& scan;
};

using ScanWatcher = std::function<void(const WatchedScan&)>;

}  // namespace rockyard::trial
