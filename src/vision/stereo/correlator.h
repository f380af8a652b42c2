// The 1-D correlator with its checks (Goldberg 2002 section 2, stages 4 and 5), row by row, for
// MatchStereo. Visual odometry compares windows with the same instruction sets. Records depend on
// scores, ties and the rounding of SubPixel; how rows lie in vectors and which sums slide is free,
// as long as the plain form in the tests is equalled.
//
// For every pixel (x, y) of the left image and every disparity d of the range the score is the sum
// of absolute differences over the window. A window of side n reaches from n / 2 pixels before its
// pixel (rounded down) to n - 1 - n / 2 behind it, along rows and columns:
//   S(x, d) = sum over the window of |L(x + i, y + k) - R(x + i - d, y + k)|,
// small for a good match. A candidate is a pair of pixels whose windows both lie in their images.
//   left:   d_L(x) = the d of the smallest S(x, d), the smallest such d where several are equal
//   right:  d_R(x) = the d of the smallest S(x + d, d), likewise, in the same pass over the scores
//   line of sight: |d_L(x) - d_R(x - d_L(x))| <= 1 px (a parameter)
//   peak filter:   S(x, d_L - 1) and S(x, d_L + 1) exist and are larger than S(x, d_L); the
//                  curvature c = S(x, d_L - 1) - 2 S(x, d_L) + S(x, d_L + 1) is at least n^2
//                  min_curvature, and at least S(x, d_L) min_curvature_ratio
//   sub-pixel:     the lowest point of a parabola through the three scores, or of two lines
//                  (SubPixel)
//
// Sums slide in both directions: a score gains the window's new row and loses the row that leaves
// it, and the sum over a row of the window slides along that row, so that the time does not depend
// on the window.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "vision/image.h"
#include "vision/stereo/aligned_buffer.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::vision {

// Writes the disparities of rows first_row ... end_row - 1 of the left image; other rows stay as
// they are, and threads may write bands of rows at the same time. `left` and `right` are images of
// DifferenceOfGaussians with values of at most 2 params.dog.limit, of the size of `out`. The
// parameters must be accepted by StereoPipelineParams::Visit. Each band costs window_side_px - 1
// rows more than it has.
void CorrelateRows(const GrayImage& left, const GrayImage& right,
                   const StereoPipelineParams& params, int first_row, int end_row,
                   DisparityImage& out);

// Returns the name of the instruction set that the fast stages use on this machine, such as "AVX3":
// tests and benchmarks tell it.
const char* InstructionSet();

// The parameters of the filters in the units of scores.
struct PeakLimits {
  Interpolation interpolation;
  int line_of_sight;       // largest difference of the two disparities, px
  std::int32_t curvature;  // smallest c
  std::int32_t ratio_256;  // smallest 256 c / S(x, d_L)
};

// Limits of the curvature are rounded up to whole scores, that of the line of sight down to whole
// pixels.
PeakLimits MakePeakLimits(const StereoFilterParams& filters, const CorrelatorParams& correlator);

// Returns the sub-pixel part of a disparity in whole numbers. SubPixelOf (correlator_rows.cc) must
// give the same bits in vectors.
//
// With the scores s-, s0, s+ at the best disparity and its two neighbours and the curvature
// c = s- - 2 s0 + s+, the lowest point lies off the best disparity by
//   quadratic    delta = (s- - s+) / (2 c)                       the parabola through all three
//   equiangular  delta = (s- - s+) / (2 (max(s-, s+) - s0))      lines of slopes +m and -m
// where |delta| <= 1/2, as s- > s0 and s+ > s0 by the peak filter. Goldberg 2002 section 3
// ("Compute Sub-Pixel") says quadratic. Where images differ by a shift alone, sums of absolute
// differences near their lowest point are a pair of lines and no parabola: for a true offset t,
// s- - s+ = 2 t sum|g| and c = 2 sum|g| (1 - |t|) with g the gradient along the row, so that the
// parabola gives t / (2 (1 - |t|)), half of a small t, and the lines give t. The lines are the
// default.
//
// The result is 32 delta rounded to the nearest, halves upwards: with m = c or max(s-, s+) - s0,
// floor(32 delta + 1/2) = floor((32 (s- - s+) + 33 m) / (2 m)) - 16, whose numerator is positive.
constexpr int SubPixel(Interpolation interpolation, std::int32_t below, std::int32_t best,
                       std::int32_t above) {
  const std::int32_t steepness = interpolation == Interpolation::kQuadratic
                                     ? below - 2 * best + above
                                     : (below > above ? below : above) - best;
  return (kDisparityOne * (below - above) + (kDisparityOne + 1) * steepness) / (2 * steepness) -
         kDisparityOne / 2;
}

// Disparities of a group, which are compared at a time. Must stay 2^kKeyShift, as the low bits of a
// key hold the place in the group; ScoreGroup is written out for four.
constexpr int kGroup = 4;

// How the fast correlator lays a row of pixels into vectors.
//
// A vector of n lanes does not hold n neighbours: the row is cut into n segments of equal length,
// and lane i walks along segment i. Vector j holds the pixels x = i * segment + j, i = 0 ... n - 1.
// A shift by a disparity or along the window is then another j, an aligned load in all lanes, and a
// sliding sum goes along j with one addition and one subtraction whatever the window. Vectors of
// j < 0 or j >= segment are those of j + segment and j - segment moved by one lane. Lanes without
// a pixel (x < 0, x >= width) hold anything and are masked.
struct LaneLayout {
  LaneLayout(int lanes, int width, const CorrelatorParams& params);

  // Returns the offset of vector j in the wide arrays, which reach as far as disparities do: j in
  // [first, last].
  std::ptrdiff_t Wide(int j) const { return static_cast<std::ptrdiff_t>(j - first) * lanes; }
  std::size_t wide_size() const {
    return static_cast<std::size_t>(last - first + 1) * lane_count();
  }
  std::size_t row_size() const { return static_cast<std::size_t>(segment) * lane_count(); }
  std::size_t lane_count() const { return static_cast<std::size_t>(lanes); }

  // Returns whether the window of pixel x, from x - before to x + after, lies in the image.
  bool WindowInside(int x) const { return x >= before && x + after < width; }

  int lanes;          // of 16 bits
  int width;          // of the image, px
  int segment;        // pixels a lane, a multiple of 4: rows are laid four pixels at a time
  int before, after;  // side = before + 1 + after
  int min_disparity;  // px
  int disparities;    // in the range
  int groups;         // of kGroup disparities; the last one may be in part beyond the range
  int first, last;    // vectors of right pixels: -(largest disparity) ... segment - 1 - smallest
};

// The key of masked pairs of pixels. No candidate has it, which ScoresFit (stereo_params.h) makes
// sure of.
constexpr std::uint16_t kNoKey = 0xFFFF;
constexpr int kKeyShift = 2;

// What the fast correlator keeps from row to row of an image. The functions below it are the inner
// loops, compiled for every instruction set and chosen at run time; each works on one row.
//
// Words of 16 bits are in the order of LaneLayout. Pixel values are stored times four, so that the
// two low bits of a sum are free for a disparity's place in its group. Such a sum with its place is
// a key: the smaller key is the better match, or of equal scores in a group the one at the smaller
// disparity. The scores take 2 bytes a pixel of a row and disparity.
struct CorrelatorState {
  using Words = AlignedBuffer<std::uint16_t>;

  CorrelatorState(int lanes, int width, const CorrelatorParams& params);

  // Returns how many rows are kept: the window's and the one that leaves it. The slot behind them
  // stays zero.
  int slots() const { return layout.before + layout.after + 2; }
  int zero_slot() const { return slots(); }
  std::uint16_t* Left(int slot) { return left_rows.data() + layout.row_size() * Size(slot); }
  std::uint16_t* Right(int slot) { return right_rows.data() + layout.wide_size() * Size(slot); }

  // Return vector j = 0 of the scores of a disparity, and of the changes of a place in the group.
  // There is room for one disparity more on either side: DecideRow reads the scores there before it
  // drops the ends of the range.
  std::uint16_t* Scores(int disparity_index) {
    return scores.data() + layout.row_size() * Size(disparity_index + 1);
  }
  std::uint16_t* Changes(int place) {
    return changes.data() + change_stride * Size(place) +
           Size(layout.before + 1) * layout.lane_count();
  }

  static std::size_t Size(int n) { return static_cast<std::size_t>(n); }

  LaneLayout layout;
  std::size_t change_stride;           // words from one disparity of a group to the next
  Words left_rows, right_rows;         // pixels
  Words changes;                       // of a column's sum, from one row to the next
  Words scores;                        // keys without masks, at the current row
  Words left_key, left_group;          // the best of each left pixel so far
  Words right_key, right_group;        // the best of each right pixel so far
  Words right_index;                   // the best disparity of each right pixel, less the smallest
  Words left_mask, right_mask;         // kNoKey where the window reaches over the edge, else 0
  AlignedBuffer<std::int16_t> result;  // disparities of the current row
  AlignedBuffer<std::uint8_t> pixels;  // a row as it is in the image, zero behind
  AlignedBuffer<std::int16_t> row;     // the result in the order of the image
};

// Returns how many lanes of 16 bits the vectors of the instruction set in use have.
int VectorLanes();

// Lays a row of both images into a slot of the state.
void LoadRow(std::span<const std::uint8_t> left, std::span<const std::uint8_t> right, int slot,
             CorrelatorState& state);

// Moves the scores down by a row: adds the differences of slot_in, takes off those of slot_out.
void SlideRow(int slot_in, int slot_out, CorrelatorState& state);

// Does what SlideRow does, and finds the best match of each pixel of either image.
void ScoreRow(int slot_in, int slot_out, CorrelatorState& state);

// Brings together what right pixels found in vectors of different j, and writes right_index. Must
// run between ScoreRow and DecideRow.
void GatherRightBest(CorrelatorState& state);

// Checks and interpolates the best matches, and writes them to `row` in the order of pixels.
void DecideRow(const PeakLimits& limits, CorrelatorState& state);

}  // namespace rockyard::vision
