#include "vision/odometry/slanted_match.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "vision/odometry/template_sums.h"
#include "vision/odometry/window_samples.h"

namespace rockyard::vision {
namespace {

// Sum of lane^power times the lanes, lanes counted from the middle of the window.
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

// What one step of least squares needs, for the parameters shift, slope by column and by row.
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
    // The left window lies where right(column + o) is left(o - e): r = -g e.
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
