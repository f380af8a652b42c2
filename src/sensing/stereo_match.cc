#include "sensing/stereo_match.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "core/distributions.h"
#include "rendering/pixel_noise.h"

namespace rockyard::sensing {
namespace {

// Below which a standard normal number lies with the given probability.
float Quantile(double probability) {
  if (probability <= 0.0) return -std::numeric_limits<float>::infinity();
  return static_cast<float>(core::NormalQuantile(probability));
}

// Sums over `window` neighbours along rows, and then along columns: w x w independent numbers of
// variance 1, divided by w, have variance 1 again. Pixels (i, j) apart share (w - i)(w - j) of the
// numbers, so they correlate by (1 - i/w)(1 - j/w).
DepthImage MeanOfWindows(const DepthImage& numbers, Eigen::Index window) {
  const Eigen::Index rows = numbers.rows() - window + 1;
  const Eigen::Index columns = numbers.cols() - window + 1;
  DepthImage along_rows = numbers.leftCols(columns);
  for (Eigen::Index i = 1; i < window; ++i) along_rows += numbers.middleCols(i, columns);
  DepthImage sums = along_rows.topRows(rows);
  for (Eigen::Index i = 1; i < window; ++i) sums += along_rows.middleRows(i, rows);
  return sums / static_cast<double>(window);
}

}  // namespace

StereoMatcher::StereoMatcher(const StereoParams& params)
    : params_(params),
      mismatch_quantile_(Quantile(params.mismatch_probability)),
      dropout_quantile_(Quantile(params.dropout_probability)),
      edge_dropout_quantile_(Quantile(params.edge_dropout_probability)) {}

// In the order of stereo_sensor.h: noise, rounding, wrong matches, the searched range, dropouts. 0
// stays 0.
void StereoMatcher::Match(core::TrialKey key, std::uint32_t look, const DepthImage& all,
                          DepthImage& seen) const {
  AddNoise(key, look, seen);
  const double step_px = params_.disparity_step_px;
  if (step_px > 0.0) seen = step_px * (seen / step_px).round();
  if (params_.mismatch_probability > 0.0) Mismatch(key, look, seen);
  seen = (seen >= params_.min_disparity_px && seen <= params_.max_disparity_px).select(seen, 0.0);
  if (params_.dropout_probability > 0.0 || params_.edge_dropout_probability > 0.0) {
    DropOut(key, look, all, seen);
  }
}

void StereoMatcher::AddNoise(core::TrialKey key, std::uint32_t look, DepthImage& seen) const {
  if (params_.disparity_noise_px <= 0.0) return;
  const rendering::PixelNoise noise(key, core::Purpose::kStereoDisparity, look);
  const auto beyond = static_cast<int>(params_.noise_window_px) - 1;
  // w - 1 more numbers on each axis, so that every pixel has a full window.
  DepthImage numbers(seen.rows() + beyond, seen.cols() + beyond);
  for (int row = 0; row < numbers.rows(); ++row) {
    rendering::ForEachPixelNoise(noise, row, 0, static_cast<int>(numbers.cols()),
                                 [&](int column, float number) { numbers(row, column) = number; });
  }
  if (beyond > 0) numbers = MeanOfWindows(numbers, beyond + 1);
  seen = (seen > 0.0).select(seen + params_.disparity_noise_px * numbers, 0.0);
}

// A normal number z is a mismatch where Phi(z) < p; Phi(z) / p is then uniform in [0, 1), and says
// where in the searched range the match lies. One draw serves both.
void StereoMatcher::Mismatch(core::TrialKey key, std::uint32_t look, DepthImage& seen) const {
  const rendering::PixelNoise noise(key, core::Purpose::kStereoMismatch, look);
  const double searched_px = params_.max_disparity_px - params_.min_disparity_px;
  for (int row = 0; row < seen.rows(); ++row) {
    rendering::ForEachPixelNoise(
        noise, row, 0, static_cast<int>(seen.cols()), [&](int column, float number) {
          if (number >= mismatch_quantile_ || seen(row, column) == 0.0) return;
          const double share =
              0.5 * std::erfc(-number / std::numbers::sqrt2) / params_.mismatch_probability;
          seen(row, column) = params_.min_disparity_px + std::min(share, 1.0) * searched_px;
        });
  }
}

void StereoMatcher::FindEdges(std::span<const double> row_px,
                              std::vector<char>& beside_edge) const {
  std::fill(beside_edge.begin(), beside_edge.end(), char{0});
  const auto reach = static_cast<std::size_t>(params_.edge_reach_px);
  for (std::size_t column = 1; column < row_px.size(); ++column) {
    // Between columns c - 1 and c the disparity jumps: windows at c - reach .. c + reach - 1 hold
    // both sides.
    if (std::abs(row_px[column] - row_px[column - 1]) < params_.edge_disparity_px) continue;
    const std::size_t first = column > reach ? column - reach : 0;
    const std::size_t end = std::min(column + reach, row_px.size());
    for (std::size_t i = first; i < end; ++i) beside_edge[i] = 1;
  }
}

// Jumps are taken from what the left camera sees (`all`), whether the right one sees it or not.
void StereoMatcher::DropOut(core::TrialKey key, std::uint32_t look, const DepthImage& all,
                            DepthImage& seen) const {
  const rendering::PixelNoise noise(key, core::Purpose::kStereoDropout, look);
  const auto columns = static_cast<std::size_t>(seen.cols());
  std::vector<char> beside_edge(columns);
  for (int row = 0; row < seen.rows(); ++row) {
    if ((seen.row(row) == 0.0).all()) continue;
    FindEdges({&all(row, 0), columns}, beside_edge);
    rendering::ForEachPixelNoise(
        noise, row, 0, static_cast<int>(columns), [&](int column, float number) {
          const bool edge = beside_edge[static_cast<std::size_t>(column)] != 0;
          if (number < (edge ? edge_dropout_quantile_ : dropout_quantile_)) seen(row, column) = 0.0;
        });
  }
}

}  // namespace rockyard::sensing
