#include "campaign/odometry/odometry_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "campaign/looks/look_pictures.h"
#include "campaign/looks/picture_lines.h"
#include "report/colour_ramp.h"
#include "report/xml_text.h"

namespace rockyard::campaign {
namespace {

using image_files::Picture;
using math::Vector3;
using report::SvgPoint;

constexpr double kDrawing_px = 720.0;
constexpr double kMargin_px = 60.0;
constexpr double kLeastExtent_m = 0.1;
constexpr int kMark_px = 3;
constexpr const char* kAxisNames[] = {"x", "y", "z"};

void DrawMark(const vision::Pixel& at, int factor, const image_files::Rgb& colour,
              Picture& picture) {
  const vision::Pixel middle = factor * at;
  DrawLine({middle, middle}, colour, kMark_px, picture);
}

std::vector<Vector3> PositionsOf(const vision::Trajectory& path) {
  std::vector<Vector3> positions;
  for (const math::Transform& pose : path) positions.emplace_back(pose.translation());
  return positions;
}

// True positions in the frame of the first pair.
std::vector<Vector3> TruePositions(const OdometryResult& result) {
  std::vector<Vector3> positions;
  if (result.truth.empty()) return positions;
  const math::Transform X_AT =
      result.steps[result.steps_with_truth.front()].X_AB * result.truth.front().inverse();
  for (const math::Transform& pose : result.truth) {
    positions.emplace_back((X_AT * pose).translation());
  }
  return positions;
}

// The two axes along which points extend most, and how they are drawn.
class PathPlane {
 public:
  explicit PathPlane(const std::vector<Vector3>& points) {
    low_ = points.front();
    high_ = points.front();
    for (const Vector3& point : points) {
      low_ = low_.cwiseMin(point);
      high_ = high_.cwiseMax(point);
    }
    const Vector3 extent = high_ - low_;
    std::sort(axes_, axes_ + 3,
              [&](int a, int b) { return extent[a] != extent[b] ? extent[a] > extent[b] : a < b; });
    px_a_m_ = (kDrawing_px - 2.0 * kMargin_px) / std::max(extent[axes_[0]], kLeastExtent_m);
    height_px_ = 2.0 * kMargin_px + px_a_m_ * extent[axes_[1]];
  }

  SvgPoint At(const Vector3& point) const {
    return {kMargin_px + px_a_m_ * (point[axes_[0]] - low_[axes_[0]]),
            kMargin_px + px_a_m_ * (high_[axes_[1]] - point[axes_[1]])};
  }
  std::string Caption() const {
    return fmt::format("{} to the right, {} up, of the cameras' outer frame at the first pair",
                       kAxisNames[axes_[0]], kAxisNames[axes_[1]]);
  }
  double height_px() const { return height_px_; }

  // A bar of a round length, at most a third of the drawing.
  std::string ScaleBar() const {
    const double most_m = kDrawing_px / 3.0 / px_a_m_;
    const double power_m = std::pow(10.0, std::floor(std::log10(most_m)));
    const double length_m =
        most_m >= 5.0 * power_m ? 5.0 * power_m : (most_m >= 2.0 * power_m ? 2.0 : 1.0) * power_m;
    const double y = height_px_ - 20.0;
    return report::SvgLine({kMargin_px, y}, {kMargin_px + px_a_m_ * length_m, y},
                           "stroke=\"#333\" stroke-width=\"3\"") +
           report::SvgText(kMargin_px, y - 6.0, fmt::format("{:g} m", length_m));
  }

 private:
  Vector3 low_;
  Vector3 high_;
  int axes_[3] = {0, 1, 2};
  double px_a_m_ = 1.0;
  double height_px_ = 0.0;
};

std::string Polyline(const PathPlane& plane, const std::vector<Vector3>& points,
                     const char* style) {
  std::vector<SvgPoint> drawn;
  drawn.reserve(points.size());
  for (const Vector3& point : points) drawn.push_back(plane.At(point));
  return report::SvgPolyline(drawn, style);
}

std::string GapMarks(const PathPlane& plane, const OdometryResult& result) {
  constexpr double kCross_px = 4.0;
  std::string svg;
  for (const PathStep& step : result.steps) {
    if (!step.result.reason) continue;
    const SvgPoint at = plane.At(step.X_AB.translation());
    for (const double way : {-kCross_px, kCross_px}) {
      svg += report::SvgLine({at.x - kCross_px, at.y - way}, {at.x + kCross_px, at.y + way},
                             "stroke=\"#b00020\" stroke-width=\"1.5\"");
    }
  }
  return svg;
}

}  // namespace

Picture FeaturePicture(const vision::GrayImage& left, const vision::OdometryStep& step) {
  const int factor = FactorToSee(left.width(), left.height());
  Picture picture(left.width(), left.height());
  std::transform(left.values().begin(), left.values().end(), picture.values().begin(),
                 [](std::uint8_t grey) {
                   return image_files::Rgb{Muted(grey), Muted(grey), Muted(grey)};
                 });
  picture = Enlarged(picture, factor);
  for (const vision::Feature& feature : step.features) {
    DrawMark(vision::Pixel(feature.column, feature.row), factor, report::RampColour(0.5), picture);
  }
  for (const vision::PointSeenTwice& point : step.consistent) {
    DrawLine({factor * point.first.left, factor * point.second.left}, report::RampColour(1.0), 1,
             picture);
    DrawMark(point.second.left, factor, report::RampColour(1.0), picture);
  }
  return picture;
}

std::string PathDrawing(const OdometryResult& result) {
  const std::vector<Vector3> path = PositionsOf(result.Path());
  const std::vector<Vector3> truth = TruePositions(result);
  std::vector<Vector3> all = path;
  all.insert(all.end(), truth.begin(), truth.end());
  const PathPlane plane(all.empty() ? std::vector<Vector3>{Vector3::Zero()} : all);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "viewBox=\"0 0 {0:.0f} {1:.0f}\">\n",
      kDrawing_px, plane.height_px());
  svg += report::SvgBox(0.0, 0.0, kDrawing_px, plane.height_px(), "fill=\"#fff\"");
  svg += report::SvgText(kMargin_px, 20.0, plane.Caption());
  if (!truth.empty()) {
    svg += Polyline(plane, truth, "fill=\"none\" stroke=\"#888\" stroke-width=\"3\"");
  }
  svg += Polyline(plane, path, "fill=\"none\" stroke=\"#0072b2\" stroke-width=\"1.5\"");
  svg += GapMarks(plane, result);
  svg += report::SvgText(kMargin_px, 38.0,
                         truth.empty() ? "blue: estimated; red crosses: pairs without a motion"
                                       : "blue: estimated; grey: true; red crosses: pairs without "
                                         "a motion",
                         11.0);
  return svg + plane.ScaleBar() + "</svg>\n";
}

}  // namespace rockyard::campaign
