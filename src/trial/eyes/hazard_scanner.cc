#include "trial/eyes/hazard_scanner.h"

#include <utility>

namespace rockyard::trial {

HazardScanner::HazardScanner(const DriveParams& drive, ScanWatcher watcher)
    : eyes_(drive, {}), reader_(drive), watcher_(std::move(watcher)) {
  if (watcher_) watched_ = std::make_shared<const DriveParams>(drive);
}

messages::StripeScan HazardScanner::Scan(const terrain::Terrain& terrain,
                                         const math::Transform& X_WR, core::TrialKey key,
                                         std::int64_t scan_number) const {
  messages::StripeScan scan = reader_.ScanOf(eyes_.Scan(terrain, X_WR, key, scan_number));
  if (watcher_) watcher_({*watched_, terrain, X_WR, key, scan});
  return scan;
}

}  // namespace rockyard::trial
