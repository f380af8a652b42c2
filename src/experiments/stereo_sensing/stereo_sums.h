// What the experiment "stereo_sensing" counts and adds up of the looks of one cell.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace rockyard::experiments {

// Pixels of one kind whose truth is known.
struct PixelSums {
  double pixels = 0.0;
  double good = 0.0;        // matched within kWrong_px of the truth
  double wrong = 0.0;       // matched farther off
  double bias_px = 0.0;     // sum over good ones of matched less true disparity
  double error2_px2 = 0.0;  // sum of their squares

  void Add(double true_px, double matched_px);  // 0: no match
};

// From here on a match is wrong rather than inexact: the neighbouring disparity of the search.
inline constexpr double kWrong_px = 1.0;

inline constexpr std::size_t kEdgeDistances = 8;  // columns from a jump in depth, from 1 on
inline constexpr std::size_t kLags = 7;           // columns between neighbours in a row, from 1 on
inline constexpr std::array<const char*, 4> kPixelKinds{"plain", "front", "behind", "shadow"};
// Rocks by height: from 0.5, 1, 1.5 and 2 times the height of a hazard on.
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
  double range_m = 0.0;  // sums over good ones of `all`
  double range_bias_m = 0.0;
  double range_error2_m2 = 0.0;
  double range_step2_m2 = 0.0;
  double axis_step2_m2 = 0.0;
  // Of these: plain ground and rocks, on the nearer and on the farther side of a jump in depth, the
  // rest in shadow.
  std::array<PixelSums, kPixelKinds.size()> kinds;
  std::array<PixelSums, kEdgeDistances> fronts;
  std::array<PixelSums, kEdgeDistances> behinds;
  std::array<double, kLags> pairs{};
  std::array<double, kLags> products_px2{};
  // Pixels apart from these.
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

// Calls f(name, value) for every column, in the order of the records.
template <typename F>
void ForEachSum(const StereoSums& s, F&& f) {
  f("looks", s.looks);
  f("pixels", s.all.pixels);
  f("matched", s.all.good + s.all.wrong);
  f("good", s.all.good);
  f("wrong", s.all.wrong);
  f("bias_px", s.all.bias_px);
  f("error_px", s.all.error2_px2);
  f("range_m", s.range_m);
  f("range_bias_m", s.range_bias_m);
  f("range_error_m", s.range_error2_m2);
  f("range_step_m", s.range_step2_m2);
  f("axis_step_m", s.axis_step2_m2);
  for (std::size_t i = 0; i < kPixelKinds.size(); ++i) {
    const std::string kind = kPixelKinds[i];
    const PixelSums& sums = s.kinds[i];
    f(kind + "_pixels", sums.pixels);
    f(kind + "_good", sums.good);
    f(kind + "_wrong", sums.wrong);
    f(kind + "_bias_px", sums.bias_px);
    f(kind + "_error_px", sums.error2_px2);
  }
  for (std::size_t i = 0; i < kEdgeDistances; ++i) {
    const std::string distance = std::to_string(i + 1);
    f("front_pixels_" + distance, s.fronts[i].pixels);
    f("front_matched_" + distance, s.fronts[i].good + s.fronts[i].wrong);
    f("front_wrong_" + distance, s.fronts[i].wrong);
    f("behind_pixels_" + distance, s.behinds[i].pixels);
    f("behind_matched_" + distance, s.behinds[i].good + s.behinds[i].wrong);
    f("behind_wrong_" + distance, s.behinds[i].wrong);
  }
  for (std::size_t i = 0; i < kLags; ++i) {
    const std::string lag = std::to_string(i + 1);
    f("pairs_" + lag, s.pairs[i]);
    f("product_px2_" + lag, s.products_px2[i]);
  }
  f("margin_pixels", s.margin.pixels);
  f("margin_matched", s.margin.good + s.margin.wrong);
  f("hidden_pixels", s.hidden_pixels);
  f("hidden_matched", s.hidden_matched);
  for (std::size_t i = 0; i < kRockHeights.size(); ++i) {
    const std::string height = kRockHeights[i];
    f("rocks_" + height, s.rocks[i].rocks);
    f("perfect_" + height, s.rocks[i].perfect);
    f("found_" + height, s.rocks[i].found);
  }
  f("clear_cells", s.clear_cells);
  f("clear_known", s.clear_known);
  f("imagined", s.imagined);
  f("hazard_cells", s.hazard_cells);
  f("hazard_found", s.hazard_found);
}

}  // namespace rockyard::experiments
