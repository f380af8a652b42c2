#include "sensing/stereo_match.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/distributions.h"
#include "sensing/pixel_noise.h"

namespace rockyard::sensing {
namespace {

// Below which a standard normal number lies with the given probability.
float Quantile(double probability) {
  if (probability <= 0.0) return -std::numeric_limits<float>::infinity();
  return static_cast<float>(core::NormalQuantile(probability));
}

}  // namespace

StereoMatcher::StereoMatcher(const StereoParams& params)
    : params_(params),
      columns_(static_cast<int>(params.columns)),
      rows_(static_cast<int>(params.rows)),
      dropout_quantile_(Quantile(params.dropout_probability)),
      edge_dropout_quantile_(Quantile(params.edge_dropout_probability)) {}

void StereoMatcher::Match(core::TrialKey key, std::uint32_t look, const std::vector<double>& all_px,
                          std::vector<double>& seen_px) const {
  AddNoise(key, look, seen_px);
  DropOut(key, look, all_px, seen_px);
}

void StereoMatcher::AddNoise(core::TrialKey key, std::uint32_t look,
                             std::vector<double>& seen_px) const {
  const PixelNoise noise(key, core::Purpose::kStereoDisparity, look);
  for (int row = 0; row < rows_; ++row) {
    double* const row_px = seen_px.data() + static_cast<std::ptrdiff_t>(row) * columns_;
    if (params_.disparity_noise_px > 0.0) {
      ForEachPixelNoise(noise, row, 0, columns_, [&](int column, float number) {
        if (row_px[column] > 0.0) row_px[column] += params_.disparity_noise_px * number;
      });
    }
    for (int column = 0; column < columns_; ++column) {
      double& disparity_px = row_px[column];
      if (params_.disparity_step_px > 0.0) {
        disparity_px =
            params_.disparity_step_px * std::nearbyint(disparity_px / params_.disparity_step_px);
      }
      const bool searched =
          disparity_px >= params_.min_disparity_px && disparity_px <= params_.max_disparity_px;
      if (!searched) disparity_px = 0.0;
    }
  }
}

void StereoMatcher::FindEdges(const double* row_px, std::vector<char>& beside_edge) const {
  std::fill(beside_edge.begin(), beside_edge.end(), char{0});
  const int reach = static_cast<int>(params_.edge_reach_px);
  for (int column = 1; column < columns_; ++column) {
    if (std::abs(row_px[column] - row_px[column - 1]) < params_.edge_disparity_px) continue;
    const auto first = beside_edge.begin() + std::max(column - reach, 0);
    std::fill(first, beside_edge.begin() + std::min(column + reach, columns_), char{1});
  }
}

void StereoMatcher::DropOut(core::TrialKey key, std::uint32_t look,
                            const std::vector<double>& all_px, std::vector<double>& seen_px) const {
  const bool never = params_.dropout_probability <= 0.0 && params_.edge_dropout_probability <= 0.0;
  if (never) return;
  const PixelNoise noise(key, core::Purpose::kStereoDropout, look);
  std::vector<char> beside_edge(static_cast<std::size_t>(columns_));
  for (int row = 0; row < rows_; ++row) {
    const std::ptrdiff_t start = static_cast<std::ptrdiff_t>(row) * columns_;
    FindEdges(all_px.data() + start, beside_edge);
    double* const row_px = seen_px.data() + start;
    ForEachPixelNoise(noise, row, 0, columns_, [&](int column, float number) {
      const bool edge = beside_edge[static_cast<std::size_t>(column)] != 0;
      if (number < (edge ? edge_dropout_quantile_ : dropout_quantile_)) row_px[column] = 0.0;
    });
  }
}

}  // namespace rockyard::sensing
