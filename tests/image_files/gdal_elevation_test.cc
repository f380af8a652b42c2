// Elevation models through GDAL: tiny files typed from the rules of their formats.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "image_files/elevation_raster.h"
#include "image_files/pds_bytes.h"
#include "image_files/raster_bytes.h"
#include "image_files/refusals.h"

namespace rockyard::image_files {
namespace {

namespace fs = std::filesystem;

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kMarsRadius_m = 3396190.0;
constexpr double kMetresPerDegree = kMarsRadius_m * std::numbers::pi / 180.0;

class GdalElevationTest : public ImageFilesTest {
 protected:
  std::vector<double> All(ElevationRaster& raster) const {
    return raster.Read({0, 0, raster.info().rows, raster.info().columns});
  }
  std::string Reason(const std::string& bytes) const {
    const fs::path path = Write("bad.tif", bytes);
    testing::internal::CaptureStderr();
    const core::Problem problem = RefusalOf([&] { All(*OpenElevation(path)); });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "GDAL prints nothing";
    EXPECT_EQ(problem.path, path.string());
    return problem.reason;
  }
};

TEST_F(GdalElevationTest, AsciiGrid) {
  const auto raster =
      OpenElevation(Write("a.asc", AscText(3, {"1", "2", "3.25", "-9999", "5", "6"}, 0.5)));
  EXPECT_EQ(raster->info().format, "AAIGrid");
  EXPECT_EQ(raster->info().rows, 2);
  ASSERT_TRUE(raster->info().transform.has_value());
  EXPECT_THAT(*raster->info().transform, ElementsAre(100, 0.5, 0, 201, 0, -0.5));
  EXPECT_FALSE(raster->HasFrame());
  const std::vector<double> heights = All(*raster);
  EXPECT_EQ(heights[2], 3.25);
  EXPECT_TRUE(std::isnan(heights[3]));
  EXPECT_THAT(raster->Read({1, 1, 1, 2}), ElementsAre(5, 6));
}

// GDAL takes a grid for one of whole numbers by its first half million bytes.
TEST_F(GdalElevationTest, AsciiGridWhoseRealsComeLate) {
  std::vector<std::string> values(300 * 300 * 4, "7");
  values.back() = "7.75";
  const auto raster = OpenElevation(Write("a.asc", AscText(600, values)));
  EXPECT_THAT(raster->Read({599, 598, 1, 2}), ElementsAre(7, 7.75));
}

TEST_F(GdalElevationTest, PlainTiff) {
  const auto raster = OpenElevation(Write("a.tif", TiffBytes({.columns = 3,
                                                              .values = {1, 2, 3, 4, -7, 6},
                                                              .left = 10,
                                                              .top = 20,
                                                              .step_x = 2,
                                                              .step_y = 2,
                                                              .keys = {},
                                                              .doubles = {},
                                                              .no_data = "-7"})));
  EXPECT_EQ(raster->info().format, "GTiff");
  EXPECT_THAT(*raster->info().transform, ElementsAre(10, 2, 0, 20, 0, -2));
  EXPECT_FALSE(raster->HasFrame());
  EXPECT_TRUE(std::isnan(All(*raster)[4]));
  EXPECT_THAT(raster->Read({0, 1, 1, 2}), ElementsAre(2, 3));
}

TiffText Small(double degrees) {
  return {.columns = 3,
          .values = {1, 2, 3, 4, 5, 6},
          .left = 137.0,
          .top = -4.0,
          .step_x = degrees,
          .step_y = degrees,
          .keys = {},
          .doubles = {},
          .no_data = ""};
}

// The sphere has closed forms: north is R times the latitude, east at the equator of the map.
TEST_F(GdalElevationTest, Geographic) {
  TiffText tiff = Small(0.001);
  GeographicKeys(tiff);
  const auto raster = OpenElevation(Write("a.tif", TiffBytes(tiff)));
  ASSERT_TRUE(raster->HasFrame());
  const std::vector<MapPoint> points =
      raster->ToMap({-4.0, 137.0}, std::vector<LocalPoint>{{0, 0}, {0, 1000}, {1000, 0}});
  EXPECT_THAT(points[0].x, DoubleNear(137.0, 1e-9));
  EXPECT_THAT(points[0].y, DoubleNear(-4.0, 1e-9));
  EXPECT_THAT(points[1].y, DoubleNear(-4.0 + 1000.0 / kMetresPerDegree, 1e-9));
  const double parallel = std::cos(4.0 * std::numbers::pi / 180.0);
  EXPECT_THAT(points[2].x, DoubleNear(137.0 + 1000.0 / kMetresPerDegree / parallel, 1e-7));
  const GeoPoint place = raster->ToGeographic(std::vector<MapPoint>{{137.5, -3.5}}).front();
  EXPECT_THAT(place.latitude_deg, DoubleNear(-3.5, 1e-9));
  EXPECT_THAT(place.longitude_deg, DoubleNear(137.5, 1e-9));
}

TEST_F(GdalElevationTest, Equirectangular) {
  TiffText tiff = Small(1.0);
  tiff.left = 0.0;
  tiff.top = -30.0 * kMetresPerDegree;
  EquirectangularKeys(tiff, -30.0);
  const auto raster = OpenElevation(Write("a.tif", TiffBytes(tiff)));
  ASSERT_TRUE(raster->HasFrame());
  // At its standard parallel the map has the scale of the body.
  const std::vector<MapPoint> points =
      raster->ToMap({-30.0, 0.0}, std::vector<LocalPoint>{{0, 0}, {0, 100}, {100, 0}});
  EXPECT_THAT(points[0].y, DoubleNear(-30.0 * kMetresPerDegree, 1e-3));
  EXPECT_THAT(points[1].y - points[0].y, DoubleNear(100.0, 1e-3));
  EXPECT_THAT(points[2].x - points[0].x, DoubleNear(100.0, 1e-2));
}

TEST_F(GdalElevationTest, Pds3AndPds4) {
  const std::string samples = BigEndianSamples({10, -20, 30, 40, 50, 60});
  const auto pds3 = OpenElevation(
      Write("a.img", Pds3Bytes({.width = 3, .height = 2, .mask = "", .data = samples})));
  EXPECT_EQ(pds3->info().format, "PDS");
  EXPECT_THAT(All(*pds3), ElementsAre(10, -20, 30, 40, 50, 60));
  Write("pixels.img", BigEndianSamples({10, 20, 30, 40, 50, 60}));
  const auto pds4 =
      OpenElevation(Write("a.xml", Pds4Label({.width = 3, .height = 2, .data = ""}, "pixels.img")));
  EXPECT_EQ(pds4->info().format, "PDS4");
  EXPECT_THAT(pds4->Read({1, 0, 1, 3}), ElementsAre(40, 50, 60));
}

TEST_F(GdalElevationTest, DamageIsRefused) {
  const std::string tiff = TiffBytes(Small(0.5));
  EXPECT_FALSE(Reason(tiff.substr(0, tiff.size() / 2)).empty());
  EXPECT_FALSE(Reason("II\x2a" + std::string(5, '\0')).empty());
  EXPECT_FALSE(Reason("ncols 3\nnrows x\n").empty());
  const std::string grid = AscText(3, {"1", "2", "3", "4", "5", "6"});
  EXPECT_FALSE(Reason(grid.substr(0, grid.size() - 6)).empty());
  std::string rows = grid;
  EXPECT_THAT(Reason(rows.replace(rows.find("nrows 2"), 7, "nrows 2000000")), HasSubstr("ends"));
  std::string bands = Pds3Bytes({.width = 1, .height = 1, .mask = "", .bands = 2, .data = "abcd"});
  EXPECT_THAT(Reason(bands), HasSubstr("has 2 bands"));
}

}  // namespace
}  // namespace rockyard::image_files
