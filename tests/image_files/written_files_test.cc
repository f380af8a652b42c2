// PNG, PFM and PLY files, held against their specifications byte by byte.
#include <gmock/gmock.h>
#include <png.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/numbers.h"
#include "image_files/float_files.h"
#include "image_files/png_file.h"
#include "image_files/refusals.h"

namespace rockyard::image_files {
namespace {

using namespace std::string_literals;

using testing::HasSubstr;

// As another program reads it, by libpng's own interface for the hasty.
Picture Decoded(const std::string& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&image, file.data(), file.size()), 0) << image.message;
  image.format = PNG_FORMAT_RGB;
  Picture picture(static_cast<int>(image.width), static_cast<int>(image.height));
  EXPECT_NE(png_image_finish_read(&image, nullptr, &picture.At(0, 0), 0, nullptr), 0);
  return picture;
}

TEST(PngWriter, ColoursReadBackPixelByPixel) {
  Picture picture(7, 3);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 7; ++column) {
      picture.At(column, row) = {static_cast<std::uint8_t>(10 * column),
                                 static_cast<std::uint8_t>(20 * row), 255};
    }
  }
  const Picture read = Decoded(EncodePng(picture));
  EXPECT_EQ(read, picture);
}

TEST(PngWriter, GreyReadsBackInItsDepth) {
  vision::GrayImage grey(5, 2);
  SamplePlane deep(5, 2);
  for (int i = 0; i < 10; ++i) {
    grey.At(i % 5, i / 5) = static_cast<std::uint8_t>(25 * i);
    deep.At(i % 5, i / 5) = static_cast<std::uint16_t>(6500 * i + 3);
  }
  // Bits a sample and colour type stand at bytes 24 and 25 (PNG, section 11.2.2).
  const std::string of_8_bits = EncodePng(grey);
  EXPECT_EQ(of_8_bits.substr(24, 2), "\x08\0"s);
  for (int i = 0; i < 10; ++i) {
    const auto value = static_cast<std::uint8_t>(25 * i);
    EXPECT_EQ(Decoded(of_8_bits).At(i % 5, i / 5), (Rgb{value, value, value}));
  }
  const std::string of_16_bits = EncodePng(deep);
  EXPECT_EQ(of_16_bits.substr(24, 2), "\x10\0"s);
  EXPECT_EQ(DecodePng(of_16_bits, "", {}).planes[0], deep);
}

// Two pixels wide, two high: the lower row comes first.
TEST(PfmFile, BytesOfASmallImage) {
  vision::Image<float> image(2, 2);
  image.At(0, 0) = 1.0F;
  image.At(1, 0) = -2.0F;
  image.At(0, 1) = 0.5F;
  image.At(1, 1) = std::numeric_limits<float>::quiet_NaN();
  const std::string head = "Pf\n2 2\n-1.0\n";
  const std::string little = "\0\0\0\x3f\0\0\x80\x7f\0\0\x80\x3f\0\0\0\xc0"s;  // .5, inf, 1, -2
  EXPECT_EQ(EncodePfm(image), head + little);
  image.At(1, 1) = -std::numeric_limits<float>::infinity();
  EXPECT_EQ(EncodePfm(image), head + little);
  const std::string big = "Pf 2 2 0.25 \x3f\0\0\0\x7f\x80\0\0\x3f\x80\0\0\xc0\0\0\0"s;
  for (const std::string& file : {head + little, big}) {
    const vision::Image<float> read = DecodePfm(file, "a.pfm", {});
    EXPECT_EQ(read.At(0, 0), 1.0F);
    EXPECT_EQ(read.At(1, 0), -2.0F);
    EXPECT_EQ(read.At(0, 1), 0.5F);
    EXPECT_TRUE(std::isnan(read.At(1, 1)));
  }
}

TEST(PfmFile, WhatIsWrongIsSaid) {
  const auto reason = [](const std::string& bytes, const ImageLimits& limits = {}) {
    return RefusalOf([&] { DecodePfm(bytes, "a.pfm", limits); }).reason;
  };
  const std::string ends = "ends before its last pixel";
  EXPECT_EQ(reason("Pf 1 1 -1\nabc"), ends);
  EXPECT_EQ(reason("Pf 1 1 -1"), ends);
  EXPECT_EQ(reason("Pf 1 "), ends);
  EXPECT_EQ(reason("Pf 8000 8000 -1\nabcd"), ends);
  EXPECT_THAT(reason("Pf 1 1 -1\nabcde"), HasSubstr("goes on"));
  EXPECT_THAT(reason("PF 1 1 -1\nabcdabcdabcd"), HasSubstr("three channels"));
  EXPECT_THAT(reason("Pf 1 1 0\nabcd"), HasSubstr("scale"));
  EXPECT_THAT(reason("Pf 1 1 nan\nabcd"), HasSubstr("scale"));
  EXPECT_THAT(reason("Pf 1 1 -1x\nabcd"), HasSubstr("scale"));
  EXPECT_THAT(reason("Pf 0 1 -1\n"), HasSubstr("0 x 1 pixels"));
  EXPECT_THAT(reason("Pf 3 2 -1\n", {.max_side = 2}), HasSubstr("3 x 2 pixels"));
}

TEST(PlyFile, HeaderCountAndBytes) {
  const std::vector<ColouredPoint> points{
      {{1.0, -2.0, 0.5}, {10, 20, 30}},
      {{core::kNaN, 0.0, 0.0}, {1, 1, 1}},
      {{0.0, core::kInfinity, 0.0}, {1, 1, 1}},
      {{0.0, 0.0, 1e39}, {1, 1, 1}},  // beyond the largest float
      {{4.0, 0.0, 0.0}, {255, 0, 128}}};
  const std::string head =
      "ply\nformat binary_little_endian 1.0\ncomment frame R, metres\nelement vertex 2\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
  const std::string body =
      "\0\0\x80\x3f\0\0\0\xc0\0\0\0\x3f\x0a\x14\x1e"s
      "\0\0\x80\x40\0\0\0\0\0\0\0\0\xff\0\x80"s;
  EXPECT_EQ(EncodePly(points, "frame R, metres"), head + body);
  EXPECT_THAT(EncodePly({}, "none"), HasSubstr("element vertex 0\n"));
}

}  // namespace
}  // namespace rockyard::image_files
