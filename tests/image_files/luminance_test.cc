// Grey of samples, against arithmetic in reals and against the Y of JPEG's encoder.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>

#include "image_files/raw_image.h"

namespace rockyard::image_files {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

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
