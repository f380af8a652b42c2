#include "vision/odometry/match_features.h"

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/check.h"
#include "vision/odometry/best_matches.h"
#include "vision/odometry/features_near.h"
#include "vision/odometry/window.h"

namespace rockyard::vision {
namespace {

WindowSet FirstWindows(const GrayImage& image, const Features& features,
                       const FeatureMatcherParams& params, const PredictedFeatures& predicted) {
  const int side = static_cast<int>(params.window_px);
  const bool warp = params.warp == MatchWarp::kPredicted && !predicted.empty();
  WindowSet windows(features.size());
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (warp) {
      WarpWindow(image, features[i], predicted[i].view.by_offset, side, windows.At(i));
    } else {
      CopyWindow(image, features[i], side, windows.At(i));
    }
  }
  return windows;
}

WindowSet SecondWindows(const GrayImage& image, const Features& features, int side) {
  WindowSet windows(features.size());
  for (std::size_t i = 0; i < features.size(); ++i) {
    CopyWindow(image, features[i], side, windows.At(i));
  }
  return windows;
}

// Compares each window of the first image with the features near its predicted place alone.
BestWindows CompareNear(const WindowSet& first, const WindowSet& second,
                        const Features& second_features, const FeatureMatcherParams& params,
                        const PredictedFeatures& predicted) {
  BestWindows best{std::vector<BestWindow>(first.size()), std::vector<BestWindow>(second.size())};
  FeaturesNear near(second_features);
  std::vector<std::uint16_t> differences(second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    const std::span<const std::int32_t> chosen =
        near.Find(predicted[i].pixel, params.search_columns_px, params.search_rows_px);
    ChosenDifferences(first.At(i), second, chosen, differences);
    for (std::size_t k = 0; k < chosen.size(); ++k) {
      const auto j = static_cast<std::size_t>(chosen[k]);
      best.of_first[i].Merge({chosen[k], differences[k], kNoDifference});
      best.of_second[j].Merge({static_cast<std::int32_t>(i), differences[k], kNoDifference});
    }
  }
  return best;
}

}  // namespace

FeatureMatches MatchFeatures(const GrayImage& first, const Features& first_features,
                             const GrayImage& second, const Features& second_features,
                             const FeatureMatcherParams& params,
                             const PredictedFeatures& predicted) {
  EXPECT(predicted.empty() || predicted.size() == first_features.size());
  FeatureMatches matches;
  if (first_features.empty() || second_features.empty()) return matches;
  const int side = static_cast<int>(params.window_px);
  const WindowSet first_windows = FirstWindows(first, first_features, params, predicted);
  const WindowSet second_windows = SecondWindows(second, second_features, side);
  const bool near = params.search == MatchSearch::kPredicted && !predicted.empty();
  // Only the ratio needs second differences, for which all windows have to be compared.
  const BestWindows best =
      near ? CompareNear(first_windows, second_windows, second_features, params, predicted)
      : params.ratio < 1.0 ? FindBestWindows(first_windows, second_windows)
                           : FindLeastDifferent(first_windows, second_windows);
  const double most = params.max_difference * static_cast<double>(side * side);
  for (std::size_t i = 0; i < first_features.size(); ++i) {
    const BestWindow& found = best.of_first[i];
    if (found.difference == kNoDifference || found.difference > most) continue;
    const BestWindow& back = best.of_second[static_cast<std::size_t>(found.index)];
    if (params.mutual && back.index != static_cast<std::int32_t>(i)) continue;
    const bool ambiguous =
        found.second != kNoDifference && found.difference > params.ratio * found.second;
    if (params.ratio < 1.0 && ambiguous) continue;
    matches.push_back(
        {static_cast<std::int32_t>(i), found.index, static_cast<std::int32_t>(found.difference)});
  }
  return matches;
}

}  // namespace rockyard::vision
