#include "experiments/stereo_sensing/pixel_errors.h"

#include <cmath>
#include <limits>
#include <vector>

#include "core/check.h"

namespace rockyard::experiments {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

enum PixelKind : std::size_t { kPlain, kFront, kBehind, kShadow };

class RowErrors {
 public:
  RowErrors(const PixelLimits& limits, const sensing::StereoView& view, StereoSums& sums)
      : limits_(limits),
        view_(view),
        scale_px_m_(view.focal_px * view.baseline_m),
        sums_(sums),
        plain_px_(static_cast<std::size_t>(view.columns), kNone) {}

  void Add(const sensing::StereoTruth& truth, const sensing::DepthImage& matched_px, int row) {
    for (int column = 0; column < view_.columns; ++column) {
      plain_px_[static_cast<std::size_t>(column)] =
          PlainError(truth, matched_px(row, column), row, column);
    }
    for (std::size_t lag = 1; lag <= kLags; ++lag) AddPairs(lag);
  }

 private:
  // Counts a pixel; gives back its error where it is plain and good.
  double PlainError(const sensing::StereoTruth& truth, double matched_px, int row, int column) {
    const double true_px = truth.left_px(row, column);
    if (true_px < limits_.min_disparity_px || true_px > limits_.max_disparity_px) return kNone;
    const double depth_m = scale_px_m_ / true_px;
    const double ray = view_.Ray(column, row).norm();
    const double range_m = ray * depth_m;
    if (range_m < limits_.nearest_m || range_m >= limits_.farthest_m) return kNone;
    if (truth.both_px(row, column) <= 0.0) {
      sums_.hidden_pixels += 1.0;
      if (matched_px > 0.0) sums_.hidden_matched += 1.0;
      return kNone;
    }
    if (truth.margin(row, column)) {
      sums_.margin.Add(true_px, matched_px);
      return kNone;
    }
    sums_.all.Add(true_px, matched_px);
    const int jump = truth.jumps(row, column);
    const bool behind = truth.behind(row, column);
    if (jump <= static_cast<int>(kEdgeDistances)) {
      auto& sides = behind ? sums_.behinds : sums_.fronts;
      sides[static_cast<std::size_t>(jump - 1)].Add(true_px, matched_px);
    }
    const PixelKind edge = behind ? kBehind : kFront;
    const PixelKind away = truth.shaded(row, column) ? kShadow : kPlain;
    const PixelKind kind = jump <= limits_.edge_reach_px ? edge : away;
    sums_.kinds[kind].Add(true_px, matched_px);
    const double error_px = matched_px - true_px;
    if (matched_px <= 0.0 || std::abs(error_px) >= kWrong_px) return kNone;
    AddRange(range_m, depth_m, ray * scale_px_m_ / matched_px - range_m);
    return kind == kPlain ? error_px : kNone;
  }

  // Z = f B / d along the optical axis, r = |e| Z along the ray: |dr/dd| = |e| Z^2 / (f B) = r Z /
  // (f B), r^2 / (f B) on the axis, where |e| = 1.
  void AddRange(double range_m, double depth_m, double error_m) {
    const double step_m = range_m * depth_m / scale_px_m_;
    const double axis_step_m = range_m * range_m / scale_px_m_;
    sums_.range_m += range_m;
    sums_.range_bias_m += error_m;
    sums_.range_error2_m2 += error_m * error_m;
    sums_.range_step2_m2 += step_m * step_m;
    sums_.axis_step2_m2 += axis_step_m * axis_step_m;
  }

  void AddPairs(std::size_t lag) {
    for (std::size_t column = lag; column < plain_px_.size(); ++column) {
      const double product = plain_px_[column] * plain_px_[column - lag];
      if (std::isnan(product)) continue;
      sums_.pairs[lag - 1] += 1.0;
      sums_.products_px2[lag - 1] += product;
    }
  }

  const PixelLimits& limits_;
  const sensing::StereoView& view_;
  double scale_px_m_;
  StereoSums& sums_;
  std::vector<double> plain_px_;
};

}  // namespace

void PixelSums::Add(double true_px, double matched_px) {
  pixels += 1.0;
  if (matched_px <= 0.0) return;
  const double error_px = matched_px - true_px;
  if (std::abs(error_px) >= kWrong_px) {
    wrong += 1.0;
    return;
  }
  good += 1.0;
  bias_px += error_px;
  error2_px2 += error_px * error_px;
}

void AddPixels(const sensing::StereoTruth& truth, const sensing::DepthImage& matched_px,
               const sensing::StereoView& view, const PixelLimits& limits, StereoSums& sums) {
  EXPECT(matched_px.rows() == truth.left_px.rows() && matched_px.cols() == truth.left_px.cols());
  EXPECT(matched_px.rows() == view.rows && matched_px.cols() == view.columns);
  RowErrors errors(limits, view, sums);
  for (int row = 0; row < view.rows; ++row) errors.Add(truth, matched_px, row);
}

}  // namespace rockyard::experiments
