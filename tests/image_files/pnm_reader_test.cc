// PGM and PPM files typed from Netpbm's specification.
#include <gmock/gmock.h>

#include <string>

#include "image_files/read_image.h"
#include "image_files/refusals.h"

namespace rockyard::image_files {
namespace {

using namespace std::string_literals;

using testing::ElementsAre;
using testing::HasSubstr;

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

}  // namespace
}  // namespace rockyard::image_files
