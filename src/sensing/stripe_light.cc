#include "sensing/stripe_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "math/functions.h"
#include "sensing/stripe_layout_params.h"
#include "vision/lens.h"

namespace rockyard::sensing {

namespace {

using math::Vector3;
using messages::ColumnRange;

// The curve of ScanCurve, by column.
class Curve {
 public:
  Curve(const messages::StripeCalibration& calibration, std::size_t row, std::size_t stripe)
      : laser_(calibration.lasers[stripe]),
        camera_(calibration.cameras[static_cast<std::size_t>(laser_.camera)]),
        row_px_(calibration.scanline_px[row]) {}

  ColumnRange columns() const { return camera_.image_columns(); }

  // Returns the point of the curve at a column, in R; none where the viewing ray does not meet the
  // light plane in front of the camera.
  std::optional<Vector3> At(double column) const {
    const Vector3 ray_R = camera_.X_RC.linear() * vision::PixelRay(camera_, {column, row_px_});
    const Vector3 eye_R = camera_.X_RC.translation();
    // The ray o + s r meets the plane n . (p - e) = 0 at s = n . (e - o) / n . r. For a ray in the
    // plane s divides by zero and is not finite.
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
  // The chord may be farther from the curve elsewhere than at the middle column: half the bound is
  // kept in reserve.
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

// Returns the curve at the outer edge of a pixel, or at its middle where the curve does not reach
// the edge.
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
  // The chords must lead from the emitter's side, above, downwards: the first surface on the way is
  // the lit one.
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

namespace {

using math::Vector3;

constexpr double kScanlinesOfThinBeam = 3.0;  // Matthies 1995 sec. 6

}  // namespace

double FanPower(const LightStripeParams& params) {
  const LaserParams& laser = params.laser;
  // F: the fan, or three row pitches (Matthies 1995, section 6).
  const double lit_rad =
      laser.fan == BeamFan::kFull ? params.fan_rad : kScanlinesOfThinBeam * params.row_pitch_rad();
  return laser.input_power_w * laser.optical_efficiency / lit_rad;
}

LaserFan::LaserFan(const LightStripeParams& params, const messages::StripeCalibration& calibration,
                   const messages::StripeLaser& laser)
    : p_RoE_R_(laser.p_RoE_R), normal_R_(laser.normal_R), power_w_rad_(FanPower(params)) {
  if (params.laser.fan == BeamFan::kFull) {
    axes_R_.push_back(laser.axis_R);
    half_fan_cosine_ = math::Cos(laser.half_fan_rad);
    return;
  }
  // Thin beams: one around each measured point of flat ground.
  for (const int row_px : calibration.scanline_px) {
    const auto point_R = StripePoint(calibration, laser, row_px);
    if (point_R) axes_R_.emplace_back((*point_R - p_RoE_R_).normalized());
  }
  half_fan_cosine_ = math::Cos(0.5 * kScanlinesOfThinBeam * params.row_pitch_rad());
}

bool LaserFan::Lights(const Vector3& away_R) const {
  // The angle within the light plane counts; how far the direction lies off the plane is
  // OutOfPlane's.
  const Vector3 in_plane = away_R - normal_R_.dot(away_R) * normal_R_;
  const double least = half_fan_cosine_ * in_plane.norm();
  return std::any_of(axes_R_.begin(), axes_R_.end(),
                     [&](const Vector3& axis) { return axis.dot(in_plane) >= least; });
}

LitFan::LitFan(const LaserFan& fan, const rendering::ImageScene& scene, double reach_rad)
    : fan_(&fan),
      scene_(&scene),
      p_WoE_W_(scene.X_WR() * fan.p_RoE_R()),
      normal_W_(scene.X_WR().linear() * fan.normal_R()),
      offset_m_(normal_W_.dot(p_WoE_W_)),
      // sin(a) <= a, so light within the reach lies within reach * range of the plane.
      width_m_(reach_rad * scene.sight_m()) {
  scene.RocksInSheet(p_WoE_W_, normal_W_, width_m_, rocks_);
}

double LitFan::OutOfPlane(const Vector3& p_W) const {
  const Vector3 away_W = p_W - p_WoE_W_;
  // sin a = n . r / |r|.
  return math::Asin(std::clamp(normal_W_.dot(away_W) / away_W.norm(), -1.0, 1.0));
}

double LitFan::Irradiance(const rendering::SurfacePoint& point) const {
  const Vector3 away_W = point.p_W - p_WoE_W_;
  const double range2_m2 = away_W.squaredNorm();
  // Incidence against the outward normal; E / f(a) = P / (F r^2) cos i.
  const double cosine = -point.normal_W.dot(away_W) / std::sqrt(range2_m2);
  if (cosine <= 0.0) return 0.0;
  if (!fan_->Lights(scene_->X_WR().linear().transpose() * away_W)) return 0.0;
  if (!scene_->Reaches(p_WoE_W_, point.p_W, rocks_)) return 0.0;
  return fan_->power_w_rad() * cosine / range2_m2;
}

void LitStripes::Add(const rendering::SurfacePoint& left, const rendering::SurfacePoint& right,
                     int pixel, double gain, rendering::RenderedRow& row) const {
  if (!left.TakesLampLight() && !right.TakesLampLight()) return;
  const double reach_rad = beam_.reach_rad();
  for (std::size_t laser = 0; laser < fans_.size(); ++laser) {
    const LitFan& fan = fans_[laser];
    if (fan.PassesBy(left.p_W, right.p_W)) continue;
    const double a_rad = fan.OutOfPlane(left.p_W);
    const double b_rad = fan.OutOfPlane(right.p_W);
    // The beam passes the pixel on one side.
    if (std::min(a_rad, b_rad) > reach_rad || std::max(a_rad, b_rad) < -reach_rad) continue;

    const bool one_surface = rendering::IsOneSurface(left, right);
    // (C(b) - C(a)) / (b - a): on one surface the angle out of the plane goes evenly from edge to
    // edge.
    const double mean = one_surface ? beam_.Mean(a_rad, b_rad) : 0.0;
    const auto radiance = [&](const rendering::SurfacePoint& point, double angle_rad) {
      const double density = one_surface ? mean : beam_.Density(angle_rad);
      if (density == 0.0 || !point.TakesLampLight()) return 0.0;
      // Lambert: L = albedo / pi E, E = P / (F r^2) f cos i.
      return point.albedo * std::numbers::inv_pi * density * fan.Irradiance(point);
    };
    const double sum = radiance(left, a_rad) + radiance(right, b_rad);
    if (sum > 0.0) row.lamps.push_back({pixel, static_cast<int>(laser), 0.5 * gain * sum});
  }
}

StripeLight::StripeLight(const LightStripeParams& params,
                         const messages::StripeCalibration& calibration)
    : beam_(params.laser.profile, params.laser.beam_width_rad) {
  for (const messages::StripeLaser& laser : calibration.lasers) {
    // All lasers are rendered at once; the read-out takes those of one group.
    fans_.emplace_back(params, calibration, laser);
  }
}

LitStripes StripeLight::Meet(const rendering::ImageScene& scene) const {
  std::vector<LitFan> fans;
  for (const LaserFan& fan : fans_) fans.emplace_back(fan, scene, beam_.reach_rad());
  return {beam_, std::move(fans)};
}

}  // namespace rockyard::sensing
