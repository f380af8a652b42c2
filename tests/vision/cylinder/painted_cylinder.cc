#include "vision/cylinder/painted_cylinder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/random.h"
#include "math/angles.h"
#include "vision/each_pixel.h"

namespace rockyard::vision {
namespace {

using math::Vector3;

constexpr int kColumns = 512;
constexpr int kRows = 480;
constexpr double kFieldOfView_rad = math::DegToRad(29.33);
constexpr double kBaseline_m = 0.12;
constexpr int kPatch_px = 3;

CameraModel CameraAt(double left_m, double focal_px, double pitch_rad) {
  // Rows run to -y, columns to -z where the camera is level.
  Cahv lens{.C = Vector3(0.0, left_m, 0.0),
            .A = Vector3(std::cos(pitch_rad), 0.0, -std::sin(pitch_rad))};
  const Vector3 up(std::sin(pitch_rad), 0.0, std::cos(pitch_rad));
  lens.H = -focal_px * Vector3::UnitY() + 0.5 * (kColumns - 1) * lens.A;
  lens.V = -focal_px * up + 0.5 * (kRows - 1) * lens.A;
  return {lens, {kColumns, kRows}};
}

// Where a ray meets a cylinder first: the colour there, and how far along the ray.
struct Hit {
  double along_m = 0.0;
  PaintColour colour = PaintColour::Zero();
};

class CylinderPainter {
 public:
  CylinderPainter(const PaintedScene& scene, const PaintedCylinder& cylinder)
      : scene_(scene), cylinder_(cylinder) {
    // Leaning to the right of the image is leaning to -y.
    axis_ = Vector3(0.0, -std::sin(cylinder.lean_rad), std::cos(cylinder.lean_rad));
    const Vector3 to_middle = Vector3(0.0, -0.5 * kBaseline_m, 0.0) - cylinder.p_LT_L;
    ahead_ = (to_middle - to_middle.dot(axis_) * axis_).normalized();
    side_ = axis_.cross(ahead_);
  }

  std::optional<Hit> Meet(const Ray& ray) const {
    std::optional<Hit> best = MeetWall(ray);
    for (const double end : {0.5, -0.5}) {
      const auto hit = MeetEnd(ray, end * cylinder_.size.height_m);
      if (hit && (!best || hit->along_m < best->along_m)) best = hit;
    }
    return best;
  }

 private:
  // Coordinates ahead, to the side and up.
  Vector3 InAxes(const Vector3& v) const { return {v.dot(ahead_), v.dot(side_), v.dot(axis_)}; }

  std::optional<Hit> MeetWall(const Ray& ray) const {
    const Vector3 o = InAxes(ray.origin - cylinder_.p_LT_L);
    const Vector3 d = InAxes(ray.direction);
    const double radius_m = 0.5 * cylinder_.size.diameter_m;
    const double a = d.head<2>().squaredNorm();
    const double b = o.head<2>().dot(d.head<2>());
    const double c = o.head<2>().squaredNorm() - radius_m * radius_m;
    const double root2 = b * b - a * c;
    if (root2 < 0.0) return std::nullopt;
    const double along_m = (-b - std::sqrt(root2)) / a;
    const Vector3 p = o + along_m * d;
    if (along_m <= 0.0 || std::abs(p.z()) > 0.5 * cylinder_.size.height_m) return std::nullopt;
    return Hit{along_m, WallColour(std::atan2(p.y(), p.x()))};
  }

  std::optional<Hit> MeetEnd(const Ray& ray, double height_m) const {
    const Vector3 o = InAxes(ray.origin - cylinder_.p_LT_L);
    const Vector3 d = InAxes(ray.direction);
    if (std::abs(d.z()) < 1e-12) return std::nullopt;
    const double along_m = (height_m - o.z()) / d.z();
    const Vector3 p = o + along_m * d;
    if (along_m <= 0.0 || p.head<2>().norm() > 0.5 * cylinder_.size.diameter_m) return std::nullopt;
    return Hit{along_m, scene_.top};
  }

  // `azimuth_rad` from the direction to the middle between the cameras.
  PaintColour WallColour(double azimuth_rad) const {
    const double in_T = azimuth_rad + cylinder_.orientation_rad;
    const double turns = in_T / (2.0 * std::numbers::pi);
    const double quadrant = std::floor(4.0 * (turns - std::floor(turns)));
    const double sun = std::max(std::cos(azimuth_rad - scene_.sun_azimuth_rad), 0.0);
    const double brightness = scene_.diffuse + (1.0 - scene_.diffuse) * sun;
    return brightness *
           scene_.quadrants.at(std::min(static_cast<std::size_t>(quadrant), std::size_t{3}));
  }

  const PaintedScene& scene_;
  const PaintedCylinder& cylinder_;
  Vector3 axis_;
  Vector3 ahead_;
  Vector3 side_;
};

std::uint8_t Level(double grey) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(grey, 0.0, 255.0)));
}

// One eye's image.
class EyePainter {
 public:
  EyePainter(const PaintedScene& scene, const CameraModel& camera, std::uint32_t eye)
      : scene_(scene), camera_(camera), eye_(eye) {
    for (const PaintedCylinder& cylinder : scene.cylinders) painters_.emplace_back(scene, cylinder);
  }

  ColourImage Image() const {
    ColourImage image(camera_.size.columns, camera_.size.rows);
    core::RandomStream noise({scene_.seed, eye_}, core::Purpose::kTest, 1);
    ForEachPixel(image.width(), image.height(), [&](int x, int y) {
      const PaintColour seen = Seen(x, y).cwiseProduct(scene_.light);
      const PaintColour mixed = (1.0 - 3.0 * scene_.crosstalk) * seen +
                                PaintColour::Constant(scene_.crosstalk * seen.sum());
      std::array<std::uint8_t, 3> levels{};
      for (int i = 0; i < 3; ++i) {
        double grey = scene_.exposure * mixed[i];
        if (scene_.noise_grey > 0.0) grey += core::SampleNormal(noise, 0.0, scene_.noise_grey);
        levels.at(static_cast<std::size_t>(i)) = Level(grey);
      }
      image.At(x, y) = {levels[0], levels[1], levels[2]};
    });
    return image;
  }

 private:
  // The background is of one colour but for its texture, which is at infinity.
  PaintColour Background(int x, int y) const {
    if (scene_.ground_texture == 0.0) return scene_.ground;
    const auto patch = static_cast<std::uint32_t>((y / kPatch_px) * kColumns + x / kPatch_px);
    core::RandomStream stream({scene_.seed, 0}, core::Purpose::kTest, 1000 + patch);
    return scene_.ground * std::max(core::SampleNormal(stream, 1.0, scene_.ground_texture), 0.1);
  }

  std::optional<PaintColour> CylinderAt(double x, double y) const {
    const Ray ray = *BackProject(camera_, Pixel(x, y));
    std::optional<Hit> nearest;
    for (const CylinderPainter& painter : painters_) {
      const auto hit = painter.Meet(ray);
      if (hit && (!nearest || hit->along_m < nearest->along_m)) nearest = hit;
    }
    if (!nearest) return std::nullopt;
    return nearest->colour;
  }

  bool IsNearCylinder(int x, int y) const {
    for (const PaintedCylinder& cylinder : scene_.cylinders) {
      const auto middle = Project(camera_, cylinder.p_LT_L);
      if (!middle) continue;
      const double reach_px = 2.0 + 1.4 * camera_.size.columns * cylinder.size.diameter_m /
                                        (cylinder.p_LT_L.x() - cylinder.size.diameter_m);
      if ((Pixel(x, y) - *middle).cwiseAbs().maxCoeff() < reach_px) return true;
    }
    return false;
  }

  PaintColour Seen(int x, int y) const {
    const PaintColour background = Background(x, y);
    if (!IsNearCylinder(x, y)) return background;
    PaintColour sum = PaintColour::Zero();
    ForEachPixel(scene_.rays, scene_.rays, [&](int j, int i) {
      const double offset_x = (i + 0.5) / scene_.rays - 0.5;
      const double offset_y = (j + 0.5) / scene_.rays - 0.5;
      sum += CylinderAt(x + offset_x, y + offset_y).value_or(background);
    });
    return sum / (scene_.rays * scene_.rays);
  }

  const PaintedScene& scene_;
  const CameraModel& camera_;
  std::uint32_t eye_;
  std::vector<CylinderPainter> painters_;
};

}  // namespace

PaintedCameras LevelCameras() { return CamerasLookingDown(0.0); }

PaintedCameras CamerasLookingDown(double pitch_rad) {
  const double focal_px = 0.5 * kColumns / std::tan(0.5 * kFieldOfView_rad);
  return {CameraAt(0.0, focal_px, pitch_rad), CameraAt(-kBaseline_m, focal_px, pitch_rad),
          focal_px};
}

ColourImage Blurred(const ColourImage& image) {
  // 1 4 6 4 1 over 16, along rows and columns: a variance of one.
  constexpr std::array<double, 5> kWeights = {1.0 / 16, 4.0 / 16, 6.0 / 16, 4.0 / 16, 1.0 / 16};
  ColourImage blurred(image.width(), image.height());
  ForEachPixel(image.width(), image.height(), [&](int x, int y) {
    PaintColour sum = PaintColour::Zero();
    for (int j = -2; j <= 2; ++j) {
      for (int i = -2; i <= 2; ++i) {
        const Rgb& pixel = image.At(std::clamp(x + i, 0, image.width() - 1),
                                    std::clamp(y + j, 0, image.height() - 1));
        sum += kWeights.at(static_cast<std::size_t>(i + 2)) *
               kWeights.at(static_cast<std::size_t>(j + 2)) *
               PaintColour(pixel.red, pixel.green, pixel.blue);
      }
    }
    blurred.At(x, y) = {Level(sum[0]), Level(sum[1]), Level(sum[2])};
  });
  return blurred;
}

PaintedPair Paint(const PaintedScene& scene) {
  PaintedPair pair;
  pair.cameras = CamerasLookingDown(scene.pitch_rad);
  pair.left = EyePainter(scene, pair.cameras.left, 0).Image();
  pair.right = EyePainter(scene, pair.cameras.right, 1).Image();
  return pair;
}

PaintedScene SceneAt(double distance_m, double orientation_rad) {
  PaintedScene scene;
  scene.cylinders.front().p_LT_L = Vector3(distance_m, -0.5 * kBaseline_m, 0.0);
  scene.cylinders.front().orientation_rad = orientation_rad;
  return scene;
}

PaintedScene SceneFromAbove(double distance_m, double orientation_rad, double pitch_rad) {
  PaintedScene scene = SceneAt(distance_m, orientation_rad);
  scene.cylinders.front().p_LT_L.x() = distance_m * std::cos(pitch_rad);
  scene.cylinders.front().p_LT_L.z() = -distance_m * std::sin(pitch_rad);
  scene.pitch_rad = pitch_rad;
  return scene;
}

}  // namespace rockyard::vision
