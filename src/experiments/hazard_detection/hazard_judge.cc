#include "experiments/hazard_detection/hazard_judge.h"

#include <utility>

#include "perception/hazard_detector.h"
#include "sensing/stripe_layout_params.h"
#include "trial/eyes/onboard_calibration.h"

namespace rockyard::experiments {

HazardJudge::HazardJudge(const trial::DriveParams& drive, trial::ScanWatcher watcher)
    : hazard_(drive.perception.hazard),
      scanner_(drive, std::move(watcher)),
      triangulator_(trial::OnboardStripeCalibration(drive.sensors.light_stripe,
                                                    drive.perception.calibration)),
      stripes_(sensing::ArraySize(drive.sensors.light_stripe).stripes) {}

messages::ElevationScan HazardJudge::Scan(const terrain::Terrain& terrain,
                                          const math::Transform& X_WR, core::TrialKey key,
                                          std::int64_t scan_number) const {
  return triangulator_.Elevations(scanner_.Scan(terrain, X_WR, key, scan_number));
}

Percept HazardJudge::Look(const terrain::Terrain& terrain, const math::Transform& X_WR,
                          core::TrialKey key, std::int64_t first_scan) const {
  perception::HazardDetector detector(hazard_);
  Percept percept(stripes_);
  perception::HazardDetector::Verdict verdict{true, {}};
  while (verdict.scan_again) {
    const messages::ElevationScan scan = Scan(terrain, X_WR, key, first_scan + percept.scans);
    if (percept.scans == 0) percept.first = perception::AssessHazards(scan, hazard_);
    ++percept.scans;
    verdict = detector.Process(scan);
  }
  percept.believed = verdict.report.stripe_hazard;
  return percept;
}

}  // namespace rockyard::experiments
