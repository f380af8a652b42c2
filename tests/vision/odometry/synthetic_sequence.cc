#include "vision/odometry/synthetic_sequence.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/random.h"
#include "vision/cameras/rectification.h"

namespace rockyard::vision {
namespace {

struct Wave {
  double length_m;
  double across;  // radians per metre
  double along;
  double phase;
};

std::vector<Wave> WavesOf(const PlaneWorld& world) {
  core::RandomStream stream({254, 0}, core::Purpose::kTest, world.number);
  std::vector<Wave> waves;
  for (int i = 0; i < world.waves; ++i) {
    const double length_m = std::exp(core::SampleUniform(stream, std::log(0.025), std::log(0.6)));
    const double heading = core::SampleUniform(stream, 0.0, 2.0 * std::numbers::pi);
    const double phase = core::SampleUniform(stream, 0.0, 2.0 * std::numbers::pi);
    const double wave_number = 2.0 * std::numbers::pi / length_m;
    waves.push_back(
        {length_m, wave_number * std::cos(heading), wave_number * std::sin(heading), phase});
  }
  return waves;
}

// Where a ray from C, of depth 1 along the camera's axis, meets the world.
struct Hit {
  double depth_m = 0.0;
  double across_m = 0.0;  // of the texture
  double along_m = 0.0;
};

std::optional<Hit> Meet(const math::Vector3& C, const math::Vector3& ray, double boards_m) {
  constexpr double kHalfWidth_m = 0.15;
  constexpr double kHeight_m = 0.2;
  if (!(ray.z() < -1e-3)) return std::nullopt;
  const double ground_m = C.z() / -ray.z();
  if (boards_m > 0.0 && ray.x() > 0.0) {
    for (double x = std::ceil(C.x() / boards_m) * boards_m;; x += boards_m) {
      const double depth_m = (x - C.x()) / ray.x();
      if (depth_m >= ground_m) break;
      const math::Vector3 p = C + depth_m * ray;
      const double node = std::round(p.y() / boards_m);
      const bool stands = std::lround(node + x / boards_m) % 2 == 0;
      if (stands && p.z() < kHeight_m && std::abs(p.y() - node * boards_m) < kHalfWidth_m) {
        return Hit{depth_m, p.z() + 7.0 * x, p.y()};
      }
    }
  }
  const math::Vector3 p = C + ground_m * ray;
  return Hit{ground_m, p.x(), p.y()};
}

GrayImage See(const Cahv& camera_R, const math::Transform& X_WR, const RectifiedPair& pair,
              const PlaneWorld& world, const std::vector<Wave>& waves, core::RandomStream& noise) {
  const Cahv camera = Moved(X_WR, camera_R);
  Eigen::Matrix3d rows;
  rows << camera.H.transpose(), camera.V.transpose(), camera.A.transpose();
  const Eigen::Matrix3d ray_by_pixel = rows.inverse();
  const double scale = world.contrast * std::sqrt(2.0 / std::max(world.waves, 1));
  GrayImage image(pair.size.columns, pair.size.rows);
  for (int y = 0; y < pair.size.rows; ++y) {
    for (int x = 0; x < pair.size.columns; ++x) {
      const math::Vector3 ray = ray_by_pixel * math::Vector3(x, y, 1.0);
      double grey = 110.0;
      if (const auto hit = Meet(camera.C, ray, world.boards_m)) {
        // Along the line of sight a pixel covers more of the ground.
        const double footprint_m =
            hit->depth_m / pair.focal_px * std::max(1.0, ray.norm() / -ray.z());
        for (const Wave& wave : waves) {
          if (wave.length_m < 2.5 * footprint_m) continue;
          grey += scale *
                  std::cos(wave.across * hit->across_m + wave.along * hit->along_m + wave.phase);
        }
      }
      grey += core::SampleNormal(noise, 0.0, world.noise);
      image.At(x, y) = static_cast<std::uint8_t>(std::lround(std::clamp(grey, 0.0, 255.0)));
    }
  }
  return image;
}

}  // namespace

RectifiedPair PlanePair(const ImageSize& size) {
  // Camera: z ahead, x to the right, y down.
  math::Transform X_RC = math::MakePose({0.0, 0.1, 1.2}, 0.0, math::DegToRad(35.0), 0.0);
  Eigen::Matrix3d R_ahead;
  R_ahead << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  X_RC.linear() = X_RC.linear() * R_ahead;
  const double focal_px = 0.5 * size.columns / std::tan(math::DegToRad(22.5));
  const Cahv left = Moved(X_RC, Cahv{{0, 0, 0},
                                     {0, 0, 1},
                                     {focal_px, 0, 0.5 * (size.columns - 1)},
                                     {0, focal_px, 0.5 * (size.rows - 1)}});
  Cahv right = left;
  right.C = X_RC * math::Vector3(0.2, 0.0, 0.0);
  return {left, right, size, focal_px, 0.2};
}

AlignedImages SeePlane(const RectifiedPair& pair, const math::Transform& X_WR,
                       const PlaneWorld& world, std::uint32_t moment) {
  const std::vector<Wave> waves = WavesOf(world);
  core::RandomStream left({255, world.number}, core::Purpose::kTest, 2 * moment);
  core::RandomStream right({255, world.number}, core::Purpose::kTest, 2 * moment + 1);
  return {See(pair.left, X_WR, pair, world, waves, left),
          See(pair.right, X_WR, pair, world, waves, right)};
}

// The plane is where the ray meets it: depths go as one over the disparity.
double PlaneDisparity_px(const RectifiedPair& pair, const Pixel& left_pixel) {
  const auto unit = Triangulate(pair.left, pair.right, left_pixel, 1.0);
  return (pair.left.C.z() - unit->p_A.z()) / pair.left.C.z();
}

}  // namespace rockyard::vision
