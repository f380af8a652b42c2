#include "trial/hazard_scanner.h"

namespace rockyard::trial {

HazardScanner::HazardScanner(const scenario::Scenario& scenario)
    : light_stripe_(scenario.sensors.light_stripe) {}

messages::StripeScan HazardScanner::Scan(const terrain::Terrain& terrain,
                                         const math::Transform& X_WR, core::TrialKey key,
                                         std::int64_t scan_number) const {
  return light_stripe_.Scan(terrain, X_WR, key, scan_number);
}

}  // namespace rockyard::trial
