#include "experiments/stereo_sensing/columns.h"

#include <cstddef>
#include <string>

#include "experiments/stereo_sensing/stereo_sums.h"

namespace rockyard::experiments {
namespace {

using enum truth::ColumnRole;

void AddPixelKinds(truth::RecordSchema& columns) {
  constexpr std::array<const char*, kPixelKinds.size()> kMeanings{
      "lit, away from jumps in depth",
      "on the nearer side of a jump in depth, within sensors.stereo.edge_reach_px",
      "on its farther side", "outside of the sun, away from jumps"};
  for (std::size_t i = 0; i < kPixelKinds.size(); ++i) {
    const std::string kind = kPixelKinds[i];
    const std::string meaning = kMeanings[i];
    columns.push_back({kind + "_pixels", "1", "of the pixels: " + meaning, kBase});
    columns.push_back({kind + "_good", "1", "matched within 1 px", kCount, kind + "_pixels"});
    columns.push_back({kind + "_wrong", "1", "matched farther off", kCount, kind + "_pixels"});
    columns.push_back(
        {kind + "_bias_px", "px", "matched less true disparity", kSum, kind + "_good"});
    columns.push_back(
        {kind + "_error_px", "px", "matched less true disparity", kSquares, kind + "_good"});
  }
}

// Of one side of a jump in depth, `ending` columns from it.
void AddSide(const std::string& side, const std::string& ending, truth::RecordSchema& columns) {
  const std::string base = side + "_pixels" + ending;
  columns.push_back(
      {base, "1", "pixels as many columns from the nearest jump in depth, on that side", kBase});
  columns.push_back({side + "_matched" + ending, "1", "of these, matched", kCount, base});
  columns.push_back({side + "_wrong" + ending, "1", "of these, off by 1 px", kCount, base});
}

void AddNeighbours(truth::RecordSchema& columns) {
  for (std::size_t i = 1; i <= kEdgeDistances; ++i) {
    const std::string ending = std::string("_").append(std::to_string(i));
    for (const char* side : {"front", "behind"}) {
      AddSide(side, ending, columns);
    }
  }
  for (std::size_t i = 1; i <= kLags; ++i) {
    const std::string base = "pairs_" + std::to_string(i);
    columns.push_back({base, "1", "pairs of good plain pixels as many columns apart", kBase});
    columns.push_back({"product_px2_" + std::to_string(i), "px2",
                       "product of their errors of disparity", kSum, base});
  }
}

void AddRocks(truth::RecordSchema& columns) {
  for (const char* height : kRockHeights) {
    const std::string base = std::string("rocks_") + height;
    columns.push_back({base, "1",
                       "rocks in view of at least as many tenths of hazard_height_m, below the "
                       "next class",
                       kBase});
    columns.push_back({std::string("perfect_") + height, "1",
                       "the navigator's map calls a hazard with perfect matches", kCount, base});
    columns.push_back({std::string("found_") + height, "1",
                       "it does so with the points of the look", kCount, base});
  }
}

truth::RecordSchema MakeStereoColumns() {
  truth::RecordSchema columns{
      {"soil_graininess", "1", "texture of the soil, from drift to gravel", kFactor},
      {"sun_elevation_deg", "deg", "sun above the horizon", kFactor},
      {"baseline_m", "m", "between the two cameras", kFactor},
      {"nearest_m", "m", "from the left camera: what the cell begins with", kFactor},
      {"farthest_m", "m", "from the left camera: what the cell ends before", kFactor},
      {"looks", "1", "looks, each on a terrain of its own", kTrials},
      {"pixels", "1", "pixels whose surface both cameras see, away from margins", kBase},
      {"matched", "1", "of these, with a disparity: the density", kMainCount, "pixels"},
      {"good", "1", "off by less than 1 px", kCount, "pixels"},
      {"wrong", "1", "off by 1 px or more", kCount, "matched"},
      {"bias_px", "px", "matched less true disparity", kSum, "good"},
      {"error_px", "px", "matched less true disparity", kSquares, "good"},
      {"range_m", "m", "true range from the left camera", kSum, "good"},
      {"range_bias_m", "m", "measured less true range", kSum, "good"},
      {"range_error_m", "m", "measured less true range", kSquares, "good"},
      {"range_step_m", "m", "range that one pixel of disparity stands for, r Z / (f B)", kSquares,
       "good"},
      {"axis_step_m", "m", "the same on the optical axis, r^2 / (f B)", kSquares, "good"},
  };
  AddPixelKinds(columns);
  AddNeighbours(columns);
  columns.push_back({"margin_pixels", "1",
                     "seen by both, but a window reaches over an image's edge or the rover",
                     kBase});
  columns.push_back({"margin_matched", "1", "of these, matched", kCount, "margin_pixels"});
  columns.push_back({"hidden_pixels", "1", "what the left camera alone sees", kBase});
  columns.push_back({"hidden_matched", "1", "of these, matched", kCount, "hidden_pixels"});
  AddRocks(columns);
  columns.push_back(
      {"clear_cells", "1", "cells of the map without hazard with perfect matches", kBase});
  columns.push_back({"clear_known", "1", "of these, known from the look", kCount, "clear_cells"});
  columns.push_back({"imagined", "1", "of these, called a hazard", kCount, "clear_known"});
  columns.push_back({"hazard_cells", "1", "cells with a hazard with perfect matches", kBase});
  columns.push_back(
      {"hazard_found", "1", "of these, called a hazard from the look", kCount, "hazard_cells"});
  return columns;
}

}  // namespace

const truth::RecordSchema& StereoColumns() {
  static const truth::RecordSchema kColumns = MakeStereoColumns();
  return kColumns;
}

}  // namespace rockyard::experiments
