// Rectification by a table (Goldberg 2002 section 2 stage 2): images are resampled so that what
// lies in a row of the left image lies in the same row of the right image. The eyes of a rover and
// the commands that match pairs build tables from camera models (SourceOf, cameras/rectification.h)
// or from a correction of rows (row_alignment.h). No record depends on it so far: the calibrated
// eyes of rockyard's rovers are aligned as they stand (AlignedPair) and get no table.
//
// The table goes from output to input ("random in, linear out"): for each output pixel the place of
// four input pixels and the share of each. Positions are kept to 1/256 px: with the fractions
// fx, fy in 0 ... 256 (of 256)
//   value = floor((top (256 - fy) + bottom fy + 2^15) / 2^16),
//   top = p00 (256 - fx) + p10 fx,  bottom = p01 (256 - fx) + p11 fx,
// the bilinear mean rounded to the nearest, halves upwards. The four shares add up to 2^16, so that
// a pixel is 255 where all four of its input pixels are: masks of 0 and 255 are resampled by that.
#pragma once

#include <cstdint>

#include "vision/image.h"

namespace rockyard::vision {

// A place in an image: (0, 0) is the centre of its upper left pixel.
struct SourcePosition {
  double x_px = 0.0;
  double y_px = 0.0;

  bool operator==(const SourcePosition&) const = default;
};

// Where an output pixel comes from.
struct RectificationEntry {
  static constexpr std::int32_t kOutside = -1;

  std::int32_t upper_left = kOutside;  // index of p00 among all pixels of the source, or kOutside
  std::uint16_t fx = 0;                // 256ths of a pixel
  std::uint16_t fy = 0;

  bool operator==(const RectificationEntry&) const = default;
};

class RectificationTable {
 public:
  // Source images have the given size, at least 2 x 2. An output pixel is outside where its
  // position is beyond the centres of the source's outermost pixels, or is no number.
  RectificationTable(const Image<SourcePosition>& positions, int source_width, int source_height);

  int source_width() const { return source_width_; }
  int source_height() const { return source_height_; }
  const Image<RectificationEntry>& entries() const { return entries_; }

  // Returns the output image, 0 where the source does not reach. `source` is of the table's size.
  // Bands of rows may be written at the same time by RectifyRows.
  GrayImage Rectify(const GrayImage& source) const;
  void RectifyRows(const GrayImage& source, int first_row, int end_row, GrayImage& out) const;

  // Returns a mask for DropOutside (disparity.h): 1 where the source reaches, 0 elsewhere.
  Image<std::uint8_t> Inside() const;

 private:
  int source_width_;
  int source_height_;
  Image<RectificationEntry> entries_;
};

}  // namespace rockyard::vision
