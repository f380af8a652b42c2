// What the experiment "stereo_sensing" counts and adds up of the looks of one cell: pixels against
// their truth, and rocks and cells of the navigator's map of a look against its map with perfect
// matches. Range, depth and bins: stereo_sensing.h. The sums are records: the order in which pixels
// are added is part of their bits.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "experiments/stereo_sensing/stereo_sensing_params.h"
#include "messages/navigation_view.h"
#include "messages/point_cloud.h"
#include "navigation/navigator_set_params.h"
#include "sensing/stereo_depth.h"
#include "sensing/stereo_ground_truth.h"
#include "sensing/stereo_view.h"
#include "terrain/terrain.h"
#include "truth/record.h"

namespace rockyard::experiments {

// Pixels of one kind whose truth is known.
struct PixelSums {
  double pixels = 0.0;
  double good = 0.0;        // matched within kWrong_px of the truth
  double wrong = 0.0;       // matched farther off
  double bias_px = 0.0;     // sum over good pixels of matched less true disparity
  double error2_px2 = 0.0;  // sum of the squares of that

  void Add(double true_px, double matched_px);  // 0: no match
};

// From this error on a match is wrong rather than inexact: it has reached the neighbouring
// disparity of the search. Meanings of columns call it 1 px.
inline constexpr double kWrong_px = 1.0;

inline constexpr std::size_t kEdgeDistances = 8;  // columns from a jump in depth, from 1 on
inline constexpr std::size_t kLags = 7;           // columns between neighbours in a row, from 1 on
inline constexpr std::array<const char*, 4> kPixelKinds{"plain", "front", "behind", "shadow"};
// Classes of rocks by height: from 0.5, 1, 1.5 and 2 times the height of a hazard on. ClassOf
// counts in these halves.
inline constexpr std::array<const char*, 4> kRockHeights{"05", "10", "15", "20"};

struct RockSums {
  double rocks = 0.0;
  double perfect = 0.0;  // found with perfect matches
  double found = 0.0;
};

struct StereoSums {
  double looks = 0.0;
  // All pixels that both eyes see, away from margins.
  PixelSums all;
  double range_m = 0.0;  // this and the next four are sums over the good pixels of `all`
  double range_bias_m = 0.0;
  double range_error2_m2 = 0.0;
  double range_step2_m2 = 0.0;
  double axis_step2_m2 = 0.0;
  // Pixels of `all`: plain ground and rocks, those on the nearer and on the farther side of a jump
  // in depth, the rest in shadow.
  std::array<PixelSums, kPixelKinds.size()> kinds;
  std::array<PixelSums, kEdgeDistances> fronts;
  std::array<PixelSums, kEdgeDistances> behinds;
  std::array<double, kLags> pairs{};
  std::array<double, kLags> products_px2{};
  // Pixels that are not in `all`.
  PixelSums margin;
  double hidden_pixels = 0.0;
  double hidden_matched = 0.0;
  // What the navigator makes of a look.
  std::array<RockSums, kRockHeights.size()> rocks;
  double clear_cells = 0.0;
  double clear_known = 0.0;
  double imagined = 0.0;
  double hazard_cells = 0.0;
  double hazard_found = 0.0;
};

// Visits the columns of one side of a jump in depth, `ending` columns from it.
template <typename Visitor>
void ForEachSideColumn(const std::string& side, const std::string& ending, const PixelSums& s,
                       const Visitor& visit) {
  using enum truth::ColumnRole;
  const std::string base = side + "_pixels" + ending;
  visit({base, "1", "pixels as many columns from the nearest jump in depth, on that side", kBase},
        s.pixels);
  visit({side + "_matched" + ending, "1", "of these, matched", kCount, base}, s.good + s.wrong);
  visit({side + "_wrong" + ending, "1", "of these, off by 1 px", kCount, base}, s.wrong);
}

template <typename Visitor>
void ForEachColumn(const StereoSums& s, const Visitor& visit) {
  using enum truth::ColumnRole;
  visit({"looks", "1", "looks, each on a terrain of its own", kTrials}, s.looks);
  visit({"pixels", "1", "pixels whose surface both cameras see, away from margins", kBase},
        s.all.pixels);
  visit({"matched", "1", "of these, with a disparity: the density", kMainCount, "pixels"},
        s.all.good + s.all.wrong);
  visit({"good", "1", "off by less than 1 px", kCount, "pixels"}, s.all.good);
  visit({"wrong", "1", "off by 1 px or more", kCount, "matched"}, s.all.wrong);
  visit({"bias_px", "px", "matched less true disparity", kSum, "good"}, s.all.bias_px);
  visit({"error_px", "px", "matched less true disparity", kSquares, "good"}, s.all.error2_px2);
  visit({"range_m", "m", "true range from the left camera", kSum, "good"}, s.range_m);
  visit({"range_bias_m", "m", "measured less true range", kSum, "good"}, s.range_bias_m);
  visit({"range_error_m", "m", "measured less true range", kSquares, "good"}, s.range_error2_m2);
  visit({"range_step_m", "m", "range that one pixel of disparity stands for, r Z / (f B)", kSquares,
         "good"},
        s.range_step2_m2);
  visit({"axis_step_m", "m", "the same on the optical axis, r^2 / (f B)", kSquares, "good"},
        s.axis_step2_m2);
  constexpr std::array<const char*, kPixelKinds.size()> kMeanings{
      "lit, away from jumps in depth",
      "on the nearer side of a jump in depth, within sensors.stereo.edge_reach_px",
      "on its farther side", "outside of the sun, away from jumps"};
  for (std::size_t i = 0; i < kPixelKinds.size(); ++i) {
    const std::string kind = kPixelKinds[i];
    const PixelSums& sums = s.kinds[i];
    visit({kind + "_pixels", "1", std::string("of the pixels: ") + kMeanings[i], kBase},
          sums.pixels);
    visit({kind + "_good", "1", "matched within 1 px", kCount, kind + "_pixels"}, sums.good);
    visit({kind + "_wrong", "1", "matched farther off", kCount, kind + "_pixels"}, sums.wrong);
    visit({kind + "_bias_px", "px", "matched less true disparity", kSum, kind + "_good"},
          sums.bias_px);
    visit({kind + "_error_px", "px", "matched less true disparity", kSquares, kind + "_good"},
          sums.error2_px2);
  }
  for (std::size_t i = 0; i < kEdgeDistances; ++i) {
    const std::string ending = std::string("_").append(std::to_string(i + 1));
    ForEachSideColumn("front", ending, s.fronts[i], visit);
    ForEachSideColumn("behind", ending, s.behinds[i], visit);
  }
  for (std::size_t i = 0; i < kLags; ++i) {
    const std::string lag = std::to_string(i + 1);
    visit({"pairs_" + lag, "1", "pairs of good plain pixels as many columns apart", kBase},
          s.pairs[i]);
    visit(
        {"product_px2_" + lag, "px2", "product of their errors of disparity", kSum, "pairs_" + lag},
        s.products_px2[i]);
  }
  visit({"margin_pixels", "1",
         "seen by both, but a window reaches over an image's edge or the rover", kBase},
        s.margin.pixels);
  visit({"margin_matched", "1", "of these, matched", kCount, "margin_pixels"},
        s.margin.good + s.margin.wrong);
  visit({"hidden_pixels", "1", "what the left camera alone sees", kBase}, s.hidden_pixels);
  visit({"hidden_matched", "1", "of these, matched", kCount, "hidden_pixels"}, s.hidden_matched);
  for (std::size_t i = 0; i < kRockHeights.size(); ++i) {
    const std::string height = kRockHeights[i];
    const std::string base = "rocks_" + height;
    visit({base, "1",
           "rocks in view of at least as many tenths of hazard_height_m, below the next class",
           kBase},
          s.rocks[i].rocks);
    visit({"perfect_" + height, "1", "the navigator's map calls a hazard with perfect matches",
           kCount, base},
          s.rocks[i].perfect);
    visit({"found_" + height, "1", "it does so with the points of the look", kCount, base},
          s.rocks[i].found);
  }
  visit({"clear_cells", "1", "cells of the map without hazard with perfect matches", kBase},
        s.clear_cells);
  visit({"clear_known", "1", "of these, known from the look", kCount, "clear_cells"},
        s.clear_known);
  visit({"imagined", "1", "of these, called a hazard", kCount, "clear_known"}, s.imagined);
  visit({"hazard_cells", "1", "cells with a hazard with perfect matches", kBase}, s.hazard_cells);
  visit({"hazard_found", "1", "of these, called a hazard from the look", kCount, "hazard_cells"},
        s.hazard_found);
}

// Which pixels of a look belong to a cell, and which lie beside a jump in depth.
struct PixelLimits {
  double nearest_m = 0.0;   // true range from the left camera, along the ray
  double farthest_m = 0.0;  // not included
  double min_disparity_px = 0.0;
  double max_disparity_px = 0.0;
  int edge_reach_px = 0;  // columns from a jump in depth up to which a pixel lies beside it
};

// Adds the pixels of one look, with the errors of their matched disparities, to `sums`.
// `matched_px` are disparities on the pixels of `truth`, 0 where there is no match; `view` is the
// left eye's, in any frame. True disparities outside the searched range do not count. Pairs of
// neighbours lie in one row and within the cell.
void AddPixels(const sensing::StereoTruth& truth, const sensing::DepthImage& matched_px,
               const sensing::StereoView& view, const PixelLimits& limits, StereoSums& sums);

// The maps that the scenario's navigator makes of one look, in R: with perfect matches of all that
// both eyes see, and with the matches of the look.
struct LookMaps {
  const messages::MapView& perfect;
  const messages::MapView& seen;
};

// The bin of ranges of a cell.
struct DistanceBin {
  double nearest_m = 0.0;
  double farthest_m = 0.0;  // not included

  bool Holds(double distance_m) const { return distance_m >= nearest_m && distance_m < farthest_m; }
};

// Adds the rocks in view the mean range of whose visible part lies within the bin. A rock is found
// where the map calls a hazard the cell that holds the middle of its visible part.
void AddRocksInView(const StereoSensingParams& params, const terrain::Terrain& terrain,
                    const sensing::StereoTruth& truth, const sensing::StereoView& view_R,
                    const LookMaps& maps, const DistanceBin& bin, StereoSums& sums);

// Adds the cells of the map whose middle on the ground lies, by its distance from the left camera,
// within the bin.
void AddCellsOfMap(const StereoSensingParams& params, const sensing::StereoView& view_R,
                   const LookMaps& maps, const DistanceBin& bin, StereoSums& sums);

// Returns the map of a navigator that begins to drive, level and at the origin of the map's frame,
// and gets `cloud` as its first look: coordinates of the map are those of R. A look behind, if the
// navigator asks for one, shows nothing. Throws std::runtime_error where the navigator keeps no
// map.
messages::MapView MapOfLook(const navigation::NavigatorKind& navigator,
                            const messages::PointCloud& cloud);

// What a map says of one place.
enum class Verdict { kUnknown, kClear, kHazard };

// Returns what a map says of the place. Cells of `hazard_goodness` or less are hazards; outside the
// map all is unknown.
Verdict VerdictAt(const messages::MapView& map, double x_m, double y_m, double hazard_goodness);

}  // namespace rockyard::experiments
