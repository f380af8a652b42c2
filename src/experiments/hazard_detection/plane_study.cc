// Study "precision": range and elevation of a plane, by baseline.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include "core/random.h"
#include "experiments/cell_experiment.h"
#include "experiments/hazard_detection/hazard_detection.h"
#include "perception/triangulation.h"
#include "sensing/stripe_layout_params.h"
#include "terrain/terrain.h"
#include "trial/eyes/hazard_scanner.h"
#include "trial/sight/onboard_calibration.h"
#include "vision/lens.h"

namespace rockyard::experiments {
namespace {

using math::Vector3;
using trial::DriveParams;

// Published: "range resolution is approximately 2 mm at 30 cm" (Matthies 1995 sec. 6).
constexpr double kStatedRange_m = 0.3;

// Returns the drive with all emitters but the centre one at a given baseline from the camera of
// their side, which has to stand on the axis of the cameras.
DriveParams WithBaseline(DriveParams drive, double baseline_m) {
  sensing::LightStripeParams& sensor = drive.sensors.light_stripe;
  sensor.inner_emitter_y_m = BaselineEmitterY(sensor.camera_separation_m, baseline_m);
  sensor.outer_emitter_y_m = sensor.inner_emitter_y_m;
  return drive;
}

// Returns what one measured error contributes to the mean range that a column stands for: errors
// uniform over a column have a quarter of that range as their mean magnitude.
double RangeOfAPixel(double range_error_m) { return 4.0 * std::abs(range_error_m); }

// From columns of one scanline to points, by one calibration.
class Scanline {
 public:
  Scanline(const messages::StripeCalibration& calibration, std::size_t row, std::size_t stripe)
      : calibration_(calibration), triangulator_(calibration), row_(row), stripe_(stripe) {}

  double Elevation(double column_px) const {
    return triangulator_.Elevation(row_, stripe_, column_px).elevation_m;
  }

  // Returns the range from the camera to where the column's ray meets the light plane.
  double Range(double column_px) const {
    const messages::Camera& camera = Camera();
    const Vector3 ray_R =
        camera.X_RC.linear() *
        vision::PixelRay(camera, {column_px, static_cast<double>(calibration_.scanline_px[row_])});
    const double z_m = Elevation(column_px) + calibration_.datum_z_m;
    return (z_m - camera.X_RC.translation().z()) / ray_R.z();
  }

  // Returns the column, between pixels, of a point at a known elevation: Newton's method from a
  // column nearby. None where it does not settle.
  std::optional<double> ColumnOf(double elevation_m, double column_px) const {
    constexpr int kSteps = 20;
    constexpr double kSettled_m = 1e-9;
    constexpr double kHalfStep_px = 0.01;
    for (int i = 0; i < kSteps; ++i) {
      const double miss_m = Elevation(column_px) - elevation_m;
      if (std::abs(miss_m) < kSettled_m) return column_px;
      const double slope =
          (Elevation(column_px + kHalfStep_px) - Elevation(column_px - kHalfStep_px)) /
          (2.0 * kHalfStep_px);
      column_px -= miss_m / slope;
    }
    return std::nullopt;
  }

  double Baseline() const {
    return (calibration_.lasers[stripe_].p_RoE_R - Camera().X_RC.translation()).norm();
  }
  double Pitch() const { return Camera().column_pitch_rad; }

 private:
  const messages::Camera& Camera() const {
    return calibration_.cameras[static_cast<std::size_t>(calibration_.lasers[stripe_].camera)];
  }

  const messages::StripeCalibration& calibration_;
  perception::Triangulator triangulator_;
  std::size_t row_;
  std::size_t stripe_;
};

class PlaneStudy final : public CellExperiment {
 public:
  PlaneStudy(const HazardDetectionParams& params, const trial::DriveParams& drive,
             const trial::ScanWatcher& watcher)
      : CellExperiment(
            params.Factors(), HazardColumns(),
            {"points", "found", "range_m", "range_bias_m", "range_error_m", "elevation_bias_m",
             "elevation_error_m", "range_step_m", "equation_2_m", "resolution_30cm_m"}),
        params_(params),
        drive_(drive),
        watcher_(watcher) {}

 private:
  std::vector<double> Measure(std::size_t cell, core::TrialKey key) const override {
    const std::vector<double> factors = table().Values(cell);
    const DriveParams drive = WithBaseline(drive_, factors[0]);
    const trial::HazardScanner scanner(drive, watcher_);
    const messages::StripeCalibration truth = sensing::TrueCalibration(drive.sensors.light_stripe);
    const messages::StripeCalibration believed =
        trial::OnboardStripeCalibration(drive.sensors.light_stripe, drive.perception.calibration);
    const auto row = static_cast<std::size_t>(factors[1]);
    std::vector<double> sums(10, 0.0);
    for (std::int64_t scene = 0; scene < params_.scenes_per_run; ++scene) {
      const core::TrialKey scene_key = SceneKey(key, params_.scenes_per_run, scene);
      core::RandomStream placement(scene_key, core::Purpose::kScenePlacement);
      const double half_m = 0.5 * params_.plane_width_m;
      const double plane_m = factors[2] + core::SampleUniform(placement, -half_m, half_m);
      math::Transform X_WR = math::Transform::Identity();
      X_WR.translation().z() = -plane_m;
      const messages::StripeScan scan = scanner.Scan(sand_, X_WR, scene_key, 0);
      for (std::size_t stripe = 0; stripe < truth.lasers.size(); ++stripe) {
        const Scanline seen(believed, row, stripe);
        const Scanline real(truth, row, stripe);
        // Stripes whose emitters do not move, as the centre one, are no part of the cell.
        constexpr double kSame_m = 1e-6;
        if (std::abs(real.Baseline() - factors[0]) > kSame_m) continue;
        AddPoint(seen, real, scan.pixels[row][stripe], plane_m - truth.datum_z_m, sums);
      }
    }
    if (sums[0] == 0.0) throw std::logic_error("no stripe has the baseline of the cell");
    return sums;
  }

  static void AddPoint(const Scanline& seen, const Scanline& real,
                       const messages::StripePixel& pixel, double elevation_m,
                       std::vector<double>& sums) {
    sums[0] += 1.0;
    if (!pixel.detected) return;
    const auto column = real.ColumnOf(elevation_m, pixel.column_px);
    if (!column) return;
    const double range_m = real.Range(*column);
    const double range_error_m = seen.Range(pixel.column_px) - range_m;
    const double elevation_error_m = seen.Elevation(pixel.column_px) - elevation_m;
    const double step_m = std::abs(real.Range(*column + 0.5) - real.Range(*column - 0.5));
    const double scale = kStatedRange_m / range_m;
    const double row[] = {1.0,
                          range_m,
                          range_error_m,
                          range_error_m * range_error_m,
                          elevation_error_m,
                          elevation_error_m * elevation_error_m,
                          step_m,
                          real.Pitch() * range_m * range_m / real.Baseline(),
                          RangeOfAPixel(range_error_m) * scale * scale};
    for (std::size_t i = 0; i < std::size(row); ++i) sums[i + 1] += row[i];
  }

  HazardDetectionParams params_;
  DriveParams drive_;
  trial::ScanWatcher watcher_;
  terrain::Terrain sand_{terrain::Ground(), {}, {}};
};

}  // namespace

std::unique_ptr<Experiment> MakePrecisionStudy(const HazardDetectionParams& params,
                                               const trial::DriveParams& drive,
                                               const trial::ScanWatcher& watcher) {
  return std::make_unique<PlaneStudy>(params, drive, watcher);
}

}  // namespace rockyard::experiments
