#include "sensing/scan_curve.h"

#include <algorithm>
#include <cmath>

#include "vision/lens.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;
using messages::ColumnRange;

// The curve of the header, by column.
class Curve {
 public:
  Curve(const messages::StripeCalibration& calibration, std::size_t row, std::size_t stripe)
      : laser_(calibration.lasers[stripe]),
        camera_(calibration.cameras[static_cast<std::size_t>(laser_.camera)]),
        row_px_(calibration.scanline_px[row]) {}

  ColumnRange columns() const { return camera_.image_columns(); }

  // None where the viewing ray does not meet the light plane in front of the camera.
  // The point of the curve at a column, in R.
  std::optional<Vector3> At(double column) const {
    const Vector3 ray_R = camera_.X_RC.linear() * vision::PixelRay(camera_, {column, row_px_});
    const Vector3 eye_R = camera_.X_RC.translation();
    // Ray o + s r meets the plane n . (p - e) = 0 at s = n . (e - o) / n . r. None where that is
    // not in front of the camera; a ray in the plane divides by zero and is not finite.
    const double distance_m =
        laser_.normal_R.dot(laser_.p_RoE_R - eye_R) / laser_.normal_R.dot(ray_R);
    if (!(distance_m > 0.0) || !std::isfinite(distance_m)) return std::nullopt;
    return eye_R + distance_m * ray_R;
  }

 private:
  const messages::StripeLaser& laser_;
  const messages::Camera& camera_;
  double row_px_;
};

// A column and the curve there.
struct CurvePoint {
  double column = 0.0;
  Vector3 p_R;
};

// Appends the points after `from` up to `to` between which chords are near enough to the curve.
// Where the curve has a gap between them, the chord bridges it.
void Divide(const Curve& curve, const CurvePoint& from, const CurvePoint& to,
            std::vector<Vector3>& vertices) {
  constexpr double kSmallest_px = 0.5;
  const double middle = 0.5 * (from.column + to.column);
  const auto middle_R = curve.At(middle);
  const bool is_short = std::abs(to.column - from.column) <= kSmallest_px;
  if (!middle_R || is_short) {
    vertices.push_back(to.p_R);
    return;
  }
  const Vector3 along = (to.p_R - from.p_R).normalized();
  const Vector3 aside = *middle_R - from.p_R;
  // The middle column is not where the chord is farthest from the curve: half the bound is left.
  const double gap_m = (aside - along.dot(aside) * along).norm();
  if (gap_m <= 0.5 * ScanCurve::kChordError_m) {
    vertices.push_back(to.p_R);
    return;
  }
  Divide(curve, from, {middle, *middle_R}, vertices);
  Divide(curve, {middle, *middle_R}, to, vertices);
}

// Columns without a gap that see the light plane above the lowest searched elevation, and those of
// them within the searched elevations.
struct Stretch {
  ColumnRange seen;
  ColumnRange searched;

  int searched_columns() const { return searched.last - searched.first + 1; }
};

void Extend(ColumnRange& range, int column) {
  if (range.empty()) range.first = column;
  range.last = column;
}

// A wide lens may see the light plane in several stretches, some of them behind the emitter, where
// no light goes. The one with most of the searched elevations is taken.
Stretch LongestStretch(const Curve& curve, double low_z_m, double high_z_m) {
  std::vector<Stretch> stretches(1);
  const ColumnRange columns = curve.columns();
  for (int column = columns.first; column <= columns.last; ++column) {
    const auto point_R = curve.At(column);
    if (!point_R || point_R->z() < low_z_m) {
      if (!stretches.back().seen.empty()) stretches.emplace_back();
      continue;
    }
    Extend(stretches.back().seen, column);
    if (point_R->z() <= high_z_m) Extend(stretches.back().searched, column);
  }
  return *std::max_element(stretches.begin(), stretches.end(),
                           [](const Stretch& a, const Stretch& b) {
                             return a.searched_columns() < b.searched_columns();
                           });
}

// The outer edge of a pixel, or its middle where the curve does not reach the edge.
CurvePoint EdgeOf(const Curve& curve, int column, double outwards_px) {
  const auto edge_R = curve.At(column + outwards_px);
  if (edge_R) return {column + outwards_px, *edge_R};
  return {static_cast<double>(column), *curve.At(column)};
}

}  // namespace

ScanCurve::ScanCurve(const messages::StripeCalibration& calibration, std::size_t row,
                     std::size_t stripe) {
  const Curve curve(calibration, row, stripe);
  const auto [seen, searched] =
      LongestStretch(curve, calibration.datum_z_m + calibration.search_low_m,
                     calibration.datum_z_m + calibration.search_high_m);
  searched_ = searched;
  if (seen.last <= seen.first) return;
  CurvePoint begin = EdgeOf(curve, seen.first, -0.5);
  CurvePoint end = EdgeOf(curve, seen.last, 0.5);
  // From the emitter's side, above, downwards: the first surface on the way is the one that is lit.
  if (begin.p_R.z() < end.p_R.z()) std::swap(begin, end);
  vertices_R_.push_back(begin.p_R);
  Divide(curve, begin, end, vertices_R_);
}

std::optional<Vector3> ScanCurve::FirstHit(const terrain::Terrain& terrain,
                                           const math::Transform& X_WR,
                                           std::span<const int> rocks) const {
  for (std::size_t i = 0; i + 1 < vertices_R_.size(); ++i) {
    // Chord after chord from the emitter's side: the first surface on the way is the lit one.
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
