// What needs no GDAL: NumPy's files, and what is said of files of no kind that is known.
#include "image_files/elevation_raster.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "image_files/raster_bytes.h"
#include "image_files/refusals.h"

namespace rockyard::image_files {
namespace {

namespace fs = std::filesystem;

using testing::ElementsAre;
using testing::HasSubstr;

class NpyRasterTest : public ImageFilesTest {
 protected:
  std::string Reason(const std::string& bytes) const {
    const fs::path path = Write("bad.npy", bytes);
    const core::Problem problem = RefusalOf([&] {
      const auto raster = OpenElevation(path);
      raster->Read({0, 0, raster->info().rows, raster->info().columns});
    });
    EXPECT_EQ(problem.path, path.string());
    return problem.reason;
  }
};

TEST_F(NpyRasterTest, EveryTypeInBothOrders) {
  for (const char* type : {"<f4", ">f4", "<f8", ">f8", "<i2", ">i2", "<i4", ">i4"}) {
    const auto raster = OpenElevation(Write("a.npy", NpyBytes(type, 3, {1, -2, 300, 4, 5, -6000})));
    EXPECT_EQ(raster->info().format, "NumPy");
    EXPECT_EQ(raster->info().rows, 2);
    EXPECT_EQ(raster->info().columns, 3);
    EXPECT_FALSE(raster->HasFrame());
    EXPECT_THAT(raster->Read({0, 0, 2, 3}), ElementsAre(1, -2, 300, 4, 5, -6000)) << type;
  }
  for (const char* type : {"<u2", ">u2"}) {
    const auto raster = OpenElevation(Write("a.npy", NpyBytes(type, 2, {1, 60000})));
    EXPECT_THAT(raster->Read({0, 0, 1, 2}), ElementsAre(1, 60000)) << type;
  }
}

TEST_F(NpyRasterTest, AnyWindow) {
  std::vector<double> values;
  for (int i = 0; i < 7 * 5; ++i) values.push_back(i);
  const auto raster = OpenElevation(Write("a.npy", NpyBytes("<f4", 5, values)));
  EXPECT_THAT(raster->Read({2, 1, 2, 3}), ElementsAre(11, 12, 13, 16, 17, 18));
  EXPECT_THAT(raster->Read({6, 4, 1, 1}), ElementsAre(34));
  EXPECT_THAT(raster->Read({0, 0, 1, 1}), ElementsAre(0)) << "backwards";
}

TEST_F(NpyRasterTest, WhatIsNoNumberIsNoData) {
  const double infinity = std::numeric_limits<double>::infinity();
  const auto raster =
      OpenElevation(Write("a.npy", NpyBytes("<f4", 3, {std::nan(""), infinity, 1.0})));
  const std::vector<double> heights = raster->Read({0, 0, 1, 3});
  EXPECT_TRUE(std::isnan(heights[0]) && std::isnan(heights[1]));
  EXPECT_EQ(heights[2], 1.0);
}

TEST_F(NpyRasterTest, WhatIsNotReadIsRefused) {
  const std::string good = NpyBytes("<f4", 2, {1, 2, 3, 4});
  const auto with = [&](const std::string& old_text, const std::string& new_text) {
    std::string bytes = good;
    return bytes.replace(bytes.find(old_text), old_text.size(), new_text);
  };
  EXPECT_THAT(Reason(with("<f4", "<c8")), HasSubstr("no plain numbers"));
  EXPECT_THAT(Reason(with("<f4", "|O8")), HasSubstr("no plain numbers"));
  EXPECT_THAT(Reason(with("False", "True ")), HasSubstr("row by row"));
  EXPECT_THAT(Reason(with("(2, 2)", "(4,)  ")), HasSubstr("two dimensions"));
  EXPECT_THAT(Reason(with("(2, 2)", "(-2,2)")), HasSubstr("two dimensions"));
  EXPECT_THAT(Reason(with("(2, 2)", "(0, 2)")), HasSubstr("0 rows of 2 columns"));
  EXPECT_THAT(Reason(with("(2, 2)", "(9, 9)")), HasSubstr("ends"));
  EXPECT_THAT(Reason(with(std::string("\x01\x00", 2), std::string("\x09\x00", 2))),
              HasSubstr("version 9"));
  EXPECT_THAT(Reason(NpyBytes("<f4", 1, {1}).substr(0, 100)), HasSubstr("ends"));
}

// The header alone may not bring the reader to take memory.
TEST_F(NpyRasterTest, ShortFilesOfLargeArraysAreRefused) {
  std::string bytes = NpyBytes("<f8", 1, {1});
  bytes.replace(bytes.find("(1, 1), }"), 25, "(16000000, 16000000), }  ");
  EXPECT_FALSE(Reason(bytes).empty());
}

TEST_F(NpyRasterTest, CutOffAnywhereIsRefused) {
  const std::string good = NpyBytes("<i2", 2, {1, 2, 3, 4});
  for (std::size_t size = 1; size < good.size(); ++size) {
    ASSERT_FALSE(Reason(good.substr(0, size)).empty()) << size;
  }
}

TEST_F(NpyRasterTest, OtherFilesAreRefused) {
  EXPECT_THAT(Reason("PK\x03\x04"), HasSubstr("no format of elevation models"));
  EXPECT_EQ(Reason(""), "is empty");
  EXPECT_EQ(RefusalOf([&] { OpenElevation(folder_ / "none.npy"); }).reason,
            "the file does not exist");
  EXPECT_EQ(RefusalOf([&] { OpenElevation(folder_); }).reason, "is not a regular file");
}

}  // namespace
}  // namespace rockyard::image_files
