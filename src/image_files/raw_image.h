// What an image file holds before anything is made of it; how one that cannot be read is refused;
// and its samples as 8 bits of grey, which stereo, calibration and visual odometry take. Every
// reader of this folder makes a RawImage. No record depends on it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vision/image.h"

namespace rockyard::image_files {

// How large an image may be: checked against what the header of a file says, before memory is taken
// for pixels.
struct ImageLimits {
  int max_side = 16384;
  std::int64_t max_pixels = std::int64_t{1} << 26;  // 67 million: 400 MB of three colours
};

// The largest file that is read. No image within ImageLimits as they stand needs more: P3 with 16
// bits has up to 6 characters a sample.
inline constexpr std::size_t kMaxFileBytes = std::size_t{1} << 31;

using Rgb = vision::Rgb;
using Picture = vision::ColourImage;
using SamplePlane = vision::Image<std::uint16_t>;

// Samples as the file has them, in the coding of the file (gamma and all): nothing is scaled but
// grey of fewer than 8 bits in PNG files, which is brought to 8.
struct RawImage {
  std::string format;               // "PNG"
  std::vector<SamplePlane> planes;  // one of grey, or red, green and blue; of equal size, not empty
  int bits = 8;                     // of a sample: 1 to 16
  int full_scale = 255;             // the sample that stands for white: 1 to 65535
  std::string full_scale_from;      // what says so: "8 bits of the format"

  // What was left out.
  bool had_alpha = false;
  std::int64_t not_opaque = 0;  // pixels of less than full alpha; they are read as if they had it
  std::int64_t negative = 0;    // samples below zero, which are read as 0

  int width() const { return planes.front().width(); }
  int height() const { return planes.front().height(); }
  bool is_colour() const { return planes.size() == 3; }
};

// Throws core::UserError: the pixels of the file `name` cannot be trusted. `reason` continues "is
// damaged: ".
[[noreturn]] void FailDamaged(const std::string& name, std::string_view reason);

// Throws core::UserError: some of the file `name` is missing.
[[noreturn]] void FailTruncated(const std::string& name);

// Throws core::UserError: the file `name` is in order, but this program does not read it. `reason`
// is a predicate: "is in CMYK".
[[noreturn]] void FailUnsupported(const std::string& name, const std::string& reason,
                                  const std::string& suggestion);

// Throws core::UserError where a side is below 1, or the image of the file `name` is beyond the
// limits.
void CheckSize(const std::string& name, std::int64_t width, std::int64_t height,
               const ImageLimits& limits);

struct GrayOptions {
  // The sample that becomes 255: 1 to 65535. Without it the full scale of the file.
  std::optional<int> white;
};

struct GrayConversion {
  vision::GrayImage image;
  int white = 255;            // the sample that became 255
  std::int64_t clipped = 0;   // pixels of a luminance above white, which became 255 too
  std::string what_was_done;  // in words: "luminance of colour (ITU-R BT.601); ..."
  // What an image of more than 8 bits gets if no white was asked for and all its samples lie in the
  // lowest eighth of the full scale, so that 8 bits keep little of them: in words, the white that
  // would keep more. Else empty.
  std::string advice;
};

// Returns the image in grey = round(255 min(Y, white) / white), halves up, with Y the grey sample
// itself, or of colour
//   Y = 0.299 R + 0.587 G + 0.114 B     (ITU-R BT.601-7, section 2.5.1)
// Must stay exact, in integers: 8-bit grey at full scale stays as it is. Red, green and blue are
// taken as they are coded, as BT.601 and the Y of JPEG files are defined; no gamma is undone.
GrayConversion ToGray(const RawImage& image, const GrayOptions& options = {});

}  // namespace rockyard::image_files
