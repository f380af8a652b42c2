#include "sensing/scan_curve.h"

#include <algorithm>
#include <cmath>

#include "vision/lens.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;

// The curve of the header, by column.
class Curve {
 public:
  Curve(const messages::StripeCalibration& calibration, std::size_t row, std::size_t stripe)
      : laser_(calibration.lasers[stripe]),
        camera_(calibration.cameras[static_cast<std::size_t>(laser_.camera)]),
        row_px_(calibration.scanline_px[row]) {}

  int half_columns() const { return camera_.columns / 2; }

  // None where the viewing ray does not meet the light plane in front of the camera.
  std::optional<Vector3> At(double column) const {
    const Vector3 ray_R = camera_.X_RC.linear() * vision::PixelRay(camera_, {column, row_px_});
    const Vector3 eye_R = camera_.X_RC.translation();
    const double distance_m =
        laser_.normal_R.dot(laser_.p_RoE_R - eye_R) / laser_.normal_R.dot(ray_R);
    if (!(distance_m > 0.0) || !std::isfinite(distance_m)) return std::nullopt;
    return eye_R + distance_m * ray_R;
  }

 private:
  const messages::StripeLaser& laser_;
  const messages::StripeCamera& camera_;
  double row_px_;
};

// Appends the points after p(from) up to p(to) between which chords are near enough to the curve.
void Divide(const Curve& curve, double from, double to, std::vector<Vector3>& vertices) {
  constexpr double kSmallest_px = 0.5;
  const Vector3 start = *curve.At(from);
  const Vector3 end = *curve.At(to);
  const double middle = 0.5 * (from + to);
  const Vector3 along = (end - start).normalized();
  const Vector3 aside = *curve.At(middle) - start;
  // The middle column is not where the chord is farthest from the curve: half the bound is left.
  const double gap_m = (aside - along.dot(aside) * along).norm();
  if (gap_m <= 0.5 * ScanCurve::kChordError_m || std::abs(to - from) <= kSmallest_px) {
    vertices.push_back(end);
    return;
  }
  Divide(curve, from, middle, vertices);
  Divide(curve, middle, to, vertices);
}

}  // namespace

ScanCurve::ScanCurve(const messages::StripeCalibration& calibration, std::size_t row,
                     std::size_t stripe) {
  const Curve curve(calibration, row, stripe);
  const double low_z_m = calibration.datum_z_m + calibration.search_low_m;
  const double high_z_m = calibration.datum_z_m + calibration.search_high_m;
  messages::ColumnRange seen;
  for (int column = -curve.half_columns(); column <= curve.half_columns(); ++column) {
    const auto point_R = curve.At(column);
    if (!point_R || point_R->z() < low_z_m) continue;
    if (seen.empty()) seen.first = column;
    seen.last = column;
    if (point_R->z() > high_z_m) continue;
    if (searched_.empty()) searched_.first = column;
    searched_.last = column;
  }
  if (seen.last <= seen.first) return;
  // From edge to edge of the pixels.
  double begin = curve.At(seen.first - 0.5) ? seen.first - 0.5 : seen.first;
  double end = curve.At(seen.last + 0.5) ? seen.last + 0.5 : seen.last;
  if (curve.At(begin)->z() < curve.At(end)->z()) std::swap(begin, end);
  vertices_R_.push_back(*curve.At(begin));
  Divide(curve, begin, end, vertices_R_);
}

std::optional<Vector3> ScanCurve::FirstHit(const terrain::Terrain& terrain,
                                           const math::Transform& X_WR,
                                           std::span<const int> rocks) const {
  for (std::size_t i = 0; i + 1 < vertices_R_.size(); ++i) {
    const Vector3 start_W = X_WR * vertices_R_[i];
    const Vector3 chord_W = X_WR.linear() * (vertices_R_[i + 1] - vertices_R_[i]);
    const double length_m = chord_W.norm();
    const Vector3 direction_W = chord_W / length_m;
    const auto distance_m = terrain.RayDistance(start_W, direction_W, length_m, rocks);
    if (distance_m) return start_W + *distance_m * direction_W;
  }
  return std::nullopt;
}

}  // namespace rockyard::sensing
