#include "rendering/view_row.h"

#include <algorithm>
#include <cmath>

#include "rendering/radiometry.h"
#include "vision/lens.h"

namespace rockyard::rendering {
namespace {

// Short enough for a narrow cone, long enough to be worth a search for the rocks in it.
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

// The plane through the first and the last ray; any plane where they are one line.
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

}  // namespace rockyard::rendering
