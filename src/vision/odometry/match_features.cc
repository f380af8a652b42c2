#include "vision/odometry/match_features.h"

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/check.h"
#include "vision/odometry/window.h"

namespace rockyard::vision {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// The best of what a feature was compared with.
struct Best {
  std::size_t index = 0;
  std::uint32_t difference = kNone;
  std::uint32_t second = kNone;

  void Offer(std::size_t other, std::uint32_t value) {
    if (value < difference) {
      second = difference;
      difference = value;
      index = other;
    } else if (value < second) {
      second = value;
    }
  }
};

WindowSet FirstWindows(const GrayImage& image, const Features& features,
                       const FeatureMatcherParams& params, const PredictedFeatures& predicted) {
  const int side = static_cast<int>(params.window_px);
  const bool warp = params.warp == MatchWarp::kPredicted && !predicted.empty();
  WindowSet windows(features.size());
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (warp) {
      WarpWindow(image, Pixel(features[i].column, features[i].row), predicted[i].by_offset, side,
                 windows.At(i));
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

bool IsNear(const PredictedFeature& predicted, const Feature& feature,
            const FeatureMatcherParams& params) {
  return std::abs(predicted.pixel.x() - feature.column) <= params.search_columns_px &&
         std::abs(predicted.pixel.y() - feature.row) <= params.search_rows_px;
}

struct AllBest {
  std::vector<Best> of_first;
  std::vector<Best> of_second;
};

AllBest Compare(const WindowSet& first, const WindowSet& second) {
  AllBest best{std::vector<Best>(first.size()), std::vector<Best>(second.size())};
  std::vector<std::uint32_t> differences(second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    WindowDifferences(first.At(i), second, differences);
    for (std::size_t j = 0; j < second.size(); ++j) {
      best.of_first[i].Offer(j, differences[j]);
      best.of_second[j].Offer(i, differences[j]);
    }
  }
  return best;
}

AllBest CompareNear(const WindowSet& first, const WindowSet& second,
                    const Features& second_features, const FeatureMatcherParams& params,
                    const PredictedFeatures& predicted) {
  AllBest best{std::vector<Best>(first.size()), std::vector<Best>(second.size())};
  for (std::size_t i = 0; i < first.size(); ++i) {
    for (std::size_t j = 0; j < second.size(); ++j) {
      if (!IsNear(predicted[i], second_features[j], params)) continue;
      const std::uint32_t difference = WindowDifference(first.At(i), second.At(j));
      best.of_first[i].Offer(j, difference);
      best.of_second[j].Offer(i, difference);
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
  const AllBest best =
      near ? CompareNear(first_windows, second_windows, second_features, params, predicted)
           : Compare(first_windows, second_windows);
  const double most = params.max_difference * static_cast<double>(side * side);
  for (std::size_t i = 0; i < first_features.size(); ++i) {
    const Best& found = best.of_first[i];
    if (found.difference == kNone || found.difference > most) continue;
    if (params.mutual && best.of_second[found.index].index != i) continue;
    if (params.ratio < 1.0 && found.second != kNone &&
        found.difference > params.ratio * found.second) {
      continue;
    }
    matches.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(found.index),
                       static_cast<std::int32_t>(found.difference)});
  }
  return matches;
}

}  // namespace rockyard::vision
