// Parts of files that say where on Mars they lie: only a build with GDAL has them.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "campaign/site/elevation_file.h"
#include "campaign/site/site_files.h"
#include "campaign/site/site_scan.h"

namespace rockyard::campaign {
namespace {

using image_files::TiffText;
using testing::DoubleNear;
using testing::HasSubstr;

constexpr double kRadius_m = 3396190.0;
constexpr double kRadians = std::numbers::pi / 180.0;
constexpr double kDegree_m = kRadius_m * kRadians;

// Where a place of a sphere lies on the plane that touches it elsewhere, by the angle between both
// and the bearing (azimuthal equidistant, spherical trigonometry).
std::pair<double, double> OnPlane(double lat0_deg, double lon0_deg, double lat_deg,
                                  double lon_deg) {
  const double lat0 = lat0_deg * kRadians;
  const double lat = lat_deg * kRadians;
  const double turn = (lon_deg - lon0_deg) * kRadians;
  const double east = std::cos(lat) * std::sin(turn);
  const double north =
      std::cos(lat0) * std::sin(lat) - std::sin(lat0) * std::cos(lat) * std::cos(turn);
  const double sine = std::hypot(east, north);
  if (sine == 0.0) return {0.0, 0.0};
  const double far_m = kRadius_m * std::asin(sine);
  return {far_m * east / sine, far_m * north / sine};
}

// Rises by 0.1 to the east and 0.02 to the north of a place at 30 degrees south.
constexpr double kLat = -30.0;
constexpr double kLon = 137.4;
double HeightAt(double east_m, double north_m) {
  return 1000.0 + 0.1 * east_m + 0.02 * north_m + 1e-4 * east_m * north_m;
}

class ElevationGdalTest : public SiteTest {
 protected:
  // Degrees, of cells 1 m high and 0.87 m wide there.
  std::filesystem::path Geographic(double gap_column = -1.0) const {
    TiffText tiff{.columns = 120,
                  .values = {},
                  .left = 0,
                  .top = 0,
                  .step_x = 1.0 / kDegree_m,
                  .step_y = 1.0 / kDegree_m,
                  .keys = {},
                  .doubles = {},
                  .no_data = "-9999"};
    tiff.left = kLon - 60.5 * tiff.step_x;
    tiff.top = kLat + 50.5 * tiff.step_y;
    for (int r = 0; r < 100; ++r) {
      for (int c = 0; c < 120; ++c) {
        const auto [east_m, north_m] = OnPlane(kLat, kLon, tiff.top - (r + 0.5) * tiff.step_y,
                                               tiff.left + (c + 0.5) * tiff.step_x);
        tiff.values.push_back(c == gap_column ? -9999.0 : HeightAt(east_m, north_m));
      }
    }
    image_files::GeographicKeys(tiff);
    return Write("geographic.tif", image_files::TiffBytes(tiff));
  }
};

TEST_F(ElevationGdalTest, DegreesAreResampledToMetres) {
  const SiteElevation site =
      ReadElevation({.file = Geographic(), .at = {{kLat, kLon}}, .size_m = 40.0});
  EXPECT_TRUE(site.resampled);
  EXPECT_THAT(site.notes, testing::Contains(HasSubstr("interpolated (cubic)")));
  EXPECT_THAT(site.grid.cell_m, DoubleNear(std::sqrt(std::cos(30.0 * kRadians)), 1e-4));
  EXPECT_THAT(site.origin_height_m, DoubleNear(1000.0, 1e-3));
  for (std::int64_t r = 0; r < site.grid.rows; ++r) {
    for (std::int64_t c = 0; c < site.grid.columns; ++c) {
      const double east_m = static_cast<double>(c - site.origin_column) * site.grid.cell_m;
      const double north_m = static_cast<double>(r - site.origin_row) * site.grid.cell_m;
      // Reals of 4 bytes tell heights of 1000 m to 0.06 mm.
      ASSERT_THAT(site.grid.At(c, r), DoubleNear(HeightAt(east_m, north_m) - 1000.0, 5e-4));
    }
  }
  ASSERT_TRUE(site.from_geographic.has_value());
  const auto [east_m, north_m] = OnPlane(kLat, kLon, kLat + 1e-4, kLon - 2e-4);
  const auto at = site.from_geographic->At(kLon - 2e-4, kLat + 1e-4);
  EXPECT_THAT(at[0], DoubleNear(east_m, 1e-3));
  EXPECT_THAT(at[1], DoubleNear(north_m, 1e-3));
}

TEST_F(ElevationGdalTest, SquaresOfAMapAreTakenAsTheyAre) {
  TiffText tiff{.columns = 60,
                .values = {},
                .left = -30.5,
                .top = 0,
                .step_x = 1.0,
                .step_y = 1.0,
                .keys = {},
                .doubles = {},
                .no_data = ""};
  tiff.top = kLat * kDegree_m + 30.5;
  for (int r = 0; r < 60; ++r) {
    for (int c = 0; c < 60; ++c) tiff.values.push_back(0.5 * c - 2.0 * r);
  }
  image_files::EquirectangularKeys(tiff, kLat);
  const auto file = Write("map.tif", image_files::TiffBytes(tiff));
  const SiteElevation site = ReadElevation({.file = file, .at = {{kLat, 0.0}}, .size_m = 20.0});
  EXPECT_FALSE(site.resampled);
  EXPECT_THAT(site.grid.cell_m, DoubleNear(1.0, 1e-3));
  EXPECT_EQ(site.grid.rows, 21);
  EXPECT_EQ(site.grid.At(site.origin_column + 3, site.origin_row + 1), 3.5);
  // The same place by the map's own numbers.
  const SiteElevation by_map = ReadElevation(
      {.file = file, .at = {{0.0, kLat * kDegree_m}}, .size_m = 20.0, .by_map = true});
  EXPECT_EQ(by_map.grid.heights_m, site.grid.heights_m);
  // A degree of latitude away a map of this parallel is stretched by 1 %.
  tiff.top += 2.0 * kDegree_m;
  const auto farther = Write("far.tif", image_files::TiffBytes(tiff));
  EXPECT_TRUE(
      ReadElevation({.file = farther, .at = {{kLat + 2.0, 0.0}}, .size_m = 20.0}).resampled);
}

TEST_F(ElevationGdalTest, GapsAreToldWithAPlaceWithoutThem) {
  const core::Problem problem = ProblemsOf([&] {
    ReadElevation({.file = Geographic(65), .at = {{kLat, kLon}}, .size_m = 20.0});
  })[0];
  EXPECT_THAT(problem.reason, HasSubstr("no data at"));
  const std::string& text = problem.suggestion;
  const std::size_t at = text.find("--at ");
  ASSERT_NE(at, std::string::npos) << text;
  double latitude = 0.0;
  double longitude = 0.0;
  ASSERT_EQ(std::sscanf(text.c_str() + at, "--at %lf,%lf", &latitude, &longitude), 2);
  EXPECT_NO_THROW(
      ReadElevation({.file = Geographic(65), .at = {{latitude, longitude}}, .size_m = 20.0}));
  EXPECT_NE(longitude, kLon);
}

TEST_F(ElevationGdalTest, PlacesElsewhereAreRefused) {
  const auto path = [&](double lat, double lon) {
    return ProblemsOf([&] {
             ReadElevation({.file = Geographic(), .at = {{lat, lon}}, .size_m = 20.0});
           })[0]
        .path;
  };
  EXPECT_EQ(path(kLat + 1.0, kLon), "--at");
  EXPECT_EQ(path(kLat, kLon + 90.0), "--at");
  EXPECT_EQ(path(91.0, kLon), "--at");
}

TEST_F(ElevationGdalTest, SitesHavePlaces) {
  const SiteScan scan = ScanSites({.file = Geographic(), .size_m = 20.0, .count = 1});
  ASSERT_EQ(scan.sites.size(), 1U);
  double place[2] = {0.0, 0.0};
  ASSERT_EQ(std::sscanf(scan.sites[0].place.c_str(), "%lf,%lf", &place[0], &place[1]), 2);
  EXPECT_NO_THROW(
      ReadElevation({.file = Geographic(), .at = {{place[0], place[1]}}, .size_m = 10.0}));
}

}  // namespace
}  // namespace rockyard::campaign
