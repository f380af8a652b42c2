// PNG files put together by hand and read back sample by sample; PNG, PFM and PLY files written,
// held against their specifications byte by byte.
#include <gmock/gmock.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/numbers.h"
#include "image_files/float_files.h"
#include "image_files/png_bytes.h"
#include "image_files/png_file.h"
#include "image_files/refusals.h"

namespace rockyard::image_files {
namespace {

using namespace std::string_literals;

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

// PNG files that are put together by hand, read back sample by sample.

RawImage Read(const std::string& bytes) { return DecodePng(bytes, "a.png", {}); }

core::Problem Refusal(const std::string& bytes, const ImageLimits& limits = {}) {
  return RefusalOf([&] { DecodePng(bytes, "a.png", limits); });
}

// Samples that differ from their neighbours in both bytes.
PngText Pattern(int width, int height, int bits, PngColour colour, bool interlaced) {
  PngText png{width, height, bits, colour, interlaced, {}, ""};
  const std::size_t count =
      static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * ChannelsOf(colour);
  for (std::size_t i = 0; i < count; ++i) {
    png.samples.push_back(static_cast<unsigned>(i * 40503 + 7) & ((1U << bits) - 1));
  }
  return png;
}

// Sample of a channel as the file has it; fewer than 8 bits are brought to 8 by repetition, which
// for 1, 2 and 4 bits is 255 / (2^bits - 1) times the sample (section 13.12).
unsigned Expected(const PngText& png, int x, int y, std::size_t channel) {
  const std::size_t at =
      static_cast<std::size_t>(y * png.width + x) * ChannelsOf(png.colour) + channel;
  const unsigned scale = png.bits < 8 ? 255 / ((1U << png.bits) - 1) : 1;
  return png.samples[at] * scale;
}

void ExpectSamples(const PngText& png) {
  const RawImage image = Read(PngBytes(png));
  const bool colour = png.colour == PngColour::kRgb || png.colour == PngColour::kRgba;
  ASSERT_EQ(image.planes.size(), colour ? 3U : 1U);
  ASSERT_EQ(image.width(), png.width);
  ASSERT_EQ(image.height(), png.height);
  EXPECT_EQ(image.bits, std::max(8, png.bits));
  EXPECT_EQ(image.full_scale, png.bits == 16 ? 65535 : 255);
  for (int y = 0; y < png.height; ++y) {
    for (int x = 0; x < png.width; ++x) {
      for (std::size_t channel = 0; channel < image.planes.size(); ++channel) {
        ASSERT_EQ(image.planes[channel].At(x, y), Expected(png, x, y, channel))
            << x << ", " << y << ", channel " << channel;
      }
    }
  }
}

TEST(PngReader, EveryDepthColourAndOrder) {
  for (const bool interlaced : {false, true}) {
    for (const int bits : {1, 2, 4, 8, 16}) {
      SCOPED_TRACE(testing::Message() << bits << " bits, interlaced " << interlaced);
      ExpectSamples(Pattern(13, 11, bits, PngColour::kGrey, interlaced));
    }
    for (const int bits : {8, 16}) {
      for (const PngColour colour : {PngColour::kGreyAlpha, PngColour::kRgb, PngColour::kRgba}) {
        SCOPED_TRACE(testing::Message() << bits << " bits, colour " << static_cast<int>(colour)
                                        << ", interlaced " << interlaced);
        ExpectSamples(Pattern(9, 10, bits, colour, interlaced));
      }
    }
    ExpectSamples(Pattern(1, 1, 8, PngColour::kRgb, interlaced));
    ExpectSamples(Pattern(1, 5, 16, PngColour::kGrey, interlaced));
  }
}

TEST(PngReader, PalettesBecomeColours) {
  PngText png{3, 1, 2, PngColour::kPalette, false, {2, 0, 1}, ""};
  png.before_data = PngChunk("PLTE", {10, 20, 30, 40, 50, 60, 70, 80, 90});
  const RawImage image = Read(PngBytes(png));
  ASSERT_EQ(image.planes.size(), 3U);
  EXPECT_THAT(image.planes[0].values(), ElementsAre(70, 10, 40));
  EXPECT_THAT(image.planes[1].values(), ElementsAre(80, 20, 50));
  EXPECT_THAT(image.planes[2].values(), ElementsAre(90, 30, 60));
  EXPECT_FALSE(image.had_alpha);
}

TEST(PngReader, CountsPixelsThatAreNotOpaque) {
  PngText png{2, 2, 8, PngColour::kGreyAlpha, false, {1, 255, 2, 254, 3, 0, 4, 255}, ""};
  const RawImage image = Read(PngBytes(png));
  EXPECT_TRUE(image.had_alpha);
  EXPECT_EQ(image.not_opaque, 2);
  EXPECT_THAT(image.planes[0].values(), ElementsAre(1, 2, 3, 4));
  // A transparent colour is another way to say so.
  PngText keyed{2, 1, 8, PngColour::kGrey, false, {7, 8}, PngChunk("tRNS", {'\0', '\7'})};
  EXPECT_EQ(Read(PngBytes(keyed)).not_opaque, 1);
  EXPECT_EQ(Read(PngBytes(Pattern(3, 3, 8, PngColour::kRgb, false))).not_opaque, 0);
}

// Wherever it is cut off, also behind the last pixel: only the end of the file says that it is
// whole.
TEST(PngReader, CutOffAnywhereIsRefused) {
  for (const bool interlaced : {false, true}) {
    const std::string bytes = PngBytes(Pattern(6, 7, 8, PngColour::kRgb, interlaced));
    for (std::size_t length = 8; length < bytes.size(); ++length) {
      ASSERT_EQ(Refusal(bytes.substr(0, length)).reason, "ends before its last pixel") << length;
    }
  }
}

TEST(PngReader, EveryDamagedByteOfAChunkIsSeen) {
  PngText png = Pattern(4, 4, 8, PngColour::kGrey, false);
  png.before_data = PngChunk("tEXt", "Comment\1nothing") + PngChunk("gAMA", BigEndian(45455));
  const std::string bytes = PngBytes(png);
  ASSERT_EQ(Read(bytes).width(), 4);
  for (std::size_t at = 8; at < bytes.size(); ++at) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    ASSERT_EQ(Refusal(damaged).path, "a.png");
  }
  std::string checksum = bytes;
  checksum[8 + 8 + 13] = static_cast<char>(checksum[8 + 8 + 13] ^ 1);
  EXPECT_THAT(Refusal(checksum).reason, StartsWith("is damaged: IHDR: CRC error"));
}

// What stands beside the pixels is passed over: a gamma of no bytes, whose checksum is right.
TEST(PngReader, ChunksBesideThePixelsAreNotHeeded) {
  PngText png = Pattern(4, 4, 8, PngColour::kGrey, false);
  png.before_data = PngChunk("gAMA", "") + PngChunk("zTXt", "no zero byte");
  ExpectSamples(png);
}

// The checksum of the pixels themselves is right, and the stream in it is short or long.
TEST(PngReader, PixelsThatDoNotFitTheSizeAreRefused) {
  PngText png = Pattern(4, 4, 8, PngColour::kGrey, false);
  const std::string rows = PngRows(png);
  const auto with = [&](const std::string& data) {
    return PngHeader(png) + PngChunk("IDAT", ZlibStored(data)) + PngChunk("IEND", "");
  };
  EXPECT_EQ(Read(with(rows)).width(), 4);
  EXPECT_THAT(Refusal(with(rows.substr(0, rows.size() - 1))).reason, StartsWith("is damaged"));
  EXPECT_THAT(Refusal(with(rows + "x")).reason, StartsWith("is damaged"));
  EXPECT_THAT(Refusal(with("\x09" + rows.substr(1))).reason, HasSubstr("filter"));
}

TEST(PngReader, SizesAreCheckedBeforeMemoryIsTaken) {
  PngText png{0, 4, 8, PngColour::kGrey, false, {}, ""};
  EXPECT_THAT(Refusal(PngBytes(png)).reason, StartsWith("is damaged"));
  png = {16385, 1, 8, PngColour::kGrey, false, std::vector<unsigned>(16385), ""};
  EXPECT_THAT(Refusal(PngBytes(png)).reason,
              HasSubstr("has 16385 x 1 pixels, more than the 16384"));
  png.width = 2'000'000;
  EXPECT_THAT(Refusal(PngHeader(png) + PngChunk("IDAT", "")).reason,
              HasSubstr("2000000 x 1 pixels"));
  png.width = 16384;
  EXPECT_EQ(Read(PngBytes(png)).width(), 16384);
  png = Pattern(5, 4, 8, PngColour::kGrey, false);
  EXPECT_THAT(Refusal(PngBytes(png), {.max_side = 5, .max_pixels = 19}).reason,
              HasSubstr("5 x 4 pixels"));
  EXPECT_EQ(DecodePng(PngBytes(png), "", {.max_side = 5, .max_pixels = 20}).height(), 4);
}

// Deflate makes no more than 1032 bytes of one: what claims more is short, whatever comes.
TEST(PngReader, AShortFileOfALargeImageIsRefusedByItsHeader) {
  PngText png{8000, 8000, 16, PngColour::kRgba, true, {}, ""};
  EXPECT_EQ(
      Refusal(PngHeader(png) + PngChunk("IDAT", ZlibStored("x")) + PngChunk("IEND", "")).reason,
      "ends before its last pixel");
}

// PNG, PFM and PLY files, held against their specifications byte by byte.

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
  EXPECT_EQ(Decoded(EncodePng(picture)), picture);
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
