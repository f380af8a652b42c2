#include "vision/calibration/rendered_target.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "core/random.h"
#include "vision/each_pixel.h"

namespace rockyard::vision {
namespace {

using math::Transform;
using math::Vector3;

constexpr int kRays = 4;  // along each side of a pixel

// 1 on even squares, -1 on odd ones, with a ramp of `soft` squares to either side of each line.
double Stripe(double at, double soft) {
  const double line = std::round(at);
  const double sign = static_cast<std::int64_t>(std::floor(at)) % 2 == 0 ? 1.0 : -1.0;
  return sign * std::min(1.0, std::fabs(at - line) / soft);
}

// Weights of rays about the middle of a pixel: the pixel's box convolved with the blur.
std::vector<double> PixelWeights(double blur_px) {
  const int half = static_cast<int>(std::ceil((3.5 * blur_px + 0.5) * kRays));
  std::vector<double> weights;
  double sum = 0.0;
  for (int i = -half; i < half; ++i) {
    const double away_px = (i + 0.5) / kRays;
    const auto below = [&](double x) { return 0.5 * std::erfc(-x / (std::sqrt(2.0) * blur_px)); };
    weights.push_back(below(away_px + 0.5) - below(away_px - 0.5));
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

}  // namespace

TargetRenderer::TargetRenderer(const CameraModel& camera)
    : camera_(camera),
      directions_(camera.size.columns * kRays, camera.size.rows * kRays, Vector3::Zero()) {
  ForEachPixel(directions_.width(), directions_.height(), [&](int x, int y) {
    const Pixel at((x + 0.5) / kRays - 0.5, (y + 0.5) / kRays - 0.5);
    if (const auto ray = BackProject(camera, at)) directions_.At(x, y) = ray->direction;
  });
}

Image<float> TargetRenderer::Rays(const ChessboardParams& board, const Transform& X_AT,
                                  const ImageLook& look) const {
  const Transform X_TA = X_AT.inverse();
  const Vector3 centre = X_TA * CentreOf(camera_);
  const Eigen::Matrix3d R_TA = X_TA.linear();
  const double middle = 0.5 * (look.dark + look.bright);
  const double half = 0.5 * (look.bright - look.dark);
  const auto columns = static_cast<double>(board.columns);
  const auto rows = static_cast<double>(board.rows);
  // Half a ray's distance on the board, in squares.
  const double soft = 0.5 * X_AT.translation().norm() / (260.0 * kRays * board.spacing_m);
  Image<float> rays(directions_.width(), directions_.height());
  ForEachPixel(rays.width(), rays.height(), [&](int x, int y) {
    const Vector3 direction = R_TA * directions_.At(x, y);
    const double range = -centre.z() / direction.z();
    const double u = (centre.x() + range * direction.x()) / board.spacing_m;
    const double v = (centre.y() + range * direction.y()) / board.spacing_m;
    double value = middle;  // the wall
    if (range > 0.0 && u > -1.5 && u < columns + 0.5 && v > -1.5 && v < rows + 0.5) {
      const bool margin = u < -1.0 || u > columns || v < -1.0 || v > rows;
      value = margin ? look.bright : middle - half * Stripe(u, soft) * Stripe(v, soft);
    }
    rays.At(x, y) = static_cast<float>(value);
  });
  return rays;
}

GrayImage TargetRenderer::Render(const ChessboardParams& board, const Transform& X_AT,
                                 core::RandomStream& stream, const ImageLook& look) const {
  const Image<float> rays = Rays(board, X_AT, look);
  const std::vector<double> weights = PixelWeights(look.blur_px);
  const int half = static_cast<int>(weights.size() / 2);
  const auto weighted = [&](int pixel, int end, const auto& value) {
    double sum = 0.0;
    const int first = pixel * kRays + kRays / 2 - half;
    for (int i = 0; i < 2 * half; ++i) {
      sum += weights[static_cast<std::size_t>(i)] *
             static_cast<double>(value(std::clamp(first + i, 0, end - 1)));
    }
    return sum;
  };
  Image<float> along(camera_.size.columns, rays.height());
  for (int y = 0; y < rays.height(); ++y) {
    for (int x = 0; x < along.width(); ++x) {
      along.At(x, y) = static_cast<float>(
          weighted(x, rays.width(), [&](int column) { return rays.At(column, y); }));
    }
  }
  GrayImage image(camera_.size.columns, camera_.size.rows);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const double value = weighted(y, rays.height(), [&](int row) { return along.At(x, row); }) +
                           core::SampleNormal(stream, 0.0, look.noise);
      image.At(x, y) = static_cast<std::uint8_t>(std::clamp(std::round(value), 0.0, 255.0));
    }
  }
  return image;
}

ChessboardParams TestBoard() { return {6, 9, 0.03}; }

Cahvor TestCahvor() {
  const Cahv linear{{0, 0, 0}, {0, 0, 1}, {260.0, 0.0, 161.5}, {0.8, 258.0, 117.0}};
  return {linear, Vector3(0.006, -0.004, 1.0).normalized(), {0.0, -0.12, 0.03}};
}

Cahvor TestRightCahvor() {
  const Cahv linear{{0, 0, 0}, {0, 0, 1}, {263.0, 0.0, 157.0}, {-0.5, 261.5, 121.0}};
  const Cahvor camera{linear, Vector3(-0.005, 0.003, 1.0).normalized(), {0.0, -0.11, 0.02}};
  return Moved(math::MakePose({0.12, 0.002, -0.003}, 0.004, -0.02, 0.006), camera);
}

std::vector<Transform> TestPoses(std::size_t count) {
  // Place of the board's middle, m, and turns about z, y, x, rad.
  constexpr std::array<std::array<double, 6>, 12> kPoses{{
      {0.045, 0.00, 0.36, 0.0, 0.0, 0.0},
      {-0.04, 0.02, 0.38, 0.1, 0.6, 0.1},
      {0.09, -0.02, 0.40, -0.1, -0.6, 0.2},
      {0.04, 0.07, 0.42, 0.2, 0.1, 0.6},
      {0.03, -0.055, 0.40, -0.2, 0.2, -0.6},
      {0.12, 0.09, 0.48, 0.05, 0.5, 0.4},
      {-0.01, -0.06, 0.48, 0.3, -0.4, -0.4},
      {0.00, 0.07, 0.46, 1.5, 0.3, 0.3},
      {0.13, -0.08, 0.50, -0.3, 0.3, 0.5},
      {-0.03, 0.085, 0.50, 0.15, -0.5, 0.3},
      {0.06, 0.00, 0.42, 3.0, 0.4, -0.3},
      {0.03, 0.02, 0.60, 0.6, -0.3, 0.5},
  }};
  if (count > kPoses.size()) throw std::invalid_argument("no so many poses");
  const Vector3 p_TM(4.0 * 0.03, 2.5 * 0.03, 0.0);  // the middle of TestBoard
  std::vector<Transform> poses;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [x, y, z, about_z, about_y, about_x] = kPoses[i];
    Transform X_AT = math::MakePose({x, y, z}, about_z, about_y, about_x);
    X_AT.translation() -= X_AT.linear() * p_TM;
    poses.push_back(X_AT);
  }
  return poses;
}

std::vector<Pixel> MeasuredCorners(const Cahvor& camera, const ChessboardParams& board,
                                   const Transform& X_AT, double noise_px,
                                   core::RandomStream& stream) {
  std::vector<Pixel> corners;
  for (std::size_t i = 0; i < board.corners(); ++i) {
    const auto pixel = Project(camera, X_AT * CornerPosition(board, i));
    if (!pixel) throw std::invalid_argument("a corner is not imaged");
    const double column = core::SampleNormal(stream, pixel->x(), noise_px);
    corners.emplace_back(column, core::SampleNormal(stream, pixel->y(), noise_px));
  }
  return corners;
}

}  // namespace rockyard::vision
