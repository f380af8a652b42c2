#include "textured_image.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "vision/each_pixel.h"

namespace rockyard::vision {
namespace {

constexpr int kWaves = 48;
constexpr core::TrialKey kKey{2012, 0};

}  // namespace

WaveTexture::WaveTexture(std::uint32_t number, double shortest_px, double longest_px)
    : number_(number) {
  core::RandomStream stream(kKey, core::Purpose::kTest, number);
  for (int i = 0; i < kWaves; ++i) {
    const double length =
        std::exp(core::SampleUniform(stream, std::log(shortest_px), std::log(longest_px)));
    const double direction = core::SampleUniform(stream, 0.0, std::numbers::pi);
    const double wave = 2.0 * std::numbers::pi / length;
    waves_.push_back({wave * std::cos(direction), wave * std::sin(direction),
                      core::SampleUniform(stream, 0.0, 2.0 * std::numbers::pi)});
  }
}

double WaveTexture::At(double x, double y) const {
  double sum = 0.0;
  for (const Wave& wave : waves_) sum += std::sin(wave.x * x + wave.y * y + wave.phase);
  return sum * std::sqrt(2.0 / kWaves);
}

GrayImage WaveTexture::Render(int width, int height, double left, double top, double contrast,
                              double noise, std::uint32_t noise_number) const {
  core::RandomStream stream({2013, number_}, core::Purpose::kTest, noise_number);
  GrayImage image(width, height);
  ForEachPixel(width, height, [&](int x, int y) {
    const double grey = 110.0 + contrast * At(left + x, top + y) +
                        (noise > 0.0 ? noise * core::SampleNormal(stream, 0.0, 1.0) : 0.0);
    image.At(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L));
  });
  return image;
}

GrayImage RandomImage(int width, int height, int levels, std::uint32_t number) {
  core::RandomStream stream({2014, 0}, core::Purpose::kTest, number);
  GrayImage image(width, height);
  for (std::uint8_t& value : image.values()) {
    value = static_cast<std::uint8_t>(stream.NextU32() % static_cast<std::uint32_t>(levels));
  }
  return image;
}

}  // namespace rockyard::vision
