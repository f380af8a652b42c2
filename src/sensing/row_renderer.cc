#include "sensing/row_renderer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sensing/radiometry.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;

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
  const LitScene& lit;
  Vector3 eye_W;
  std::vector<SurfacePoint> points;    // by edge
  std::vector<std::vector<int>> seen;  // rocks in view, by segment of the line
};

RowRenderer::RowRenderer(const LightStripeParams& params,
                         const messages::StripeCalibration& calibration)
    : beam_(params.laser.profile, params.laser.beam_width_rad),
      blur_(params.imager.blur_px),
      electrons_per_radiance_(ElectronsPerRadiance(params)) {
  for (const messages::StripeLaser& laser : calibration.lasers) {
    // All lasers are rendered at once; the read-out takes those of one group.
    fans_.emplace_back(params, calibration, laser);
  }
}

LitScene RowRenderer::Prepare(const ImageScene& scene) const {
  LitScene lit{scene, {}};
  for (const LaserFan& fan : fans_) lit.fans.emplace_back(fan, scene, beam_.reach_rad());
  return lit;
}

// One ray for each edge between pixels: neighbours share it. Rocks are sifted for the line, then
// for each of its segments.
void RowRenderer::CastRays(const ViewRow& view, Job& job) {
  const ImageScene& scene = job.lit.scene;
  const auto R_WR = scene.X_WR().linear();
  std::vector<int> in_row;
  scene.RocksNearPlane(job.eye_W, R_WR * view.plane_R, view.plane_sine, in_row);
  job.points.reserve(view.edge_R.size());
  job.seen.resize(view.segments.size());
  for (std::size_t s = 0; s < view.segments.size(); ++s) {
    const ViewRow::Segment& segment = view.segments[s];
    scene.RocksInCone(job.eye_W, R_WR * segment.axis_R, segment.half_sine, segment.half_cosine,
                      in_row, job.seen[s]);
    const bool is_last = s + 1 == view.segments.size();
    const int end = is_last ? segment.last_edge + 1 : segment.last_edge;
    for (int edge = segment.first_edge; edge < end; ++edge) {
      const auto e = static_cast<std::size_t>(edge);
      job.points.push_back(
          scene.Meet(job.eye_W, R_WR * view.edge_R[e], view.body_m[e], job.seen[s]));
    }
  }
}

// Sunlight at each edge; an edge that two segments share is lit twice, with the same result.
void RowRenderer::LightPoints(const ViewRow& view, Job& job) {
  const ImageScene& scene = job.lit.scene;
  // A ball around what a run of edges meets; what may come between it and the sun is searched once.
  const auto ball_of = [&job](int first_edge, int last_edge) {
    Eigen::AlignedBox3d box;
    for (int edge = first_edge; edge <= last_edge; ++edge) {
      const SurfacePoint& point = job.points[static_cast<std::size_t>(edge)];
      if (point.surface != SurfacePoint::kSky) box.extend(point.p_W);
    }
    if (box.isEmpty()) return Ball{};
    return Ball{box.center(), 0.5 * box.diagonal().norm()};
  };
  std::vector<int> of_row;
  std::vector<int> of_segment;
  scene.RocksBeforeSun(ball_of(0, view.columns()), of_row);
  for (const ViewRow::Segment& segment : view.segments) {
    const Ball ball = ball_of(segment.first_edge, segment.last_edge);
    scene.RocksBeforeSun(ball, of_row, of_segment);
    for (int edge = segment.first_edge; edge <= segment.last_edge; ++edge) {
      scene.Light(of_segment, job.points[static_cast<std::size_t>(edge)]);
    }
  }
}

// What each laser adds to a pixel between two edges.
void RowRenderer::AddLasers(const LitScene& lit, const SurfacePoint& left,
                            const SurfacePoint& right, int pixel, double gain,
                            RenderedRow& row) const {
  if (!left.TakesLaserLight() && !right.TakesLaserLight()) return;
  const double reach_rad = beam_.reach_rad();
  for (std::size_t laser = 0; laser < lit.fans.size(); ++laser) {
    const LitFan& fan = lit.fans[laser];
    if (fan.PassesBy(left.p_W, right.p_W)) continue;
    const double a_rad = fan.OutOfPlane(left.p_W);
    const double b_rad = fan.OutOfPlane(right.p_W);
    // The beam passes the pixel on one side.
    if (std::min(a_rad, b_rad) > reach_rad || std::max(a_rad, b_rad) < -reach_rad) continue;

    const bool one_surface = IsOneSurface(left, right);
    // (C(b) - C(a)) / (b - a): on one surface the angle out of the plane goes evenly from edge to
    // edge.
    const double mean = one_surface ? beam_.Mean(a_rad, b_rad) : 0.0;
    const auto radiance = [&](const SurfacePoint& point, double angle_rad) {
      const double density = one_surface ? mean : beam_.Density(angle_rad);
      if (density == 0.0 || !point.TakesLaserLight()) return 0.0;
      // Lambert: L = albedo / pi E, E = P / (F r^2) f cos i.
      return point.albedo * std::numbers::inv_pi * density * fan.Irradiance(point);
    };
    const double sum = radiance(left, a_rad) + radiance(right, b_rad);
    if (sum > 0.0) row.lasers.push_back({pixel, static_cast<int>(laser), 0.5 * gain * sum});
  }
}

// A pixel in which a surface ends: kParts smaller ones, each with rays, shadows and lasers of its
// own.
void RowRenderer::SplitPixel(const Job& job, const ViewRow& view, std::span<const int> seen,
                             int pixel, RenderedRow& row) const {
  const auto edge = static_cast<std::size_t>(pixel);
  const ImageScene& scene = job.lit.scene;
  const double body_m = std::min(view.body_m[edge], view.body_m[edge + 1]);
  std::vector<int> shading;
  const auto point_at = [&](int part) {
    if (part == 0) return job.points[edge];
    if (part == kParts) return job.points[edge + 1];
    const double share = static_cast<double>(part) / kParts;
    // Rays evenly between the two edges' unit vectors: a pixel is far too small for the chord to
    // matter.
    const Vector3 ray_R = (1.0 - share) * view.edge_R[edge] + share * view.edge_R[edge + 1];
    const Vector3 ray_W = scene.X_WR().linear() * ray_R.normalized();
    SurfacePoint point = scene.Meet(job.eye_W, ray_W, body_m, seen);
    scene.RocksBeforeSun({point.p_W, 0.0}, shading);
    scene.Light(shading, point);
    return point;
  };
  // Each part takes its share of the pixel's area.
  const double gain = view.gain[edge] * electrons_per_radiance_ / kParts;
  double radiance = 0.0;
  SurfacePoint left = point_at(0);
  for (int part = 1; part <= kParts; ++part) {
    const SurfacePoint right = point_at(part);
    radiance += 0.5 * (left.radiance_w_m2_sr + right.radiance_w_m2_sr);
    AddLasers(job.lit, left, right, pixel, gain, row);
    left = right;
  }
  row.sun_e_s[edge] = gain * radiance;
}

RenderedRow RowRenderer::Render(const LitScene& lit, const Vector3& eye_R,
                                const ViewRow& view) const {
  Job job{lit, lit.scene.X_WR() * eye_R, {}, {}};
  CastRays(view, job);
  LightPoints(view, job);
  RenderedRow row;
  row.row = view.row;
  row.sun_e_s.resize(view.gain.size());
  for (std::size_t s = 0; s < view.segments.size(); ++s) {
    const ViewRow::Segment& segment = view.segments[s];
    for (int pixel = segment.first_edge; pixel < segment.last_edge; ++pixel) {
      const auto e = static_cast<std::size_t>(pixel);
      const SurfacePoint& left = job.points[e];
      const SurfacePoint& right = job.points[e + 1];
      if (!IsOneSurface(left, right)) {
        SplitPixel(job, view, job.seen[s], pixel, row);
        continue;
      }
      const double gain = view.gain[e] * electrons_per_radiance_;
      // Trapezoid rule between the two edges.
      row.sun_e_s[e] = 0.5 * gain * (left.radiance_w_m2_sr + right.radiance_w_m2_sr);
      AddLasers(lit, left, right, pixel, gain, row);
    }
  }
  blur_.Apply(row);
  return row;
}

}  // namespace rockyard::sensing
