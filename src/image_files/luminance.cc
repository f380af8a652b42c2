// What raw_image.h declares: the conversion to grey, the refusals and the check of sizes.
#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "core/check.h"
#include "core/error.h"
#include "image_files/raw_image.h"

namespace rockyard::image_files {
namespace {

constexpr std::int64_t kUnit = 1000;  // the weights of BT.601 are thousandths

// Returns the luminance of a pixel, in thousandths of a sample.
std::int64_t Luminance(const RawImage& image, int x, int y) {
  if (!image.is_colour()) return kUnit * image.planes[0].At(x, y);
  return std::int64_t{299} * image.planes[0].At(x, y) +
         std::int64_t{587} * image.planes[1].At(x, y) +
         std::int64_t{114} * image.planes[2].At(x, y);
}

std::string Describe(const RawImage& image, const GrayOptions& options,
                     const GrayConversion& done) {
  std::string text = image.is_colour() ? "luminance of colour (ITU-R BT.601)" : "grey";
  if (done.white == 255) {
    text += image.bits == 8 ? " of 8 bits" : fmt::format(" of {} bits, not scaled", image.bits);
  } else {
    text += fmt::format(" of {} bits, scaled by 255 / {} ({})", image.bits, done.white,
                        options.white ? "as asked for" : image.full_scale_from);
  }
  if (done.clipped > 0) text += fmt::format(", {} pixels brighter than white", done.clipped);
  if (image.not_opaque > 0) {
    text += fmt::format(", transparency of {} pixels not heeded", image.not_opaque);
  }
  if (image.negative > 0) text += fmt::format(", {} negative samples as 0", image.negative);
  return text;
}

std::string Advice(const RawImage& image, std::int64_t brightest, const GrayOptions& options) {
  constexpr std::int64_t kPart = 8;
  const bool dark = brightest > 0 && kPart * brightest <= image.full_scale;
  if (options.white || image.bits <= 8 || !dark) return "";
  return fmt::format("the brightest sample is {} of {}: --white {} would keep more of the image",
                     brightest, image.full_scale,
                     std::bit_ceil(static_cast<std::uint64_t>(brightest) + 1) - 1);
}

}  // namespace

GrayConversion ToGray(const RawImage& image, const GrayOptions& options) {
  EXPECT(image.planes.size() == 1 || image.planes.size() == 3);
  GrayConversion done;
  done.white = options.white.value_or(image.full_scale);
  EXPECT(done.white >= 1 && done.white <= 65535);
  const std::int64_t white = kUnit * done.white;
  done.image = vision::GrayImage(image.width(), image.height());
  std::int64_t brightest = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const std::int64_t luminance = Luminance(image, x, y);
      brightest = std::max(brightest, luminance);
      if (luminance > white) ++done.clipped;
      // `white` is even, as kUnit is, so that its half is exact.
      const std::int64_t gray = (255 * std::min(luminance, white) + white / 2) / white;
      done.image.At(x, y) = static_cast<std::uint8_t>(gray);
    }
  }
  done.what_was_done = Describe(image, options, done);
  done.advice = Advice(image, brightest / kUnit, options);
  return done;
}

void FailDamaged(const std::string& name, std::string_view reason) {
  throw core::UserError(name, fmt::format("is damaged: {}", reason),
                        "copy it again, or make it anew from its source");
}

void FailTruncated(const std::string& name) {
  throw core::UserError(name, "ends before its last pixel",
                        "copy it again: only a part of the file is here");
}

void FailUnsupported(const std::string& name, const std::string& reason,
                     const std::string& suggestion) {
  throw core::UserError(name, reason, suggestion);
}

void CheckSize(const std::string& name, std::int64_t width, std::int64_t height,
               const ImageLimits& limits) {
  if (width < 1 || height < 1) {
    FailDamaged(name, fmt::format("an image of {} x {} pixels has none", width, height));
  }
  const bool too_long = width > limits.max_side || height > limits.max_side;
  if (too_long || width * height > limits.max_pixels) {
    FailUnsupported(
        name,
        fmt::format("has {} x {} pixels, more than the {} a side and {} in all that are read",
                    width, height, limits.max_side, limits.max_pixels),
        "check that this is the right file, and cut out or reduce what is needed");
  }
}

}  // namespace rockyard::image_files
