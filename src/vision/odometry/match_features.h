// Features of two images that look alike (Howard 2012 section 2: sums of absolute differences of
// windows): the second stage of VisualOdometer.
#pragma once

#include <vector>

#include "vision/cameras/camera_types.h"
#include "vision/image.h"
#include "vision/odometry/feature.h"
#include "vision/odometry/feature_params.h"

namespace rockyard::vision {

// Where a predicted motion puts a feature of the first image in the second, and how its
// surroundings look there. Matching turns and scales windows by view.by_offset alone.
struct PredictedFeature {
  Pixel pixel = Pixel::Zero();
  ViewChange view;                                  // from the second image to the first
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  // of the disparity there, by column and row
};

// One for each feature of the first image. Empty where nothing is predicted: then every feature is
// compared with every one.
using PredictedFeatures = std::vector<PredictedFeature>;

// Returns the matches, in the order of the first image's features. Must stay: of equal differences
// the feature of smaller index is the match. Features must keep half a window from the edges
// (FeatureDetectorParams::border_px). Cost: 0.4 ms for 400 features against 400, a quarter of it
// near predictions.
FeatureMatches MatchFeatures(const GrayImage& first, const Features& first_features,
                             const GrayImage& second, const Features& second_features,
                             const FeatureMatcherParams& params,
                             const PredictedFeatures& predicted = {});

}  // namespace rockyard::vision
