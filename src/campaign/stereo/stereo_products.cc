#include "campaign/stereo/stereo_products.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "report/colour_ramp.h"
#include "vision/cameras/rectification.h"

namespace rockyard::campaign {
namespace {

using Eigen::Vector3d;
using image_files::ColouredPoint;
using image_files::Picture;
using image_files::Rgb;
using vision::DisparityImage;
using vision::Image;

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
// Of heights that a colour is given to; the rest, at either end, takes that of the end.
constexpr double kLeftOut = 0.01;

Rgb Gray(std::uint8_t value) { return {value, value, value}; }

// Up or down the axis of the outer frame to which `direction` is nearest.
Vector3d NearestAxis(const Vector3d& direction) {
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  Vector3d nearest = Vector3d::Zero();
  nearest[axis] = std::copysign(1.0, direction[axis]);
  return nearest;
}

std::vector<Vector3d> PositionsOf(const std::vector<ColouredPoint>& points) {
  std::vector<Vector3d> positions;
  positions.reserve(points.size());
  for (const ColouredPoint& point : points) positions.push_back(point.position);
  return positions;
}

}  // namespace

Image<float> DisparityValues(const DisparityImage& disparities) {
  Image<float> values(disparities.width(), disparities.height(), kUnknown);
  for (int y = 0; y < values.height(); ++y) {
    for (int x = 0; x < values.width(); ++x) {
      const std::int16_t disparity = disparities.At(x, y);
      if (vision::IsValid(disparity)) {
        values.At(x, y) = static_cast<float>(vision::DisparityPx(disparity));
      }
    }
  }
  return values;
}

Picture DisparityPicture(const DisparityImage& disparities, const vision::CorrelatorParams& range) {
  const auto least_px = static_cast<double>(range.min_disparity_px);
  const auto span_px = static_cast<double>(std::max<std::int64_t>(1, range.disparities - 1));
  Picture picture(disparities.width(), disparities.height());
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const std::int16_t disparity = disparities.At(x, y);
      if (!vision::IsValid(disparity)) continue;
      picture.At(x, y) = report::RampColour((vision::DisparityPx(disparity) - least_px) / span_px);
    }
  }
  return picture;
}

Picture PairPicture(const vision::GrayImage& left, const Picture& disparities) {
  Picture picture(left.width() + disparities.width(), left.height());
  for (int y = 0; y < left.height(); ++y) {
    for (int x = 0; x < left.width(); ++x) {
      picture.At(x, y) = Gray(left.At(x, y));
      picture.At(left.width() + x, y) = disparities.At(x, y);
    }
  }
  return picture;
}

std::vector<ColouredPoint> PointsOf(const DisparityImage& disparities,
                                    const vision::GrayImage& left,
                                    const vision::RectifiedPair& cameras) {
  std::vector<ColouredPoint> points;
  for (int y = 0; y < disparities.height(); ++y) {
    for (int x = 0; x < disparities.width(); ++x) {
      const std::int16_t disparity = disparities.At(x, y);
      if (!vision::IsValid(disparity)) continue;
      const auto point = vision::Triangulate(cameras.left, cameras.right, vision::Pixel(x, y),
                                             vision::DisparityPx(disparity));
      if (point) points.push_back({point->p_A, Gray(left.At(x, y))});
    }
  }
  return points;
}

vision::ElevationGrid GridOverPoints(const std::vector<ColouredPoint>& points,
                                     const vision::RectifiedPair& cameras, double cell_m) {
  const Vector3d& axis_A = cameras.left.A;
  const Vector3d up = NearestAxis(-(cameras.left.V - cameras.left.V.dot(axis_A) * axis_A));
  const Vector3d away = NearestAxis(axis_A - axis_A.dot(up) * up);
  return vision::GridOver(PositionsOf(points), away, up, cell_m);
}

Image<float> HeightsOf(const std::vector<ColouredPoint>& points,
                       const vision::ElevationGrid& grid) {
  return vision::ElevationMap(PositionsOf(points), grid);
}

std::optional<HeightSpan> HeightSpanOf(const Image<float>& heights_m) {
  std::vector<float> known;
  for (const float height_m : heights_m.values()) {
    if (std::isfinite(height_m)) known.push_back(height_m);
  }
  if (known.empty()) return std::nullopt;
  std::sort(known.begin(), known.end());
  const auto cut = static_cast<std::size_t>(kLeftOut * static_cast<double>(known.size()));
  return HeightSpan{known[cut], known[known.size() - 1 - cut]};
}

Rgb HeightColour(double height_m, const HeightSpan& span) {
  return report::RampColour((height_m - span.low_m) / std::max(span.high_m - span.low_m, 1e-6));
}

Picture ElevationPicture(const Image<float>& heights_m) {
  Picture picture(heights_m.width(), heights_m.height());
  const std::optional<HeightSpan> span = HeightSpanOf(heights_m);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const float height_m = heights_m.At(x, y);
      if (std::isfinite(height_m)) picture.At(x, y) = HeightColour(height_m, *span);
    }
  }
  return picture;
}

}  // namespace rockyard::campaign
