// Parameters of the detector of features and of their matching between two images (Howard 2012
// section 2): two groups of OdometerParams (odometer_params.h). Meaning, unit and origin of each
// stand in Visit. Records of drives with visual odometry depend on the defaults.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"

namespace rockyard::vision {

// What is changed in a region until its number of features is between min_features and
// max_features.
enum class Adapted {
  kThreshold,  // the response from which on a corner counts
  kWeight,     // the weight k of the trace in the response
};

// Whether min_features and max_features hold for each region or for the image.
enum class CountedIn { kRegion, kImage };

struct FeatureDetectorParams {
  std::int64_t regions_across = 4;
  std::int64_t regions_down = 4;
  std::int64_t min_features = 10;
  std::int64_t max_features = 25;
  CountedIn counted_in = CountedIn::kRegion;
  Adapted adapted = Adapted::kThreshold;
  double weight = 0.04;
  double threshold = 1000.0;
  double min_threshold = 50.0;
  std::int64_t suppression_px = 3;
  std::int64_t border_px = 8;  // at least half of FeatureMatcherParams::window_px

  std::int64_t regions() const { return regions_across * regions_down; }
  // Return the numbers for one region.
  std::int64_t min_of_region() const;
  std::int64_t max_of_region() const;

  void Visit(core::FieldVisitor& v);
};

// Which features of the second image a feature of the first is compared with.
enum class MatchSearch {
  kAll,        // every one, as the FPGA of Howard 2012 does
  kPredicted,  // those near where a predicted motion puts it, if there is one
};

// How the windows of the first image are compared.
enum class MatchWarp {
  kNone,       // as they are
  kPredicted,  // turned and scaled by a predicted motion, if there is one
};

struct FeatureMatcherParams {
  std::int64_t window_px = 15;  // for matching; the finer search takes PlacementParams::window_px
  bool mutual = true;
  double ratio = 1.0;
  double max_difference = 30.0;
  MatchSearch search = MatchSearch::kPredicted;
  double search_columns_px = 60.0;
  double search_rows_px = 40.0;
  MatchWarp warp = MatchWarp::kPredicted;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::vision

template <>
struct rockyard::core::EnumNames<rockyard::vision::Adapted> {
  static constexpr std::array<std::string_view, 2> kNames{"threshold", "weight"};
};

template <>
struct rockyard::core::EnumNames<rockyard::vision::CountedIn> {
  static constexpr std::array<std::string_view, 2> kNames{"region", "image"};
};

template <>
struct rockyard::core::EnumNames<rockyard::vision::MatchSearch> {
  static constexpr std::array<std::string_view, 2> kNames{"all", "predicted"};
};

template <>
struct rockyard::core::EnumNames<rockyard::vision::MatchWarp> {
  static constexpr std::array<std::string_view, 2> kNames{"none", "predicted"};
};
