#include "rendering/row_renderer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/functions.h"
#include "rendering/radiometry.h"
#include "vision/lens.h"

namespace rockyard::rendering {

namespace {

// Short enough for a narrow cone, long enough to be worth a search for the rocks in it. Cones only
// sift rocks: this decides time alone.
constexpr int kSegmentPixels = 32;

ViewRow::Segment MakeSegment(const ViewRow& view, int first_edge, int last_edge) {
  ViewRow::Segment segment{first_edge, last_edge};
  const auto ray = [&view](int edge) { return view.edge_R[static_cast<std::size_t>(edge)]; };
  // The cone about the middle ray that holds all: cos of its half angle is the least dot product.
  segment.axis_R = ray((first_edge + last_edge) / 2);
  for (int edge = first_edge; edge <= last_edge; ++edge) {
    segment.half_cosine = std::min(segment.half_cosine, segment.axis_R.dot(ray(edge)));
  }
  segment.half_sine = std::sqrt(1.0 - segment.half_cosine * segment.half_cosine);
  return segment;
}

// Sets the plane through the first and the last ray.
void SetPlane(ViewRow& view) {
  view.plane_R = view.edge_R.front().cross(view.edge_R.back()).normalized();
  view.plane_sine = 0.0;
  for (const math::Vector3& ray_R : view.edge_R) {
    // A lens that bends its rows leaves this plane; plane_sine is the sine of the largest angle off
    // it.
    view.plane_sine = std::max(view.plane_sine, std::abs(view.plane_R.dot(ray_R)));
  }
}

}  // namespace

ViewRow MakeViewRow(const messages::Camera& camera, const RoverBody& body, int row,
                    int first_column, int columns) {
  ViewRow view;
  view.row = row;
  view.first_column = first_column;
  const math::Vector3 eye_R = camera.X_RC.translation();
  for (int edge = 0; edge <= columns; ++edge) {
    // Columns count from pixel middles: edges lie half a column beside.
    const math::Vector3 ray_C =
        vision::PixelRay(camera, {first_column + edge - 0.5, static_cast<double>(row)});
    view.edge_R.emplace_back(camera.X_RC.linear() * ray_C);
    view.body_m.push_back(body.Distance(eye_R, view.edge_R.back()));
  }
  SetPlane(view);
  for (int pixel = 0; pixel < columns; ++pixel) {
    view.gain.push_back(RelativeIllumination(camera, first_column + pixel, row));
  }
  for (int edge = 0; edge < columns; edge += kSegmentPixels) {
    view.segments.push_back(MakeSegment(view, edge, std::min(edge + kSegmentPixels, columns)));
  }
  return view;
}

using math::Vector3;

ImageBlur::ImageBlur(double sigma_px) : weights_{1.0} {
  constexpr double kReach_sigmas = 4.0;
  double sum = 1.0;
  for (int k = 1; k < kReach_sigmas * sigma_px + 1.0; ++k) {
    // exp(-k^2 / 2 s^2), then normalized so that the line keeps its light.
    weights_.push_back(math::Exp(-0.5 * k * k / (sigma_px * sigma_px)));
    sum += 2.0 * weights_.back();
  }
  for (double& weight : weights_) weight /= sum;
}

void ImageBlur::Apply(RenderedRow& row) const {
  if (weights_.size() == 1) return;
  const int columns = static_cast<int>(row.sun_e_s.size());
  const int reach = static_cast<int>(weights_.size()) - 1;
  const auto weight = [this](int k) { return weights_[static_cast<std::size_t>(std::abs(k))]; };

  const std::vector<double> sharp = std::move(row.sun_e_s);
  row.sun_e_s.assign(sharp.size(), 0.0);
  for (int pixel = 0; pixel < columns; ++pixel) {
    for (int k = -reach; k <= reach; ++k) {
      // Sunlight beyond the ends of the line is that at its ends.
      const auto from = static_cast<std::size_t>(std::clamp(pixel + k, 0, columns - 1));
      row.sun_e_s[static_cast<std::size_t>(pixel)] += weight(k) * sharp[from];
    }
  }
  const std::vector<RenderedRow::LampPixel> lamps = std::move(row.lamps);
  row.lamps.clear();
  // Light of lamps is spread from where it is; what leaves the line is lost.
  for (const RenderedRow::LampPixel& light : lamps) {
    for (int k = -reach; k <= reach; ++k) {
      const int pixel = light.pixel + k;
      if (pixel < 0 || pixel >= columns) continue;
      row.lamps.push_back({pixel, light.lamp, weight(k) * light.rate_e_s});
    }
  }
}

struct RowRenderer::Job {
  const ImageScene& scene;
  const Lamps& lamps;
  Vector3 eye_W;
  std::vector<SurfacePoint> points;    // by edge
  std::vector<std::vector<int>> seen;  // rocks in view, by segment of the line
};

RowRenderer::RowRenderer(const ImagerParams& imager, double pixel_m2, double wavelength_m)
    : blur_(imager.blur_px),
      electrons_per_radiance_(ElectronsPerRadiance(imager, pixel_m2, wavelength_m)) {}

// Casts one ray for each edge between pixels, which two pixels share. Rocks are sifted for the
// line, then for each of its segments.
void RowRenderer::CastRays(const ViewRow& view, Job& job) {
  const ImageScene& scene = job.scene;
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

// Sets the sunlight at each edge. An edge that two segments share is lit twice, with the same
// result.
void RowRenderer::LightPoints(const ViewRow& view, Job& job) {
  const ImageScene& scene = job.scene;
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

// Renders a pixel that holds the edge of a surface: as kParts smaller pixels, each with rays,
// shadows and lamps of its own.
void RowRenderer::SplitPixel(const Job& job, const ViewRow& view, std::span<const int> seen,
                             int pixel, RenderedRow& row) const {
  const auto edge = static_cast<std::size_t>(pixel);
  const ImageScene& scene = job.scene;
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
    job.lamps.Add(left, right, pixel, gain, row);
    left = right;
  }
  row.sun_e_s[edge] = gain * radiance;
}

RenderedRow RowRenderer::Render(const ImageScene& scene, const Lamps& lamps, const Vector3& eye_R,
                                const ViewRow& view) const {
  Job job{scene, lamps, scene.X_WR() * eye_R, {}, {}};
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
      lamps.Add(left, right, pixel, gain, row);
    }
  }
  blur_.Apply(row);
  return row;
}

}  // namespace rockyard::rendering
