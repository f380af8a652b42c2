#include "vision/odometry/refine_match.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace rockyard::vision {
namespace {

float Interpolated(const GrayImage& image, const Pixel& at) {
  const auto clamped = [&](int x, int y) {
    return static_cast<float>(
        image.At(std::clamp(x, 0, image.width() - 1), std::clamp(y, 0, image.height() - 1)));
  };
  const double left = std::floor(at.x());
  const double top = std::floor(at.y());
  const auto x = static_cast<int>(left);
  const auto y = static_cast<int>(top);
  const auto u = static_cast<float>(at.x() - left);
  const auto v = static_cast<float>(at.y() - top);
  const float above = clamped(x, y) + u * (clamped(x + 1, y) - clamped(x, y));
  const float below = clamped(x, y + 1) + u * (clamped(x + 1, y + 1) - clamped(x, y + 1));
  return above + v * (below - above);
}

// The window of `side` pixels about a place, which lies inside with one pixel more to the right and
// below.
template <int kSamples>
void SampleInside(const GrayImage& image, double middle_x, double middle_y,
                  std::array<float, kSamples * kSamples>& values) {
  constexpr int kHalf = kSamples / 2;
  const auto x = static_cast<int>(std::floor(middle_x));
  const auto y = static_cast<int>(std::floor(middle_y));
  const auto u = static_cast<float>(middle_x - x);
  const auto v = static_cast<float>(middle_y - y);
  const float w00 = (1.0F - u) * (1.0F - v);
  const float w01 = u * (1.0F - v);
  const float w10 = (1.0F - u) * v;
  const float w11 = u * v;
  for (int row = 0; row < kSamples; ++row) {
    const std::uint8_t* const above = &image.At(x - kHalf, y - kHalf + row);
    const std::uint8_t* const below = &image.At(x - kHalf, y - kHalf + row + 1);
    float* const to = values.data() + row * kSamples;
    for (int column = 0; column < kSamples; ++column) {
      to[column] = w00 * above[column] + w01 * above[column + 1] + w10 * below[column] +
                   w11 * below[column + 1];
    }
  }
}

}  // namespace

WindowTemplate::WindowTemplate(const GrayImage& image, const Pixel& middle,
                               const Eigen::Matrix2d& by_offset) {
  constexpr int kWide = kSide + 2;
  std::array<float, kWide * kWide> wide;
  for (int row = 0; row < kWide; ++row) {
    for (int column = 0; column < kWide; ++column) {
      const Pixel offset(column - kReach - 1, row - kReach - 1);
      wide[static_cast<std::size_t>(row * kWide + column)] =
          Interpolated(image, middle + by_offset * offset);
    }
  }
  float sum = 0.0F;
  float n00 = 0.0F;
  float n01 = 0.0F;
  float n11 = 0.0F;
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const auto at = [&](int down, int right) {
        return wide[static_cast<std::size_t>((row + 1 + down) * kWide + column + 1 + right)];
      };
      const int i = row * kSide + column;
      values_[i] = at(0, 0);
      across_[i] = 0.5F * (at(0, 1) - at(0, -1));
      down_[i] = 0.5F * (at(1, 0) - at(-1, 0));
      sum += values_[i];
      n00 += across_[i] * across_[i];
      n01 += across_[i] * down_[i];
      n11 += down_[i] * down_[i];
    }
  }
  for (float& value : values_) value -= sum / static_cast<float>(kPixels);
  normal_ << n00, n01, n01, n11;
}

std::optional<RefinedPlace> WindowTemplate::Find(const GrayImage& second, const Pixel& start,
                                                 const RefineLimits& limits) const {
  constexpr int kIterations = 10;
  constexpr double kStep_px = 0.01;
  constexpr double kFlat = 1e-6;  // of the normal matrix' determinant, over its squared trace
  const bool flat = limits.along_row
                        ? normal_(0, 0) <= 0.0
                        : normal_.determinant() <= kFlat * normal_.trace() * normal_.trace();
  if (flat) return std::nullopt;
  Pixel shift = Pixel::Zero();
  std::array<float, kPixels> seen;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Pixel middle = start + shift;
    if (!(middle.x() >= kReach && middle.x() < second.width() - kReach - 1 &&
          middle.y() >= kReach && middle.y() < second.height() - kReach - 1)) {
      return std::nullopt;
    }
    SampleInside<kSide>(second, middle.x(), middle.y(), seen);
    float sum = 0.0F;
    for (const float value : seen) sum += value;
    const float mean = sum / static_cast<float>(kPixels);
    float across = 0.0F;
    float down = 0.0F;
    float squares = 0.0F;
    for (int i = 0; i < kPixels; ++i) {
      const float residual = seen[static_cast<std::size_t>(i)] - mean - values_[i];
      across += across_[i] * residual;
      down += down_[i] * residual;
      squares += residual * residual;
    }
    Pixel change(across / normal_(0, 0), 0.0);
    if (!limits.along_row) change = normal_.inverse() * Pixel(across, down);
    shift -= change;
    if (!(shift.cwiseAbs().maxCoeff() <= limits.max_shift_px)) return std::nullopt;
    if (change.norm() >= kStep_px) continue;
    if (squares > limits.max_residual * limits.max_residual * kPixels) return std::nullopt;
    const double variance = squares / (kPixels - 3.0);
    RefinedPlace place{start + shift, Eigen::Matrix2d::Zero()};
    if (limits.along_row) {
      place.covariance_px2(0, 0) = variance / normal_(0, 0) + limits.noise_px * limits.noise_px;
    } else {
      place.covariance_px2 = variance * normal_.inverse() +
                             limits.noise_px * limits.noise_px * Eigen::Matrix2d::Identity();
    }
    return place;
  }
  return std::nullopt;
}

}  // namespace rockyard::vision
