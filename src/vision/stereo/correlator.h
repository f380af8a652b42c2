// The 1-D correlator with its checks (Goldberg 2002 section 2, stages 4 and 5), row by row.
//
// For every pixel (x, y) of the left image and every disparity d of the range the score is the sum
// of absolute differences over the window, of side n, from n / 2 pixels before the pixel (rounded
// down) to n - 1 - n / 2 behind it, in both directions:
//   S(x, d) = sum over the window of |L(x + i, y + k) - R(x + i - d, y + k)|,
// small for a good match; a candidate is a pair of pixels whose windows both lie in their images.
//   left:   d_L(x) = the d of the smallest S(x, d), the smallest such d where several are equal
//   right:  d_R(x) = the same of S(x + d, d): both come out of one pass over the scores
//   line of sight: |d_L(x) - d_R(x - d_L(x))| <= 1 px (a parameter)
//   peak filter:   S(x, d_L - 1) and S(x, d_L + 1) exist and are larger than S(x, d_L); the
//                  curvature c = S(x, d_L - 1) - 2 S(x, d_L) + S(x, d_L + 1) is at least side^2
//                  times a parameter, and at least S(x, d_L) times another
//   sub-pixel:     the lowest point of a parabola through the three, or of two lines (SubPixel)
//
// Sums slide in both directions: a score gains the row that comes and loses the one that goes, and
// what it gains or loses in a row slides along the row, so that the time does not depend on the
// window.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "vision/image.h"
#include "vision/stereo/aligned_buffer.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::vision {

// Writes the disparities of rows first_row ... end_row - 1 of the left image; others stay as they
// are, and bands of rows may be written at the same time. `left` and `right`
// (DifferenceOfGaussians) and `out` are of one size, the parameters accepted by
// StereoPipelineParams::Visit, and values of images at most 2 params.dog.limit. Each band costs as
// much as window_side_px - 1 rows on top.
void CorrelateRows(const GrayImage& left, const GrayImage& right,
                   const StereoPipelineParams& params, int first_row, int end_row,
                   DisparityImage& out);

// Returns the name of the instruction set that the fast stages use on this machine, as in "AVX3".
const char* InstructionSet();

// What the fast correlator keeps from row to row of an image (rows as vectors, sums, scores,
// minima) and its inner loops, compiled for every instruction set and chosen at run time. Each of
// them does one row. Definitions of what they compute stand above.
//
// 16-bit words are in the order of LaneLayout. Pixel values are stored four times as large, so that
// sums leave their two low bits to a disparity's place in its group: such a sum is a key, and the
// smaller key is the better match, or the one at the smaller disparity of two in a group that match
// as well. The cost in memory is about 4 bytes a pixel of a row and disparity.

// The parameters of the filters in the units of scores.
struct PeakLimits {
  Interpolation interpolation;
  int line_of_sight;       // largest difference of the two disparities, px
  std::int32_t curvature;  // smallest c
  std::int32_t ratio_256;  // smallest 256 c / s0
};

// side^2 pixels contribute to a score; limits are rounded up to whole scores.
PeakLimits MakePeakLimits(const StereoFilterParams& filters, const CorrelatorParams& correlator);

// Sub-pixel interpolation of one pixel in whole numbers.
//
// With the scores s-, s0, s+ at the best disparity and its two neighbours (sums of absolute
// differences: smaller is better), curvature c = s- - 2 s0 + s+, the lowest point lies off the best
// disparity by
//   quadratic    delta = (s- - s+) / (2 c)                       the parabola through all three
//   equiangular  delta = (s- - s+) / (2 (max(s-, s+) - s0))      lines of slopes +m and -m
// where |delta| <= 1/2, as s- > s0 and s+ > s0 by the peak filter. Goldberg 2002 section 3
// ("Compute Sub-Pixel") says quadratic. Near its lowest point a sum of absolute differences of
// images that fit but for their place is a pair of lines and no parabola: of a true offset t, s- -
// s+ = 2 t sum|g| and c = 2 sum|g| (1 - |t|) with g the gradient along the row, so that the
// parabola says t / (2 (1 - |t|)), half of a small t, and the lines say t. They are the default.
//
// Returns 32 delta rounded to the nearest, halves upwards, floor(32 delta + 1/2), with m = c or
// max(s-, s+) - s0: floor((32 (s- - s+) + 33 m) / (2 m)) - 16, whose numerator is positive.
constexpr int SubPixel(Interpolation interpolation, std::int32_t below, std::int32_t best,
                       std::int32_t above) {
  const std::int32_t steepness = interpolation == Interpolation::kQuadratic
                                     ? below - 2 * best + above
                                     : (below > above ? below : above) - best;
  return (kDisparityOne * (below - above) + (kDisparityOne + 1) * steepness) / (2 * steepness) -
         kDisparityOne / 2;
}

// Disparities that are compared at a time: the two low bits of a key are the place among them, and
// ScoreGroup is written out for four.
constexpr int kGroup = 4;

// How the fast correlator lays a row of pixels into vectors.
//
// A vector of n lanes does not hold n neighbours: the row is cut into n segments of equal length,
// and lane i walks along segment i. Vector j holds the pixels x = i * segment + j, i = 0 ... n - 1.
// A shift by a disparity or along the window is then another j, an aligned load in all lanes, and a
// sliding sum goes along j with one addition and one subtraction whatever the window. Vectors of
// j < 0 or j >= segment are those of j + segment and j - segment moved by one lane; what has no
// pixel there (x < 0, x >= width) holds anything and is masked.
struct LaneLayout {
  LaneLayout(int lanes, int width, const CorrelatorParams& params);

  // Offset of vector j of the arrays that reach as far as disparities do: j in [first, last].
  std::ptrdiff_t Wide(int j) const { return static_cast<std::ptrdiff_t>(j - first) * lanes; }
  std::size_t wide_size() const {
    return static_cast<std::size_t>(last - first + 1) * lane_count();
  }
  std::size_t row_size() const { return static_cast<std::size_t>(segment) * lane_count(); }
  std::size_t lane_count() const { return static_cast<std::size_t>(lanes); }

  // The window of pixel x reaches from x - before to x + after and lies in the image.
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

// A key that no candidate has (ScoresFit): the masked ones.
constexpr std::uint16_t kNoKey = 0xFFFF;
constexpr int kKeyShift = 2;

struct CorrelatorState {
  using Words = AlignedBuffer<std::uint16_t>;

  CorrelatorState(int lanes, int width, const CorrelatorParams& params);

  // Rows of the window and the one that leaves it; the slot behind these stays zero.
  int slots() const { return layout.before + layout.after + 2; }
  int zero_slot() const { return slots(); }
  std::uint16_t* Left(int slot) { return left_rows.data() + layout.row_size() * Size(slot); }
  std::uint16_t* Right(int slot) { return right_rows.data() + layout.wide_size() * Size(slot); }

  // Vector j = 0 of the sums of a disparity, of the changes of one of a group. Sums of one
  // disparity more on either side are there: DecideRow reads them before it drops the ends of the
  // range.
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
  Words changes;                       // by the row that comes and the one that goes, of a column
  Words scores;                        // keys without masks, at the current row
  Words left_key, left_group;          // the best of each left pixel so far
  Words right_key, right_group;        // the best of each right pixel so far
  Words right_index;                   // disparity of the latter, from the smallest one
  Words left_mask, right_mask;         // kNoKey where the window reaches over the edge, else 0
  AlignedBuffer<std::int16_t> result;  // disparities of the current row
  AlignedBuffer<std::uint8_t> pixels;  // a row as it is in the image, zero behind
  AlignedBuffer<std::int16_t> row;     // the result in the order of the image
};

// Lanes of 16 bits of the vectors of the instruction set that is in use.
int VectorLanes();

// Lays a row of both images into a slot of the state.
void LoadRow(std::span<const std::uint8_t> left, std::span<const std::uint8_t> right, int slot,
             CorrelatorState& state);

// Moves the scores down by a row: the differences of one slot come, those of the other go.
void SlideRow(int slot_in, int slot_out, CorrelatorState& state);

// As SlideRow, then the best of either image.
void ScoreRow(int slot_in, int slot_out, CorrelatorState& state);

// Brings together what right pixels found in vectors of different j, and writes right_index.
void GatherRightBest(CorrelatorState& state);

// Checks and sub-pixel interpolation: from the best of either image to `row`, in the order of
// pixels.
void DecideRow(const PeakLimits& limits, CorrelatorState& state);

}  // namespace rockyard::vision
