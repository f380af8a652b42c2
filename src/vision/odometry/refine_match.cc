#include "vision/odometry/refine_match.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "vision/odometry/template_sums.h"

namespace rockyard::vision {
namespace {

// The window with a pixel more on every side, for gradients.
constexpr int kWideSide = 17;
constexpr int kWideReach = kWideSide / 2;
using Wide = std::array<float, kWideSide * kWideSide>;

// Whether at +- (reach, reach), mapped, everything interpolated is a pixel of the image.
bool LiesInside(const GrayImage& image, const Pixel& middle, const Eigen::Matrix2d& by_offset) {
  const Pixel reach = by_offset.cwiseAbs() * Pixel(kWideReach, kWideReach);
  const Pixel first = middle - reach;
  const Pixel last = middle + reach;
  return first.minCoeff() >= 0.0 && last.x() < image.width() - 1 && last.y() < image.height() - 1;
}

float Bilinear(float p00, float p01, float p10, float p11, float u, float v) {
  const float above = p00 + u * (p01 - p00);
  const float below = p10 + u * (p11 - p10);
  return above + v * (below - above);
}

void SampleWarped(const GrayImage& image, const Pixel& middle, const Eigen::Matrix2d& by_offset,
                  Wide& wide) {
  const bool inside = LiesInside(image, middle, by_offset);
  const auto clamped = [&](int x, int y) {
    return static_cast<float>(
        image.At(std::clamp(x, 0, image.width() - 1), std::clamp(y, 0, image.height() - 1)));
  };
  for (int row = 0; row < kWideSide; ++row) {
    for (int column = 0; column < kWideSide; ++column) {
      const int across = column - kWideReach;
      const int down = row - kWideReach;
      const double at_x = middle.x() + by_offset(0, 0) * across + by_offset(0, 1) * down;
      const double at_y = middle.y() + by_offset(1, 0) * across + by_offset(1, 1) * down;
      const double left = inside ? static_cast<int>(at_x) : std::floor(at_x);
      const double top = inside ? static_cast<int>(at_y) : std::floor(at_y);
      const auto x = static_cast<int>(left);
      const auto y = static_cast<int>(top);
      const auto u = static_cast<float>(at_x - left);
      const auto v = static_cast<float>(at_y - top);
      float& value =
          wide[static_cast<std::size_t>(row) * kWideSide + static_cast<std::size_t>(column)];
      if (inside) {
        const std::uint8_t* const above = &image.At(x, y);
        const std::uint8_t* const below = above + image.width();
        value = Bilinear(above[0], above[1], below[0], below[1], u, v);
      } else {
        value = Bilinear(clamped(x, y), clamped(x + 1, y), clamped(x, y + 1), clamped(x + 1, y + 1),
                         u, v);
      }
    }
  }
}

// The sum of the lanes, two by two.
template <std::size_t kCount>
float SumOf(std::array<float, kCount> lanes) {
  for (std::size_t half = kCount / 2; half > 0; half /= 2) {
    for (std::size_t i = 0; i < half; ++i) lanes[i] += lanes[i + half];
  }
  return lanes[0];
}

}  // namespace

WindowTemplate::WindowTemplate(const GrayImage& image, const Pixel& middle,
                               const Eigen::Matrix2d& by_offset) {
  Wide wide;
  SampleWarped(image, middle, by_offset, wide);
  std::array<float, kLanes> sum{};
  std::array<float, kLanes> across_sum{};
  std::array<float, kLanes> down_sum{};
  std::array<float, kLanes> n00{};
  std::array<float, kLanes> n01{};
  std::array<float, kLanes> n11{};
  for (std::size_t row = 0; row < kSide; ++row) {
    const float* const at = wide.data() + (row + 1) * kWideSide + 1;
    const std::size_t first = row * kLanes;
    for (std::size_t column = 0; column < kSide; ++column) {
      const float* const pixel = at + column;
      const float across = 0.5F * (pixel[1] - pixel[-1]);
      const float down = 0.5F * (pixel[kWideSide] - pixel[-kWideSide]);
      values_[first + column] = pixel[0];
      across_[first + column] = across;
      down_[first + column] = down;
      sum[column] += pixel[0];
      across_sum[column] += across;
      down_sum[column] += down;
      n00[column] += across * across;
      n01[column] += across * down;
      n11[column] += down * down;
    }
  }
  mean_ = SumOf(sum) / static_cast<float>(kPixels);
  across_sum_ = SumOf(across_sum);
  down_sum_ = SumOf(down_sum);
  normal_ << SumOf(n00), SumOf(n01), SumOf(n01), SumOf(n11);
  for (std::size_t row = 0; row < kSide; ++row) {
    for (std::size_t column = 0; column < kSide; ++column) {
      values_[row * kLanes + column] -= mean_;
    }
  }
}

WindowTemplate::Sums WindowTemplate::SumsAt(const GrayImage& second, const Pixel& middle) const {
  const auto x = static_cast<int>(middle.x());
  const auto y = static_cast<int>(middle.y());
  const auto u = static_cast<float>(middle.x() - x);
  const auto v = static_cast<float>(middle.y() - y);
  TemplateSums lanes;
  SumTemplate({values_.data(), across_.data(), down_.data(), mean_},
              {&second.At(x - kReach, y - kReach), static_cast<std::size_t>(second.width()), u, v},
              lanes);
  lanes.d[kSide] = 0.0F;
  lanes.squares[kSide] = 0.0F;
  return {SumOf(lanes.d), SumOf(lanes.across_d), SumOf(lanes.down_d), SumOf(lanes.squares)};
}

// With r = d - mean of d: sum g r = sum g d - mean sum g, sum r^2 = sum d^2 - n mean^2.
std::optional<RefinedPlace> WindowTemplate::Find(const GrayImage& second, const Pixel& start,
                                                 const RefineLimits& limits) const {
  constexpr int kIterations = 10;
  constexpr double kStep_px = 0.01;
  constexpr double kFlat = 1e-6;  // of the normal matrix' determinant, over its squared trace
  const bool flat = limits.along_row
                        ? normal_(0, 0) <= 0.0
                        : normal_.determinant() <= kFlat * normal_.trace() * normal_.trace();
  if (flat) return std::nullopt;
  const Eigen::Matrix2d inverse = limits.along_row ? normal_ : normal_.inverse().eval();
  Pixel shift = Pixel::Zero();
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Pixel middle = start + shift;
    if (!(middle.x() >= kReach && middle.x() < second.width() - kReach - 2 &&
          middle.y() >= kReach && middle.y() < second.height() - kReach - 1)) {
      return std::nullopt;
    }
    const Sums sums = SumsAt(second, middle);
    const float mean = sums.d / static_cast<float>(kPixels);
    const float across = sums.across_d - mean * across_sum_;
    const float down = sums.down_d - mean * down_sum_;
    const float squares = std::max(0.0F, sums.squares - mean * sums.d);
    Pixel change(across / normal_(0, 0), 0.0);
    if (!limits.along_row) change = inverse * Pixel(across, down);
    shift -= change;
    if (!(shift.cwiseAbs().maxCoeff() <= limits.max_shift_px)) return std::nullopt;
    if (change.norm() >= kStep_px) continue;
    if (squares > limits.max_residual * limits.max_residual * kPixels) return std::nullopt;
    const double variance = squares / (kPixels - 3.0);
    RefinedPlace place{start + shift, Eigen::Matrix2d::Zero()};
    if (limits.along_row) {
      place.covariance_px2(0, 0) = variance / normal_(0, 0) + limits.noise_px * limits.noise_px;
    } else {
      place.covariance_px2 =
          variance * inverse + limits.noise_px * limits.noise_px * Eigen::Matrix2d::Identity();
    }
    return place;
  }
  return std::nullopt;
}

}  // namespace rockyard::vision
