// Files of every format by what they hold, and what is said of those that are none.
#include "image_files/read_image.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "image_files/float_files.h"
#include "image_files/jpeg_bytes.h"
#include "image_files/png_bytes.h"
#include "image_files/png_file.h"
#include "image_files/refusals.h"

namespace rockyard::image_files {
namespace {

namespace fs = std::filesystem;

using testing::HasSubstr;

using ReadImageTest = ImageFilesTest;

TEST_F(ReadImageTest, FormatsAreKnownByWhatTheyHold) {
  const std::string png = PngBytes({1, 1, 16, PngColour::kGrey, false, {300}, ""});
  const std::string jpeg =
      JpegBytes({.width = 8, .height = 8, .sample = [](int, int, int) { return 7; }});
  EXPECT_EQ(DescribeImage(ReadImage(Write("a.jpg", png))), "1 x 1 pixels of 16-bit grey, PNG");
  EXPECT_EQ(DescribeImage(ReadImage(Write("a.png", jpeg))), "8 x 8 pixels of 8-bit grey, JPEG");
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
  const fs::path png = Write("d.png", EncodePng(samples));
  const vision::Image<float> disparity = ReadDisparity(png, 16.0);
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
  const fs::path path = Write("d.pfm", EncodePfm(written));
  const vision::Image<float> read = ReadDisparity(path);
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
  const std::string jpeg =
      JpegBytes({.width = 8, .height = 8, .sample = [](int, int, int) { return 7; }});
  EXPECT_THAT(reason(Write("a.jpg", jpeg), 1.0), HasSubstr("is a JPEG file"));
  EXPECT_EQ(reason(folder_ / "none", 1.0), "the file does not exist");
  EXPECT_EQ(reason(Write("empty", ""), 1.0), "is empty");
}

}  // namespace
}  // namespace rockyard::image_files
