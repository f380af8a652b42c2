// Difference of Gaussians (Goldberg 2002 section 2 stage 3), so that neither the brightness of an
// image nor its slow change matters to what the correlator compares. Row matches and the command's
// search for texture filter by it, too. Records of drives with stereo depend on every rounding of
// the filter that MatchStereo is given.
//
// Each Gaussian is a mean over few pixels; outside of the image the pixels of its edge repeat.
//   laplacian     means over a square of side n and over one of side m around the pixel, by sliding
//                 sums as in section 3, s and w:    difference = s / n^2 - w / m^2
//   row_gradient  means of three pixels that count 1, 2 and 1, down the column to the right and the
//                 one to the left, s and w:         difference = (s - w) / 4
//   value = clamp(round(gain difference), -limit, limit) + limit,
// an image of 8 bits with the offset `limit`. In whole numbers, halves rounded upwards:
//   round(...) = (s a - w b + 2^19) >> 20,  a = q m^2, b = q n^2, q = round(2^20 gain / (n m)^2),
// or a = b = round(2^20 gain / 4) for the row gradient. The difference is exactly 0 where the image
// is flat, however a and b are rounded.
//
// Only changes along the row tell disparities. Beside a depth edge a Laplacian carries the step of
// brightness, which belongs to the nearer surface, as far as its wide square reaches; the row
// gradient reaches one pixel. A gain above 1 with a low limit makes the sign of the difference
// count, as Nishihara 1984 ("Practical real-time imaging stereo matcher") matches the sign of a
// Laplacian: strong edges then count no more than fine texture.
#pragma once

#include <cstdint>

#include "vision/image.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::vision {

// Must fit the bounds in DogParams::Visit: sums of a square, up to 255 * 15^2, fit 16 bits, and
// products, some 255 * 4 * 2^20 at most, fit 32.
constexpr int kDogShift = 20;

// The Laplacian of Goldberg 2002, with the sides and the limit that were chosen on synthetic pairs:
// one step a grey level, by changes across rows as well as along them. Row matches and the search
// for texture of `rockyard stereo` take it, whatever filter a pair is matched with. Records do not
// depend on it.
inline constexpr DogParams kLaplacianDog{
    .kind = DogKind::kLaplacian, .narrow_side_px = 1, .wide_side_px = 11, .gain = 1.0, .limit = 36};

// The factors of the two sums, s and w.
struct DogWeights {
  std::int32_t first;   // a
  std::int32_t second;  // b
};

DogWeights MakeDogWeights(const DogParams& params);

// Writes rows first_row ... end_row - 1 of the filtered image; threads may write bands of rows at
// the same time. `out` has the size of `image` and is not `image`.
void DifferenceOfGaussiansRows(const GrayImage& image, const DogParams& params, int first_row,
                               int end_row, GrayImage& out);

GrayImage DifferenceOfGaussians(const GrayImage& image, const DogParams& params);

}  // namespace rockyard::vision
