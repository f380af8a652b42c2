// Parameters of the matching of features between two images (Howard 2012 section 2).
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/fields.h"

namespace rockyard::vision {

// Which features of the second image a feature of the first is compared with.
enum class MatchSearch {
  kAll,        // every one, as the FPGA of Howard 2012 does
  kPredicted,  // those near where a predicted motion puts it, if there is one
};

// What its window is before that.
enum class MatchWarp {
  kNone,       // as the first image has it
  kPredicted,  // as a predicted motion turns and scales it, if there is one
};

struct FeatureMatcherParams {
  std::int64_t window_px = 15;
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
struct rockyard::core::EnumNames<rockyard::vision::MatchSearch> {
  static constexpr std::array<std::string_view, 2> kNames{"all", "predicted"};
};

template <>
struct rockyard::core::EnumNames<rockyard::vision::MatchWarp> {
  static constexpr std::array<std::string_view, 2> kNames{"none", "predicted"};
};
