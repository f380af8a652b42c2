// Features and matches by their definitions, pixel by pixel: what the fast ones are compared with.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "vision/image.h"
#include "vision/odometry/feature.h"
#include "vision/odometry/feature_params.h"
#include "vision/odometry/match_features.h"

namespace rockyard::vision {

// The response of every pixel (harris.h).
Image<std::int64_t> PlainResponse(const GrayImage& image, std::int64_t weight);

// Whether a response is larger than those within `reach` columns and rows that come before it in
// the order of rows, and not smaller than those behind (LocalMaxima).
bool IsPeak(const Image<std::int64_t>& response, int x, int y, int reach);

// As FeatureDetector (detect_features.h).
Features PlainFeatures(const GrayImage& image, const FeatureDetectorParams& params,
                       const Image<std::uint8_t>& free);

// A window of `side` pixels about a feature, row by row.
using PlainWindow = std::vector<int>;
PlainWindow PlainWindowAt(const GrayImage& image, const Feature& feature, int side);

// The sum of absolute differences of two windows of one size.
int PlainDifference(const PlainWindow& a, const PlainWindow& b);

// As WarpWindow (window.h).
PlainWindow PlainWarpedWindow(const GrayImage& image, const Feature& feature,
                              const Eigen::Matrix2d& by_offset, int side);

// As MatchFeatures (match_features.h).
FeatureMatches PlainMatches(const GrayImage& first, const Features& first_features,
                            const GrayImage& second, const Features& second_features,
                            const FeatureMatcherParams& params, const PredictedFeatures& predicted);

}  // namespace rockyard::vision
