#include "sensing/row_renderer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sensing/stripe_layout_params.h"
#include "vision/lens.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;

// Half of the three scanlines of the thin beam.
constexpr double kThinHalfRows = 1.5;

// Where an image line meets the stripe of a laser on the datum plane, in R.
Vector3 StripePoint(const messages::StripeCalibration& calibration,
                    const messages::StripeLaser& laser, int row_px) {
  const messages::StripeCamera& camera =
      calibration.cameras[static_cast<std::size_t>(laser.camera)];
  const Vector3 along = laser.normal_R.cross(Vector3::UnitZ()).normalized();
  const Vector3 forward = along.dot(laser.axis_R) < 0.0 ? Vector3(-along) : along;
  const Vector3 foot(laser.p_RoE_R.x(), laser.p_RoE_R.y(), calibration.datum_z_m);
  const math::Transform X_CR = camera.X_RC.inverse();
  double near_m = 0.0;
  double far_m = ImageScene::kSight_m;
  // Farther points of the stripe are imaged higher up.
  constexpr int kHalvings = 50;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle_m = 0.5 * (near_m + far_m);
    const auto pixel = vision::Project(camera, X_CR * (foot + middle_m * forward));
    const bool is_below = !pixel || pixel->row_px > row_px;
    (is_below ? near_m : far_m) = middle_m;
  }
  return foot + 0.5 * (near_m + far_m) * forward;
}

// Whether a surface goes on from one edge of a pixel to the other: the same one, and the chord
// between them nearly in its tangent plane.
bool IsOneSurface(const SurfacePoint& a, const SurfacePoint& b) {
  constexpr double kFlat = 0.3;  // sine of the angle between chord and tangent plane
  if (a.surface != b.surface) return false;
  if (a.surface == SurfacePoint::kSky) return true;
  const Vector3 chord = b.p_W - a.p_W;
  const double out = std::max(std::abs(a.normal_W.dot(chord)), std::abs(b.normal_W.dot(chord)));
  return out * out <= kFlat * kFlat * chord.squaredNorm();
}

}  // namespace

struct RowRenderer::Job {
  const ImageScene& scene;
  Vector3 eye_W;
  std::array<Vector3, messages::kMaxStripes> emitter_W;
  std::array<Vector3, messages::kMaxStripes> normal_W;
  RockLists rocks;
};

RowRenderer::RowRenderer(const LightStripeParams& params,
                         const messages::StripeCalibration& calibration)
    : beam_(params.laser.profile, params.laser.beam_width_rad),
      fan_power_w_rad_(FanPower(params)),
      electrons_per_radiance_(ElectronsPerRadiance(params)) {
  for (std::size_t i = 0; i < calibration.lasers.size(); ++i) {
    emitters_.push_back(MakeEmitter(params, calibration, i));
  }
}

RowRenderer::Emitter RowRenderer::MakeEmitter(const LightStripeParams& params,
                                              const messages::StripeCalibration& calibration,
                                              std::size_t laser_index) {
  const messages::StripeLaser& laser = calibration.lasers[laser_index];
  Emitter emitter{laser.p_RoE_R, laser.normal_R, {}, 1.0};
  if (params.laser.fan == BeamFan::kFull) {
    emitter.axes_R.push_back(laser.axis_R);
    emitter.half_fan_cosine = std::cos(laser.half_fan_rad);
    return emitter;
  }
  for (const int row_px : calibration.scanline_px) {
    const Vector3 point_R = StripePoint(calibration, laser, row_px);
    emitter.axes_R.push_back((point_R - laser.p_RoE_R).normalized());
  }
  emitter.half_fan_cosine = std::cos(kThinHalfRows * params.row_pitch_rad());
  return emitter;
}

bool RowRenderer::InFan(const Emitter& emitter, const Vector3& away_R) {
  const Vector3 in_plane = away_R - emitter.normal_R.dot(away_R) * emitter.normal_R;
  const double least = emitter.half_fan_cosine * in_plane.norm();
  return std::any_of(emitter.axes_R.begin(), emitter.axes_R.end(),
                     [&](const Vector3& axis) { return axis.dot(in_plane) >= least; });
}

double RowRenderer::OutOfPlane(const Job& job, std::size_t laser, const Vector3& p_W) const {
  const Vector3 away_W = p_W - job.emitter_W[laser];
  return std::asin(std::clamp(job.normal_W[laser].dot(away_W) / away_W.norm(), -1.0, 1.0));
}

// P / (F r^2) cos(i), W/(m2 rad), of a point; 0 where no light of the laser arrives.
double RowRenderer::PeakIrradiance(const Job& job, std::size_t laser,
                                   const SurfacePoint& point) const {
  const Vector3 away_W = point.p_W - job.emitter_W[laser];
  const double range2_m2 = away_W.squaredNorm();
  const double cosine = -point.normal_W.dot(away_W) / std::sqrt(range2_m2);
  if (cosine <= 0.0) return 0.0;
  const Vector3 away_R = job.scene.X_WR().linear().transpose() * away_W;
  if (!InFan(emitters_[laser], away_R)) return 0.0;
  if (!job.scene.Reaches(job.emitter_W[laser], point.p_W)) return 0.0;
  return fan_power_w_rad_ * cosine / range2_m2;
}

void RowRenderer::AddLasers(const Job& job, const SurfacePoint& left, const SurfacePoint& right,
                            int pixel, double gain, RenderedRow& row) const {
  if (!left.TakesLaserLight() && !right.TakesLaserLight()) return;
  const bool one_surface = IsOneSurface(left, right);
  const double reach_rad = beam_.reach_rad();
  for (std::size_t laser = 0; laser < emitters_.size(); ++laser) {
    const auto side = [&](const SurfacePoint& point) {
      return job.normal_W[laser].dot(point.p_W - job.emitter_W[laser]);
    };
    // Farther from the plane than the beam is wide anywhere near: the common case.
    const double farthest_m = reach_rad * ImageScene::kSight_m;
    const double a_m = side(left);
    const double b_m = side(right);
    if (std::min(a_m, b_m) > farthest_m || std::max(a_m, b_m) < -farthest_m) continue;
    const double a_rad = OutOfPlane(job, laser, left.p_W);
    const double b_rad = OutOfPlane(job, laser, right.p_W);
    if (std::min(a_rad, b_rad) > reach_rad || std::max(a_rad, b_rad) < -reach_rad) continue;

    const auto lit = [&](const SurfacePoint& point, double density) {
      if (density == 0.0 || !point.TakesLaserLight()) return 0.0;
      return point.albedo * density * PeakIrradiance(job, laser, point);
    };
    const double mean = one_surface ? beam_.Mean(a_rad, b_rad) : 0.0;
    const double sum = lit(left, one_surface ? mean : beam_.Density(a_rad)) +
                       lit(right, one_surface ? mean : beam_.Density(b_rad));
    if (sum == 0.0) continue;
    row.lasers.push_back({pixel, static_cast<int>(laser), 0.5 * gain * sum * std::numbers::inv_pi});
  }
}

void RowRenderer::SplitPixel(const Job& job, const ViewRow& view, int pixel,
                             RenderedRow& row) const {
  const auto edge = static_cast<std::size_t>(pixel);
  const auto point_at = [&](int part) {
    const double share = static_cast<double>(part) / kParts;
    const Vector3 ray_R =
        ((1.0 - share) * view.edge_R[edge] + share * view.edge_R[edge + 1]).normalized();
    const double body_m = std::min(view.body_m[edge], view.body_m[edge + 1]);
    SurfacePoint point =
        job.scene.Meet(job.eye_W, job.scene.X_WR().linear() * ray_R, body_m, job.rocks.seen);
    job.scene.Light(job.rocks.shading, point);
    return point;
  };
  const double gain = view.gain[edge] * electrons_per_radiance_ / kParts;
  double radiance = 0.0;
  SurfacePoint left = point_at(0);
  for (int part = 1; part <= kParts; ++part) {
    const SurfacePoint right = point_at(part);
    radiance += 0.5 * (left.radiance_w_m2_sr + right.radiance_w_m2_sr);
    AddLasers(job, left, right, pixel, gain, row);
    left = right;
  }
  row.sun_e_s[edge] = gain * radiance;
}

RenderedRow RowRenderer::Render(const ImageScene& scene, const Vector3& eye_R,
                                const ViewRow& view) const {
  Job job{scene, scene.X_WR() * eye_R, {}, {}, {}};
  for (std::size_t i = 0; i < emitters_.size(); ++i) {
    job.emitter_W[i] = scene.X_WR() * emitters_[i].p_RoE_R;
    job.normal_W[i] = scene.X_WR().linear() * emitters_[i].normal_R;
  }
  RenderedRow row;
  row.row = view.row;
  row.sun_e_s.resize(view.gain.size());
  std::vector<SurfacePoint> points;
  for (const ViewRow::Segment& segment : view.segments) {
    scene.RocksInCone(job.eye_W, scene.X_WR().linear() * segment.axis_R, segment.half_sine,
                      segment.half_cosine, job.rocks.seen);
    points.clear();
    Eigen::AlignedBox3d bounds;
    for (int edge = segment.first_edge; edge <= segment.last_edge; ++edge) {
      const auto e = static_cast<std::size_t>(edge);
      const Vector3 ray_W = scene.X_WR().linear() * view.edge_R[e];
      points.push_back(scene.Meet(job.eye_W, ray_W, view.body_m[e], job.rocks.seen));
      if (points.back().surface != SurfacePoint::kSky) bounds.extend(points.back().p_W);
    }
    if (!bounds.isEmpty()) {
      scene.RocksBeforeSun(bounds.center(), 0.5 * bounds.diagonal().norm(), job.rocks.shading);
    }
    for (SurfacePoint& point : points) scene.Light(job.rocks.shading, point);
    for (int pixel = segment.first_edge; pixel < segment.last_edge; ++pixel) {
      const auto e = static_cast<std::size_t>(pixel);
      const SurfacePoint& left = points[static_cast<std::size_t>(pixel - segment.first_edge)];
      const SurfacePoint& right = points[static_cast<std::size_t>(pixel - segment.first_edge) + 1];
      if (!IsOneSurface(left, right)) {
        SplitPixel(job, view, pixel, row);
        continue;
      }
      const double gain = view.gain[e] * electrons_per_radiance_;
      row.sun_e_s[e] = 0.5 * gain * (left.radiance_w_m2_sr + right.radiance_w_m2_sr);
      AddLasers(job, left, right, pixel, gain, row);
    }
  }
  return row;
}

}  // namespace rockyard::sensing
