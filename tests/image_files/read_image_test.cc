// Images of every format by what they hold, planetary ones, PGM and PPM, and the grey of samples.
#include "image_files/read_image.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "image_files/float_files.h"
#include "image_files/jpeg_bytes.h"
#include "image_files/pds_bytes.h"
#include "image_files/planetary.h"
#include "image_files/png_bytes.h"
#include "image_files/png_file.h"
#include "image_files/raw_image.h"
#include "image_files/refusals.h"

namespace rockyard::image_files {
namespace {

namespace fs = std::filesystem;

using namespace std::string_literals;

using testing::ElementsAre;
using testing::HasSubstr;

// Files of every format by what they hold, and what is said of those that are none.

using ReadImageTest = ImageFilesTest;

std::string EvenJpeg() {
  return JpegBytes({.width = 8, .height = 8, .sample = [](int, int, int) { return 7; }});
}

TEST_F(ReadImageTest, FormatsAreKnownByWhatTheyHold) {
  const std::string png = PngBytes({1, 1, 16, PngColour::kGrey, false, {300}, ""});
  EXPECT_EQ(DescribeImage(ReadImage(Write("a.jpg", png))), "1 x 1 pixels of 16-bit grey, PNG");
  EXPECT_EQ(DescribeImage(ReadImage(Write("a.png", EvenJpeg()))),
            "8 x 8 pixels of 8-bit grey, JPEG");
  EXPECT_EQ(DescribeImage(ReadImage(Write("a", "P6 1 1 255\nabc"))),
            "1 x 1 pixels of 8-bit colour, PPM");
}

TEST_F(ReadImageTest, WhatIsNoImageIsRefused) {
  const auto reason = [](const fs::path& path) {
    const core::Problem problem = RefusalOf([&] { ReadImage(path); });
    EXPECT_EQ(problem.path, path.string());
    return problem.reason;
  };
  EXPECT_EQ(reason(folder_ / "none.png"), "the file does not exist");
  EXPECT_EQ(reason(folder_), "is a folder, not a regular file");
  EXPECT_EQ(reason("/dev/null"), "is not a regular file");
  EXPECT_EQ(reason(Write("empty.png", "")), "is empty");
  EXPECT_THAT(reason(Write("a.png", "GIF89a")), HasSubstr("no format of images that is known"));
  EXPECT_THAT(reason(Write("b.png", "\x89PNG")), HasSubstr("no format of images that is known"));
  EXPECT_THAT(reason(Write("c.pgm", "P5")), HasSubstr("no format of images that is known"));
  EXPECT_THAT(reason(Write("P5.txt", "P5x 1")), HasSubstr("no format of images that is known"));
  EXPECT_THAT(reason(Write("d.pbm", "P1 1 1\n1")), HasSubstr("neither PGM nor PPM"));
  EXPECT_THAT(reason(Write("d.pbm", "P4 8 1\n\1")), HasSubstr("neither PGM nor PPM"));
  EXPECT_THAT(reason(Write("d.pfm", "Pf 1 1 -1\nabcd")), HasSubstr("is a PFM file"));
}

TEST_F(ReadImageTest, DisparitiesOfIntegerImages) {
  SamplePlane samples(3, 1);
  samples.At(0, 0) = 0;
  samples.At(1, 0) = 40;
  samples.At(2, 0) = 1000;
  const vision::Image<float> disparity = ReadDisparity(Write("d.png", EncodePng(samples)), 16.0);
  ASSERT_EQ(disparity.width(), 3);
  EXPECT_TRUE(std::isnan(disparity.At(0, 0)));
  EXPECT_EQ(disparity.At(1, 0), 2.5F);
  EXPECT_EQ(disparity.At(2, 0), 62.5F);
  EXPECT_EQ(ReadDisparity(Write("d.pgm", "P5 1 1 255\n!")).At(0, 0), 33.0F);
  EXPECT_EQ(ReadDisparity(Write("d.ppm", "P6 1 1 255\n!!!")).At(0, 0), 33.0F)
      << "grey that was saved as colour";
}

TEST_F(ReadImageTest, DisparitiesOfPfmFiles) {
  vision::Image<float> written(2, 1);
  written.At(0, 0) = -3.25F;
  written.At(1, 0) = std::numeric_limits<float>::infinity();
  const vision::Image<float> read = ReadDisparity(Write("d.pfm", EncodePfm(written)));
  EXPECT_EQ(read.At(0, 0), -3.25F);
  EXPECT_TRUE(std::isnan(read.At(1, 0)));
}

TEST_F(ReadImageTest, WhatStatesNoDisparityIsRefused) {
  const auto reason = [](const fs::path& path, double scale) {
    return RefusalOf([&] { ReadDisparity(path, scale); }).reason;
  };
  EXPECT_THAT(reason(Write("a.pfm", "Pf 1 1 -1\nabcd"), 4.0), HasSubstr("is a PFM file"));
  EXPECT_THAT(reason(Write("a.ppm", "P6 1 1 255\nabc"), 1.0), HasSubstr("is in colour"));
  EXPECT_THAT(reason(Write("a.ppm", "P6 1 1 255\naab"), 1.0), HasSubstr("is in colour"));
  EXPECT_THAT(reason(Write("a.jpg", EvenJpeg()), 1.0), HasSubstr("is a JPEG file"));
  EXPECT_EQ(reason(folder_ / "none", 1.0), "the file does not exist");
  EXPECT_EQ(reason(Write("empty", ""), 1.0), "is empty");
}

// PGM and PPM files typed from Netpbm's specification.

RawImage Read(const std::string& bytes) { return DecodePnm(bytes, "a.pgm", {}); }

std::string Reason(const std::string& bytes, const ImageLimits& limits = {}) {
  const core::Problem problem = RefusalOf([&] { DecodePnm(bytes, "a.pgm", limits); });
  EXPECT_EQ(problem.path, "a.pgm");
  return problem.reason;
}

TEST(PnmReader, PlainGreyWithComments) {
  const RawImage image =
      Read("P2 # made by hand\n# width, then height\n3 2\n9\n0 1 2#half\n3 8 9\n");
  EXPECT_EQ(image.format, "PGM");
  EXPECT_EQ(image.width(), 3);
  EXPECT_EQ(image.height(), 2);
  EXPECT_EQ(image.bits, 4);
  EXPECT_EQ(image.full_scale, 9);
  ASSERT_EQ(image.planes.size(), 1U);
  EXPECT_THAT(image.planes[0].values(), ElementsAre(0, 1, 2, 3, 8, 9));
}

TEST(PnmReader, PlainColour) {
  const RawImage image = Read("P3\n2 1\n65535\n1 2 3\n40000 50000 65535");
  EXPECT_EQ(image.format, "PPM");
  ASSERT_EQ(image.planes.size(), 3U);
  EXPECT_EQ(image.bits, 16);
  EXPECT_THAT(image.planes[0].values(), ElementsAre(1, 40000));
  EXPECT_THAT(image.planes[1].values(), ElementsAre(2, 50000));
  EXPECT_THAT(image.planes[2].values(), ElementsAre(3, 65535));
}

// The first byte of the pixels may look like white space, a digit or a comment.
TEST(PnmReader, BytesOfGreyAndColour) {
  EXPECT_THAT(Read("P5\n2 2\n255\n #7\xff").planes[0].values(), ElementsAre(32, 35, 55, 255));
  const RawImage colour = Read("P6 1 2 255 abcdef");
  EXPECT_THAT(colour.planes[0].values(), ElementsAre('a', 'd'));
  EXPECT_THAT(colour.planes[2].values(), ElementsAre('c', 'f'));
}

// Most significant byte first where the maximum is above 255.
TEST(PnmReader, TwoBytesASample) {
  const RawImage image = Read("P5 2 1 4095\n\x0f\xff\x01\x02"s);
  EXPECT_EQ(image.bits, 12);
  EXPECT_EQ(image.full_scale, 4095);
  EXPECT_THAT(image.planes[0].values(), ElementsAre(4095, 258));
  EXPECT_THAT(Read("P5 1 1 255\n\x07"s).planes[0].values(), ElementsAre(7));
  EXPECT_THAT(Read("P5 1 1 256\n\x01\x00"s).planes[0].values(), ElementsAre(256));
}

TEST(PnmReader, MissingPixelsAreRefused) {
  const std::string ends = "ends before its last pixel";
  for (const std::string& whole : {"P5 3 2 255\nabcdef"s, "P5 3 1 999\n\1\1\1\1\1\1"s,
                                   "P6 1 2 255\nabcdef"s, "P2 3 2 9\n1 2 3 4 5 6"s}) {
    ASSERT_GT(Read(whole).width(), 0);
    for (std::size_t length = 3; length < whole.size(); ++length) {
      ASSERT_EQ(Reason(whole.substr(0, length)), ends) << whole.substr(0, length);
    }
  }
}

TEST(PnmReader, TooManyPixelsAreRefused) {
  EXPECT_THAT(Reason("P5 1 1 255\nab"), HasSubstr("goes on"));
  EXPECT_THAT(Reason("P2 1 1 255\n1 2"), HasSubstr("goes on"));
  EXPECT_EQ(Read("P5 1 1 255\na\n").width(), 1) << "what an editor leaves";
  EXPECT_EQ(Read("P2 1 1 255\n1\n#end\n").width(), 1);
}

TEST(PnmReader, SamplesAboveTheMaximumAreRefused) {
  EXPECT_THAT(Reason("P5 2 1 9\n\x09\x0a"s), HasSubstr("a sample is 10, above its maximum 9"));
  EXPECT_THAT(Reason("P2 2 1 9\n9 10"), HasSubstr("sample is no number from 0 to 9"));
}

TEST(PnmReader, HeadersThatMeanNothingAreRefused) {
  EXPECT_THAT(Reason("P5 0 2 255\n"), HasSubstr("0 x 2 pixels"));
  EXPECT_THAT(Reason("P5 2 0 255\n"), HasSubstr("2 x 0 pixels"));
  EXPECT_THAT(Reason("P5 -2 2 255\nabcd"), HasSubstr("width is no number"));
  EXPECT_THAT(Reason("P5 2 2.5 255\nabcd"), HasSubstr("height is no number"));
  EXPECT_THAT(Reason("P5 99999999999999999999 2 255\nabcd"), HasSubstr("width is no number"));
  EXPECT_THAT(Reason("P5 2 2 0\nabcd"), HasSubstr("maximum is 0"));
  EXPECT_THAT(Reason("P5 2 2 65536\nabcdabcd"), HasSubstr("maximum is no number"));
  EXPECT_THAT(Reason("P5 2 2 255#\nabcd"), HasSubstr("does not end in white space"));
  EXPECT_THAT(Reason("P4 8 1\na"), HasSubstr("neither PGM nor PPM"));
}

TEST(PnmReader, SizesAreCheckedBeforeMemoryIsTaken) {
  EXPECT_THAT(Reason("P5 16385 1 255\n"), HasSubstr("16385 x 1 pixels"));
  EXPECT_THAT(Reason("P5 1 16385 255\n"), HasSubstr("1 x 16385 pixels"));
  EXPECT_THAT(Reason("P5 16000 16000 255\n"), HasSubstr("16000 x 16000 pixels"));
  EXPECT_EQ(Reason("P6 8000 8000 65535\nabc"), "ends before its last pixel");
}

// Labels of planetary images, and what a program without GDAL says: the same in every build.

// A stand-in for GDAL: a row of two pixels in three colours.
template <int bits>
Raster Colours(const std::filesystem::path& path, const char* driver, const ImageLimits&) {
  EXPECT_TRUE(path.is_absolute());
  EXPECT_STREQ(driver, "PDS");
  return {.planes = std::vector(3, SamplePlane(2, 1, 9)), .bits = bits, .negative = 5};
}

RawImage Read(const std::string& label, RasterReader reader) {
  return ReadPlanetary("a.img", label, PlanetaryKind::kPds3, {}, {reader, ""});
}

TEST(Planetary, KindsAreKnownByTheirLabels) {
  EXPECT_EQ(PlanetaryKindOf(Pds3Bytes({})), PlanetaryKind::kPds3);
  EXPECT_EQ(PlanetaryKindOf("CCSD3ZF0000100000001NJPL3IF0PDS2\r\nODL_VERSION_ID = ODL3\r\n"),
            PlanetaryKind::kPds3);
  EXPECT_EQ(PlanetaryKindOf(VicarBytes({})), PlanetaryKind::kVicar);
  EXPECT_EQ(PlanetaryKindOf(Pds4Label({}, "a.img")), PlanetaryKind::kPds4);
  EXPECT_EQ(PlanetaryKindOf("\xef\xbb\xbf" + Pds4Label({}, "a.img")), PlanetaryKind::kPds4);
  EXPECT_EQ(PlanetaryKindOf("<svg xmlns=\"http://www.w3.org/2000/svg\"/>"), std::nullopt);
  EXPECT_EQ(PlanetaryKindOf("a text about http://pds.nasa.gov/pds4/"), std::nullopt);
  EXPECT_EQ(PlanetaryKindOf(std::string(2000, ' ') + "PDS_VERSION_ID"), std::nullopt);
  EXPECT_EQ(PlanetaryKindOf(""), std::nullopt);
}

TEST(Planetary, TheBitMaskOfTheLabel) {
  EXPECT_EQ(SampleBitMask("SAMPLE_BIT_MASK                 = 2#0000111111111111#"), 4095);
  EXPECT_EQ(SampleBitMask("x SAMPLE_BIT_MASK='2#0000000011111111#'  y"), 255);
  EXPECT_EQ(SampleBitMask("<img:sample_bit_mask>2#0000111111111111</img:sample_bit_mask>"), 4095);
  EXPECT_EQ(SampleBitMask("SAMPLE_BIT_MASK = 16#0FFF#"), 4095);
  EXPECT_EQ(SampleBitMask("SAMPLE_BIT_MASK = 2047"), 2047);
  EXPECT_EQ(SampleBitMask("SAMPLE_BIT_MASK = 2#1111111111111111#"), 65535);
  EXPECT_EQ(SampleBitMask("SAMPLE_BIT_MASK = 2#11111111111111111#"), std::nullopt);
  EXPECT_EQ(SampleBitMask("SAMPLE_BIT_MASK = 2#0#"), std::nullopt);
  EXPECT_EQ(SampleBitMask("SAMPLE_BIT_MASK = 17#1#"), std::nullopt);
  EXPECT_EQ(SampleBitMask("SAMPLE_BIT_MASK = 1#1#"), std::nullopt);
  EXPECT_EQ(SampleBitMask("SAMPLE_BIT_MASK = N/A"), std::nullopt);
  EXPECT_EQ(SampleBitMask("SAMPLE_BIT_MASK"), std::nullopt);
  EXPECT_EQ(SampleBitMask("SAMPLE_BITS = 16"), std::nullopt);
}

TEST(Planetary, FullScaleIsThatOfTheMaskWhereItFits) {
  const RawImage masked = Read("SAMPLE_BIT_MASK = 2#111111111111#", Colours<15>);
  EXPECT_EQ(masked.format, "PDS3");
  EXPECT_EQ(masked.bits, 12);
  EXPECT_EQ(masked.full_scale, 4095);
  EXPECT_THAT(masked.full_scale_from, HasSubstr("SAMPLE_BIT_MASK of the label"));
  EXPECT_EQ(masked.negative, 5);
  EXPECT_EQ(masked.planes.size(), 3U);
  EXPECT_THAT(masked.planes[2].values(), ElementsAre(9, 9));
  const RawImage plain = Read("no mask", Colours<15>);
  EXPECT_EQ(plain.full_scale, 32767);
  EXPECT_EQ(plain.bits, 15);
  EXPECT_THAT(plain.full_scale_from, HasSubstr("the label has no SAMPLE_BIT_MASK"));
  EXPECT_EQ(Read("SAMPLE_BIT_MASK = 2#111111111#", Colours<8>).full_scale, 255)
      << "a mask of more bits than samples have";
  EXPECT_EQ(Read("SAMPLE_BIT_MASK = 255", Colours<8>).full_scale, 255);
}

TEST(Planetary, WithoutGdalTheRemedyIsNamed) {
  for (const PlanetaryKind kind :
       {PlanetaryKind::kPds3, PlanetaryKind::kPds4, PlanetaryKind::kVicar}) {
    const core::Problem problem = RefusalOf([&] {
      ReadPlanetary("a.img", "", kind, {}, {nullptr, "get it"});
    });
    EXPECT_EQ(problem.path, "a.img");
    EXPECT_EQ(problem.reason, std::string("is a ") + NameOf(kind) +
                                  " image, which this rockyard cannot read without GDAL");
    EXPECT_EQ(problem.suggestion, "get it");
  }
  const RasterSupport gdal = FindGdal();
  if (gdal.reader == nullptr) {
    EXPECT_THAT(gdal.remedy, HasSubstr("libgdal"));
  } else {
    EXPECT_EQ(gdal.remedy, "");
  }
}

// Grey of samples, against arithmetic in reals and against the Y of JPEG's encoder.

RawImage Grey(int full_scale, int bits, std::initializer_list<int> samples) {
  RawImage image;
  image.bits = bits;
  image.full_scale = full_scale;
  image.full_scale_from = "the test";
  SamplePlane plane(static_cast<int>(samples.size()), 1);
  int x = 0;
  for (const int sample : samples) plane.At(x++, 0) = static_cast<std::uint16_t>(sample);
  image.planes.push_back(plane);
  return image;
}

TEST(Luminance, GreyOf8BitsStaysAsItIs) {
  RawImage image = Grey(255, 8, {});
  image.planes[0] = SamplePlane(256, 1);
  for (int i = 0; i < 256; ++i) image.planes[0].At(i, 0) = static_cast<std::uint16_t>(i);
  const GrayConversion done = ToGray(image);
  for (int i = 0; i < 256; ++i) ASSERT_EQ(done.image.At(i, 0), i);
  EXPECT_EQ(done.clipped, 0);
  EXPECT_EQ(done.what_was_done, "grey of 8 bits");
}

TEST(Luminance, FullScaleBecomesWhiteAndHalvesGoUp) {
  const GrayConversion twelve = ToGray(Grey(4095, 12, {0, 8, 9, 2048, 4094, 4095}));
  // 255 / 4095 of 8, 9, 2048 and 4094 are 0.498, 0.56, 127.53 and 254.94.
  EXPECT_THAT(twelve.image.values(), ElementsAre(0, 0, 1, 128, 255, 255));
  EXPECT_EQ(twelve.white, 4095);
  EXPECT_EQ(twelve.what_was_done, "grey of 12 bits, scaled by 255 / 4095 (the test)");
  // 255 x 1 / 510 is a half.
  EXPECT_THAT(ToGray(Grey(510, 9, {1, 510})).image.values(), ElementsAre(1, 255));
  EXPECT_THAT(ToGray(Grey(1, 1, {0, 1})).image.values(), ElementsAre(0, 255));
  for (int sample = 0; sample < 65536; sample += 7) {
    ASSERT_EQ(ToGray(Grey(65535, 16, {sample})).image.At(0, 0), std::floor(sample / 257.0 + 0.5));
  }
}

TEST(Luminance, AGivenWhiteClipsWhatIsBrighter) {
  const GrayConversion done = ToGray(Grey(4095, 12, {400, 799, 800, 801, 4095}), {.white = 800});
  EXPECT_THAT(done.image.values(), ElementsAre(128, 255, 255, 255, 255));
  EXPECT_EQ(done.clipped, 2);
  EXPECT_EQ(done.white, 800);
  EXPECT_THAT(done.what_was_done, HasSubstr("scaled by 255 / 800 (as asked for)"));
  EXPECT_THAT(done.what_was_done, HasSubstr("2 pixels brighter than white"));
}

// 10 bits in a file of 16, and the bounds of what is told.
TEST(Luminance, SamplesThatUseLittleOfTheirScaleGetAdvice) {
  EXPECT_EQ(ToGray(Grey(65535, 16, {3, 1000})).advice,
            "the brightest sample is 1000 of 65535: --white 1023 would keep more of the image");
  EXPECT_THAT(ToGray(Grey(65535, 16, {8191})).advice, HasSubstr("--white 8191 "));
  EXPECT_EQ(ToGray(Grey(65535, 16, {8192})).advice, "");
  EXPECT_THAT(ToGray(Grey(65535, 16, {512})).advice, HasSubstr("--white 1023 "));
  EXPECT_EQ(ToGray(Grey(65535, 16, {0})).advice, "") << "black";
  EXPECT_EQ(ToGray(Grey(65535, 16, {1000}), {.white = 65535}).advice, "") << "as asked for";
  EXPECT_EQ(ToGray(Grey(255, 8, {10})).advice, "");
}

TEST(Luminance, ColoursWeighAsInBt601) {
  const auto of = [](int red, int green, int blue) {
    RawImage image = Grey(255, 8, {red});
    image.planes.push_back(Grey(255, 8, {green}).planes[0]);
    image.planes.push_back(Grey(255, 8, {blue}).planes[0]);
    return static_cast<int>(ToGray(image).image.At(0, 0));
  };
  EXPECT_EQ(of(255, 0, 0), 76);   // 76.245
  EXPECT_EQ(of(0, 255, 0), 150);  // 149.685
  EXPECT_EQ(of(0, 0, 255), 29);   // 29.07
  EXPECT_EQ(of(255, 255, 255), 255);
  for (int i = 0; i < 500; ++i) {
    const int red = i * 83 % 256;
    const int green = i * 131 % 256;
    const int blue = i * 29 % 256;
    ASSERT_LE(std::abs(of(red, green, blue) - (0.299 * red + 0.587 * green + 0.114 * blue)),
              0.5 + 1e-9);
  }
}

TEST(Luminance, SaysWhatWasLeftOut) {
  RawImage image = Grey(255, 8, {1, 2});
  image.planes.resize(3, image.planes[0]);
  EXPECT_THAT(ToGray(image).what_was_done, "luminance of colour (ITU-R BT.601) of 8 bits");
  image.not_opaque = 3;
  image.negative = 4;
  EXPECT_THAT(ToGray(image).what_was_done, HasSubstr("transparency of 3 pixels not heeded"));
  EXPECT_THAT(ToGray(image).what_was_done, HasSubstr("4 negative samples as 0"));
}

}  // namespace
}  // namespace rockyard::image_files
