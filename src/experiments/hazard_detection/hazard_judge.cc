#include "experiments/hazard_detection/hazard_judge.h"

#include <numbers>
#include <utility>
#include <vector>

#include "core/random.h"
#include "math/functions.h"
#include "perception/hazard_detector.h"
#include "sensing/stripe_layout_params.h"
#include "terrain/rock.h"
#include "trial/sight/onboard_calibration.h"

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

using math::Vector3;

terrain::Rock DrawSceneRock(const RockCell& cell, RockProportions proportions,
                            const terrain::RockFieldParams& law, double lateral_m,
                            core::RandomStream& stream) {
  const double width_ratio = core::SampleUniform(stream, law.min_width_ratio, law.max_width_ratio);
  const double height_ratio =
      core::SampleUniform(stream, law.min_height_ratio, law.max_height_ratio);
  const double buried = core::SampleUniform(stream, law.burial_mean - law.burial_spread,
                                            law.burial_mean + law.burial_spread);
  const double c_m = 0.5 * cell.height_m / (1.0 - buried);
  const bool natural = proportions == RockProportions::kNatural;
  const terrain::RockOutline outline{
      .diameter_m = natural ? 2.0 * c_m / height_ratio : cell.diameter_m,
      .width_ratio = width_ratio,
      .half_height_m = c_m,
      .height_m = cell.height_m};
  terrain::Rock rock = terrain::ShapeRock(outline, law.pointedness);
  // An ellipse looks the same after half a turn.
  rock.yaw_rad = core::SampleUniform(stream, -0.5 * std::numbers::pi, 0.5 * std::numbers::pi);
  rock.center_W.head<2>() << rock.semi_axes_m.x(), lateral_m;
  return rock;
}

terrain::Terrain SceneTerrain(const terrain::Rock& rock) {
  std::vector<terrain::Rock> rocks;
  if (rock.height_m > 0.0) rocks.push_back(rock);
  return {terrain::Ground(), std::move(rocks), {}};
}

math::Transform PoseBefore(double gap_m, double heading_rad, double front_x_m) {
  math::Transform X_WR = math::Transform::Identity();
  X_WR.linear() = math::RotationAbout(heading_rad, Vector3::UnitZ());
  const Vector3 front_W(-gap_m, -gap_m * math::Tan(heading_rad), 0.0);
  X_WR.translation() = front_W - X_WR.linear() * Vector3(front_x_m, 0.0, 0.0);
  return X_WR;
}

}  // namespace rockyard::experiments
