// JPEG files of known colours: flat ones come back as they are, slopes within a level or two.
#include <gmock/gmock.h>

#include <array>
#include <cstdlib>
#include <string>

#include "image_files/jpeg_bytes.h"
#include "image_files/read_image.h"
#include "image_files/refusals.h"

namespace rockyard::image_files {
namespace {

using testing::Each;
using testing::ElementsAreArray;
using testing::HasSubstr;
using testing::StartsWith;

core::Problem Refusal(const std::string& bytes, const ImageLimits& limits = {}) {
  return RefusalOf([&] { DecodeJpeg(bytes, "a.jpg", limits); });
}

// A slope along x and y that no block of 8 x 8 cuts.
int Slope(int x, int y, int) { return 40 + 3 * x + 2 * y; }

void ExpectSlope(const RawImage& image) {
  ASSERT_EQ(image.planes.size(), 1U);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      ASSERT_LE(std::abs(image.planes[0].At(x, y) - Slope(x, y, 0)), 2) << x << ", " << y;
    }
  }
}

TEST(JpegReader, GreySequentialAndProgressive) {
  for (const bool progressive : {false, true}) {
    const JpegText text{
        .width = 37, .height = 21, .sample = Slope, .progressive = progressive, .restart_rows = 1};
    const RawImage image = DecodeJpeg(JpegBytes(text), "a.jpg", {});
    EXPECT_EQ(image.width(), 37);
    EXPECT_EQ(image.height(), 21);
    EXPECT_EQ(image.bits, 8);
    EXPECT_EQ(image.full_scale, 255);
    EXPECT_FALSE(image.is_colour());
    ExpectSlope(image);
  }
}

// A block without detail holds its mean alone, so that a flat grey comes back as it is; of colours
// the transformation to YCbCr and back moves a level at most.
TEST(JpegReader, ColoursComeInOrder) {
  const JpegText grey{.width = 16, .height = 16, .sample = [](int, int, int) { return 91; }};
  EXPECT_THAT(DecodeJpeg(JpegBytes(grey), "", {}).planes[0].values(), Each(91));
  constexpr std::array<int, 3> kColour{200, 90, 30};
  const JpegText text{
      .width = 24,
      .height = 16,
      .sample = [&](int, int, int c) { return kColour[static_cast<std::size_t>(c)]; },
      .colour = JCS_RGB,
      .components = 3};
  const RawImage image = DecodeJpeg(JpegBytes(text), "a.jpg", {});
  ASSERT_EQ(image.planes.size(), 3U);
  for (std::size_t c = 0; c < 3; ++c) {
    for (const int sample : image.planes[c].values()) {
      ASSERT_LE(std::abs(sample - kColour[c]), 1) << "channel " << c;
    }
  }
}

// In place of the JFIF marker one of Adobe's; what that does not know is taken for YCbCr.
TEST(JpegReader, AnUnknownTransformationOfColoursIsRead) {
  const JpegText text{.width = 8, .height = 8, .sample = Slope, .colour = JCS_RGB, .components = 3};
  const std::string bytes = JpegBytes(text);
  ASSERT_EQ(bytes.substr(6, 4), "JFIF");
  const std::string adobe =
      std::string("\xff\xee\0\x0e", 4) + "Adobe" + std::string("\0\x64\0\0\0\0\x07", 7);
  const std::string changed = bytes.substr(0, 2) + adobe + bytes.substr(2 + 18);
  const RawImage expected = DecodeJpeg(bytes, "a.jpg", {});
  const RawImage image = DecodeJpeg(changed, "a.jpg", {});
  ASSERT_EQ(image.planes.size(), 3U);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_THAT(image.planes[c].values(), ElementsAreArray(expected.planes[c].values()));
  }
}

TEST(JpegReader, InksAreRefused) {
  const JpegText text{
      .width = 8, .height = 8, .sample = Slope, .colour = JCS_CMYK, .components = 4};
  const core::Problem problem = Refusal(JpegBytes(text));
  EXPECT_EQ(problem.path, "a.jpg");
  EXPECT_THAT(problem.reason, HasSubstr("CMYK"));
}

TEST(JpegReader, ArithmeticCodingAndOtherDepthsAreRefused) {
  JpegText text{.width = 8, .height = 8, .sample = Slope, .arithmetic = true};
  EXPECT_THAT(Refusal(JpegBytes(text)).reason, HasSubstr("arithmetic"));
  text.arithmetic = false;
  std::string bytes = JpegBytes(text);
  const std::size_t frame = bytes.find("\xff\xc0");
  ASSERT_NE(frame, std::string::npos);
  bytes[frame + 4] = 12;  // bits a sample, behind marker and length (T.81, B.2.2)
  EXPECT_THAT(Refusal(bytes).reason, StartsWith("is JPEG of another kind"));
}

// libjpeg would fill up with grey.
TEST(JpegReader, CutOffAnywhereIsRefused) {
  for (const bool progressive : {false, true}) {
    const JpegText text{.width = 37,
                        .height = 21,
                        .sample = Slope,
                        .colour = JCS_RGB,
                        .components = 3,
                        .progressive = progressive};
    const std::string bytes = JpegBytes(text);
    for (std::size_t length = 4; length < bytes.size(); ++length) {
      ASSERT_EQ(Refusal(bytes.substr(0, length)).reason, "ends before its last pixel") << length;
    }
  }
}

// A restart marker of another number: libjpeg would guess what is missing.
TEST(JpegReader, DamageThatLibjpegWouldGuessAwayIsRefused) {
  const JpegText text{.width = 32, .height = 64, .sample = Slope, .restart_rows = 1};
  std::string bytes = JpegBytes(text);
  const std::size_t restart = bytes.find("\xff\xd2");
  ASSERT_NE(restart, std::string::npos);
  bytes[restart + 1] = '\xd5';
  EXPECT_THAT(Refusal(bytes).reason, StartsWith("is damaged: Corrupt JPEG data"));
}

TEST(JpegReader, BytesBetweenTheLastPixelAndTheEndAreRefused) {
  std::string bytes = JpegBytes({.width = 32, .height = 32, .sample = Slope});
  bytes.insert(bytes.size() - 2, 64, 'x');
  EXPECT_THAT(Refusal(bytes).reason, StartsWith("is damaged: Corrupt JPEG data"));
}

// A newer version of the JFIF marker changes no pixel.
TEST(JpegReader, ANewerMarkerIsRead) {
  const JpegText text{.width = 8, .height = 8, .sample = Slope};
  std::string bytes = JpegBytes(text);
  const std::size_t mark = bytes.find("JFIF");
  ASSERT_NE(mark, std::string::npos);
  bytes[mark + 5] = 2;  // major version
  ExpectSlope(DecodeJpeg(bytes, "a.jpg", {}));
}

TEST(JpegReader, SizesAreCheckedBeforeMemoryIsTaken) {
  const JpegText text{.width = 8, .height = 8, .sample = Slope};
  std::string bytes = JpegBytes(text);
  EXPECT_THAT(Refusal(bytes, {.max_side = 7}).reason, HasSubstr("8 x 8 pixels"));
  const std::size_t frame = bytes.find("\xff\xc0");
  const auto with_size = [&](int width, int height) {
    std::string changed = bytes;
    changed[frame + 5] = static_cast<char>(height >> 8);
    changed[frame + 6] = static_cast<char>(height & 0xff);
    changed[frame + 7] = static_cast<char>(width >> 8);
    changed[frame + 8] = static_cast<char>(width & 0xff);
    return changed;
  };
  EXPECT_THAT(Refusal(with_size(40000, 20)).reason, HasSubstr("40000 x 20 pixels"));
  EXPECT_THAT(Refusal(with_size(0, 20)).reason, StartsWith("is damaged"));
  // Within the limits, but not of so few bytes.
  EXPECT_EQ(Refusal(with_size(8000, 8000)).reason, "ends before its last pixel");
}

// Each scan of a progressive file costs a pass over all pixels: a scan of no change, repeated.
TEST(JpegReader, EndlessScansAreRefused) {
  const std::string bytes = JpegBytes(
      {.width = 16, .height = 16, .sample = Slope, .progressive = true, .two_scans = true});
  const std::size_t last = bytes.rfind("\xff\xda");
  const std::string scan = bytes.substr(last, bytes.size() - 2 - last);
  const auto repeated = [&](int times) {
    std::string many = bytes.substr(0, bytes.size() - 2);
    for (int i = 0; i < times; ++i) many += scan;
    return many + "\xff\xd9";
  };
  ExpectSlope(DecodeJpeg(repeated(kMaxJpegScans - 2), "a.jpg", {}));
  EXPECT_THAT(Refusal(repeated(kMaxJpegScans - 1)).reason, HasSubstr("more than 100 scans"));
}

}  // namespace
}  // namespace rockyard::image_files
