#include "synthetic_pair.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/hash.h"
#include "core/random.h"
#include "vision/each_pixel.h"

namespace rockyard::vision {
namespace {

constexpr int kWaves = 96;
constexpr core::TrialKey kKey{2002, 0};
constexpr int kLeftNoise = 1;  // substreams of a scene, beside that of the texture
constexpr int kRightNoise = 2;
constexpr int kSubstreams = 3;

core::RandomStream StreamOf(const Scene& scene, int substream) {
  return {kKey, core::Purpose::kTest, scene.number * kSubstreams + substream};
}

// Sum of waves of equal amplitude, standard deviation 1. Wave lengths are uniform in their
// logarithm over the band, directions uniform.
class Texture {
 public:
  explicit Texture(const Scene& scene) {
    core::RandomStream stream = StreamOf(scene, 0);
    for (int i = 0; i < kWaves; ++i) {
      const double length = std::exp(core::SampleUniform(stream, std::log(scene.shortest_wave_px),
                                                         std::log(scene.longest_wave_px)));
      const double direction = core::SampleUniform(stream, 0.0, std::numbers::pi);
      const double phase = core::SampleUniform(stream, 0.0, 2.0 * std::numbers::pi);
      const double wave = 2.0 * std::numbers::pi / length;
      waves_.push_back({wave * std::cos(direction), wave * std::sin(direction), phase});
    }
  }

  double At(double x, double y) const {
    double sum = 0.0;
    for (const Wave& wave : waves_) sum += std::sin(wave.x * x + wave.y * y + wave.phase);
    return sum * std::sqrt(2.0 / kWaves);
  }

 private:
  struct Wave {
    double x, y, phase;
  };
  std::vector<Wave> waves_;
};

// Returns the place of the left image that right pixel x shows: the nearest surface on its ray,
// x_left - d(x_left) = x. The disparity changes by less than a pixel a pixel but for steps, so that
// marching from the largest disparity finds it; bisection makes it exact.
double LeftPlace(const Scene& scene, double x, double y, double most) {
  const auto miss = [&](double left) { return left - scene.disparity(left, y) - x; };
  double high = x + most;
  while (high > x - most && miss(high - 1.0) > 0.0) high -= 1.0;
  double low = high - 1.0;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    (miss(middle) > 0.0 ? high : low) = middle;
  }
  return high;
}

double MostDisparity(const Scene& scene) {
  double most = 0.0;
  ForEachPixel(scene.width, scene.height,
               [&](int x, int y) { most = std::max(most, std::abs(scene.disparity(x, y))); });
  return most + 2.0;
}

std::uint8_t ToByte(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

}  // namespace

SyntheticPair MakePair(const Scene& scene) {
  const Texture texture(scene);
  core::RandomStream left_noise = StreamOf(scene, kLeftNoise);
  core::RandomStream right_noise = StreamOf(scene, kRightNoise);
  const double most = MostDisparity(scene);
  SyntheticPair pair{GrayImage(scene.width, scene.height), GrayImage(scene.width, scene.height),
                     Image<double>(scene.width, scene.height),
                     Image<std::uint8_t>(scene.width, scene.height)};
  ForEachPixel(scene.width, scene.height, [&](int x, int y) {
    const double here = scene.mean + scene.contrast * texture.At(x, y);
    pair.left.At(x, y) = ToByte(core::SampleNormal(left_noise, here, scene.noise));
    const double d = scene.disparity(x, y);
    pair.truth.At(x, y) = d;
    const double seen = LeftPlace(scene, x - d, y, most);
    pair.hidden.At(x, y) = std::abs(seen - x) > 0.5 || x - d < 0.0 || x - d > scene.width - 1;
    const double row = scene.left_row(x, y);
    const double there =
        scene.mean + scene.contrast * texture.At(LeftPlace(scene, x, row, most), row);
    pair.right.At(x, y) = ToByte(core::SampleNormal(
        right_noise, scene.right_gain * there + scene.right_offset, scene.noise));
  });
  return pair;
}

std::function<double(double, double)> SteppedGround(int width, int height, double range_px) {
  return [=](double x, double y) {
    const bool rock = x > 0.4 * width && x < 0.6 * width && y > 0.5 * height;
    return range_px * (0.25 + 0.4 * y / height + (rock ? 0.1 : 0.0));
  };
}

std::string HashOf(const DisparityImage& image) {
  core::Hasher hash;
  for (const std::int16_t value : image.values()) hash.Integer(value);
  return core::Hex(hash.value());
}

}  // namespace rockyard::vision
