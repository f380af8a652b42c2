#include "vision/odometry/refine_match.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "vision/odometry/template_sums.h"

namespace rockyard::vision {
namespace {

// The sum of the lanes, two by two; those from `side` on do not count.
float SumOf(WindowSamples::Lanes lanes, std::size_t side) {
  std::fill(lanes.begin() + static_cast<std::ptrdiff_t>(side), lanes.end(), 0.0F);
  for (std::size_t half = lanes.size() / 2; half > 0; half /= 2) {
    for (std::size_t i = 0; i < half; ++i) lanes[i] += lanes[i + half];
  }
  return lanes[0];
}

}  // namespace

WindowTemplate::WindowTemplate(const GrayImage& image, const Pixel& middle, const ViewChange& view,
                               std::size_t side)
    : side_(side),
      reach_(static_cast<int>(side) / 2),
      pixels_(static_cast<float>(side * side)),
      samples_(SampleWindow(image, middle, view, side)),
      mean_(SumOf(samples_.sum, side) / pixels_),
      across_sum_(SumOf(samples_.across_sum, side)),
      down_sum_(SumOf(samples_.down_sum, side)) {
  normal_ << SumOf(samples_.across_across, side), SumOf(samples_.across_down, side),
      SumOf(samples_.across_down, side), SumOf(samples_.down_down, side);
  for (float& value : samples_.values) value -= mean_;
}

WindowTemplate::Sums WindowTemplate::SumsAt(const GrayImage& second, const Pixel& middle) const {
  const auto x = static_cast<int>(middle.x());
  const auto y = static_cast<int>(middle.y());
  const auto u = static_cast<float>(middle.x() - x);
  const auto v = static_cast<float>(middle.y() - y);
  TemplateSums lanes;
  SumTemplate({samples_.values.data(), samples_.across.data(), samples_.down.data(), mean_, side_},
              {&second.At(x - reach_, y - reach_), static_cast<std::size_t>(second.width()), u, v},
              lanes);
  return {SumOf(lanes.d, side_), SumOf(lanes.across_d, side_), SumOf(lanes.down_d, side_),
          SumOf(lanes.squares, side_)};
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
    if (!HasTemplate(second, middle, side_)) return std::nullopt;
    const Sums sums = SumsAt(second, middle);
    const float mean = sums.d / pixels_;
    const float across = sums.across_d - mean * across_sum_;
    const float down = sums.down_d - mean * down_sum_;
    const float squares = std::max(0.0F, sums.squares - mean * sums.d);
    Pixel change(across / normal_(0, 0), 0.0);
    if (!limits.along_row) change = inverse * Pixel(across, down);
    shift -= change;
    if (!(shift.cwiseAbs().maxCoeff() <= limits.max_shift_px)) return std::nullopt;
    if (change.norm() >= kStep_px) continue;
    if (squares > limits.max_residual * limits.max_residual * pixels_) return std::nullopt;
    const double variance = squares / (pixels_ - 3.0);
    RefinedPlace place{start + shift, Eigen::Matrix2d::Zero(), std::sqrt(squares / pixels_)};
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
