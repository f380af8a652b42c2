// Planetary images through GDAL: tiny files typed from the rules of their formats.
#include <gmock/gmock.h>

#include <filesystem>
#include <string>

#include "image_files/pds_bytes.h"
#include "image_files/read_image.h"
#include "image_files/refusals.h"

namespace rockyard::image_files {
namespace {

namespace fs = std::filesystem;

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class GdalRasterTest : public ImageFilesTest {
 protected:
  std::string Reason(const std::string& bytes, const ImageLimits& limits = {}) const {
    const fs::path path = Write("bad.img", bytes);
    testing::internal::CaptureStderr();
    const core::Problem problem = RefusalOf([&] { ReadImage(path, limits); });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "GDAL prints nothing";
    EXPECT_EQ(problem.path, path.string());
    return problem.reason;
  }
};

PdsText Small() {
  return {.width = 3, .height = 2, .data = BigEndianSamples({0, 1, 258, 4095, -7, 300})};
}

TEST_F(GdalRasterTest, Pds3) {
  const RawImage image = ReadImage(Write("a.img", Pds3Bytes(Small())));
  EXPECT_EQ(DescribeImage(image), "3 x 2 pixels of 12-bit grey, PDS3");
  EXPECT_EQ(image.full_scale, 4095);
  EXPECT_EQ(image.negative, 1);
  EXPECT_THAT(image.planes[0].values(), ElementsAre(0, 1, 258, 4095, 0, 300));
}

TEST_F(GdalRasterTest, Pds3BytesAndColours) {
  const RawImage image = ReadImage(Write("a.img", Pds3Bytes({.width = 2,
                                                             .height = 1,
                                                             .sample_type = "UNSIGNED_INTEGER",
                                                             .sample_bits = 8,
                                                             .mask = "",
                                                             .bands = 3,
                                                             .data = "abcdef"})));
  ASSERT_EQ(image.planes.size(), 3U);
  EXPECT_EQ(image.full_scale, 255);
  EXPECT_THAT(image.planes[0].values(), ElementsAre('a', 'b'));
  EXPECT_THAT(image.planes[1].values(), ElementsAre('c', 'd'));
  EXPECT_THAT(image.planes[2].values(), ElementsAre('e', 'f'));
  const RawImage wide = ReadImage(Write("b.img", Pds3Bytes({.width = 1,
                                                            .height = 1,
                                                            .sample_type = "MSB_UNSIGNED_INTEGER",
                                                            .mask = "",
                                                            .data = "\xff\xfe"})));
  EXPECT_EQ(wide.full_scale, 65535);
  const RawImage with_sign =
      ReadImage(Write("c.img", Pds3Bytes({.width = 1, .height = 1, .mask = "", .data = "ab"})));
  EXPECT_EQ(with_sign.full_scale, 32767);
  EXPECT_THAT(wide.planes[0].values(), ElementsAre(65534));
}

TEST_F(GdalRasterTest, Pds3WithALabelOfItsOwn) {
  std::string label = Pds3Bytes(Small()).substr(0, 1024);
  label.replace(label.find("^IMAGE = 2"), 10, "^IMAGE = (\"pixels.img\", 1)");
  Write("pixels.img", Small().data);
  const RawImage image = ReadImage(Write("a.lbl", label));
  EXPECT_EQ(DescribeImage(image), "3 x 2 pixels of 12-bit grey, PDS3");
  EXPECT_THAT(image.planes[0].values(), ElementsAre(0, 1, 258, 4095, 0, 300));
}

TEST_F(GdalRasterTest, Vicar) {
  const RawImage image = ReadImage(Write("a.vic", VicarBytes(Small())));
  EXPECT_EQ(DescribeImage(image), "3 x 2 pixels of 12-bit grey, VICAR");
  EXPECT_THAT(image.planes[0].values(), ElementsAre(0, 1, 258, 4095, 0, 300));
}

TEST_F(GdalRasterTest, Pds4) {
  Write("pixels.img", BigEndianSamples({0, 1, 258, 4095, 65000, 300}));
  const RawImage image = ReadImage(Write("a.xml", Pds4Label(Small(), "pixels.img")));
  EXPECT_EQ(DescribeImage(image), "3 x 2 pixels of 12-bit grey, PDS4");
  EXPECT_THAT(image.planes[0].values(), ElementsAre(0, 1, 258, 4095, 65000, 300));
}

TEST_F(GdalRasterTest, CutOffAnywhereIsRefused) {
  for (const std::string& whole : {Pds3Bytes(Small()), VicarBytes(Small())}) {
    for (std::size_t missing = 1; missing <= Small().data.size(); ++missing) {
      ASSERT_FALSE(Reason(whole.substr(0, whole.size() - missing)).empty()) << missing;
    }
  }
  Write("pixels.img", BigEndianSamples({0, 1, 258, 4095, 7}));
  EXPECT_FALSE(Reason(Pds4Label(Small(), "pixels.img")).empty());
  EXPECT_FALSE(Reason(Pds4Label(Small(), "missing.img")).empty());
}

TEST_F(GdalRasterTest, WhatIsNoImageOfIntegersIsRefused) {
  PdsText text = Small();
  text.sample_type = "IEEE_REAL";
  text.sample_bits = 32;
  text.data += std::string(12, '\0');
  EXPECT_THAT(Reason(Pds3Bytes(text)), HasSubstr("samples of type Float32"));
  text = Small();
  text.bands = 2;
  text.data += text.data;
  EXPECT_THAT(Reason(Pds3Bytes(text)), HasSubstr("has 2 bands"));
  text = Small();
  text.width = 20000;
  text.height = 20000;
  EXPECT_THAT(Reason(Pds3Bytes(text)), HasSubstr("20000 x 20000 pixels"));
  EXPECT_THAT(Reason("PDS_VERSION_ID = PDS3\r\nEND\r\n"), StartsWith("is damaged: "));
}

// Large by its label, within the limits, and of 12 bytes.
TEST_F(GdalRasterTest, AShortFileOfALargeImageIsRefused) {
  PdsText text = Small();
  text.width = 8000;
  text.height = 8000;
  EXPECT_FALSE(Reason(Pds3Bytes(text)).empty());
}

// Messages of GDAL of two lines.
TEST_F(GdalRasterTest, ReasonsAreOneLine) {
  std::string label = Pds3Bytes(Small());
  label.replace(label.find("^IMAGE = 2"), 10, "^IMAGE = (\"b\", 1)");
  const std::string reason = Reason(label);
  EXPECT_THAT(reason, HasSubstr("No such file"));
  EXPECT_THAT(reason, Not(HasSubstr("\n")));
}

TEST_F(GdalRasterTest, FilesAreClosed) {
  const fs::path path = Write("a.img", Pds3Bytes(Small()));
  const auto open_files = [] {
    return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
  };
  ReadImage(path);  // loads the library
  const auto before = open_files();
  ReadImage(path);
  EXPECT_EQ(open_files(), before);
}

}  // namespace
}  // namespace rockyard::image_files
