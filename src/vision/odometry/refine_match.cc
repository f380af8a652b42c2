#include "vision/odometry/refine_match.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "vision/odometry/window_samples.h"

namespace rockyard::vision {
namespace {

// Returns the sum of the lanes before `side`. Must stay: lanes are added two by two in one order,
// for the same bits on every instruction set.
float SumOf(WindowSamples::Lanes lanes, std::size_t side) {
  std::fill(lanes.begin() + static_cast<std::ptrdiff_t>(side), lanes.end(), 0.0F);
  for (std::size_t half = lanes.size() / 2; half > 0; half /= 2) {
    for (std::size_t i = 0; i < half; ++i) lanes[i] += lanes[i + half];
  }
  return lanes[0];
}

// Returns the sum of lanes[i] o^power, o the column of lane i counted from the window's middle.
double Moment(const WindowSamples::Lanes& lanes, std::size_t side, int power) {
  const auto reach = static_cast<int>(side / 2);
  double sum = 0.0;
  for (std::size_t i = 0; i < side; ++i) {
    const auto offset = static_cast<double>(static_cast<int>(i) - reach);
    const double weight = power == 0 ? 1.0 : power == 1 ? offset : offset * offset;
    sum += weight * lanes[i];
  }
  return sum;
}

// The equations of one step of FindSlanted, for shift, slope by column and slope by row.
struct Equations {
  Eigen::Matrix3d normal;  // sum j j' of j = g (1, o_x, o_y), less their mean
  Eigen::Vector3d right;   // sum j r
  double squares = 0.0;    // sum r^2
};

Equations EquationsAt(const GrayImage& left, const GrayImage& right, const Pixel& left_pixel,
                      const SlantedPlace& place, std::size_t side) {
  WindowSamples window =
      SampleWindow(left, left_pixel, LeftViewOf(place.slope), side, WindowGradients::kAlongRow);
  const auto pixels = static_cast<double>(side * side);
  const int reach = static_cast<int>(side) / 2;
  const auto moment = [side](const WindowSamples::Lanes& lanes, int power) {
    return Moment(lanes, side, power);
  };
  const double mean = moment(window.sum, 0) / pixels;
  for (float& value : window.values) value -= static_cast<float>(mean);
  const auto column = static_cast<int>(place.column);
  const auto row = static_cast<int>(left_pixel.y());
  TemplateSums seen;
  SumTemplate({window.values.data(), window.across.data(), window.down.data(),
               static_cast<float>(mean), side},
              {&right.At(column - reach, row - reach), static_cast<std::size_t>(right.width()),
               static_cast<float>(place.column - column), static_cast<float>(left_pixel.y() - row)},
              seen);
  const Eigen::Vector3d j(moment(window.across_sum, 0), moment(window.across_sum, 1),
                          moment(window.down_sum, 0));
  const double mean_difference = moment(seen.d, 0) / pixels;
  Equations equations;
  const double xx = moment(window.across_across, 1);
  const double xy = moment(window.across_down, 1);
  const double y = moment(window.across_down, 0);
  equations.normal << moment(window.across_across, 0), xx, y,  //
      xx, moment(window.across_across, 2), xy,                 //
      y, xy, moment(window.down_down, 0);
  equations.normal -= j * j.transpose() / pixels;
  equations.right << moment(seen.across_d, 0), moment(seen.across_d, 1), moment(seen.down_d, 0);
  equations.right -= mean_difference * j;
  equations.squares =
      std::max(0.0, moment(seen.squares, 0) - mean_difference * mean_difference * pixels);
  return equations;
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

// Below, r = d - mean of d: sum g r = sum g d - mean sum g, sum r^2 = sum d^2 - n mean^2.
std::optional<RefinedPlace> WindowTemplate::Find(const GrayImage& second, const Pixel& start,
                                                 const RefineLimits& limits) const {
  constexpr int kIterations = 10;
  constexpr double kStep_px = 0.01;
  constexpr double kFlat = 1e-6;  // the normal matrix' determinant over its squared trace
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

ViewChange LeftViewOf(const DisparitySlope& slope) {
  ViewChange view;
  view.by_offset << 1.0 / (1.0 - slope.x()), slope.y() / (1.0 - slope.x()), 0.0, 1.0;
  return view;
}

std::optional<SlantedPlace> FindSlanted(const GrayImage& left, const GrayImage& right,
                                        const Pixel& left_pixel, double column,
                                        const RefineLimits& limits, std::size_t side) {
  constexpr int kSteps = 4;
  constexpr double kShift_px = 0.02;
  constexpr double kChange = 0.01;
  // Below one grey level the rounding of pixels counts.
  constexpr double kLeastVariance = 1.0;
  const auto pixels = static_cast<double>(side * side);
  SlantedPlace place{.column = column};
  for (int step = 0; step < kSteps; ++step) {
    if (!HasTemplate(right, Pixel(place.column, left_pixel.y()), side)) return std::nullopt;
    const Equations equations = EquationsAt(left, right, left_pixel, place, side);
    const double variance = std::max(kLeastVariance, equations.squares / (pixels - 5.0));
    const double prior = variance / (limits.slope_sd * limits.slope_sd);
    Eigen::Matrix3d normal = equations.normal;
    normal.diagonal().tail<2>().array() += prior;
    if (!(normal(0, 0) > 0.0)) return std::nullopt;
    const Eigen::Matrix3d covariance = normal.inverse();
    Eigen::Vector3d pull = equations.right;
    pull.tail<2>() -= prior * place.slope;
    // Where the column is off by e, right(column + o) = left(o - e), so that r = -g e.
    const Eigen::Vector3d change = covariance * pull;
    place.column -= change.x();
    place.slope =
        (place.slope + change.tail<2>()).cwiseMax(-limits.max_slope).cwiseMin(limits.max_slope);
    place.residual = std::sqrt(equations.squares / pixels);
    place.variance_px2 = variance * covariance(0, 0) + limits.noise_px * limits.noise_px;
    if (!(std::abs(place.column - column) <= limits.max_shift_px)) return std::nullopt;
    if (std::abs(change.x()) < kShift_px && change.tail<2>().cwiseAbs().maxCoeff() < kChange) {
      break;
    }
  }
  if (!(place.residual <= limits.max_residual)) return std::nullopt;
  return place;
}

}  // namespace rockyard::vision
