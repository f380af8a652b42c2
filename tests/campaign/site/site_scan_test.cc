#include "campaign/site/site_scan.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "campaign/site/site_files.h"

namespace rockyard::campaign {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180.0;

class SiteScanTest : public SiteTest {
 protected:
  // Strips of 40 columns of 1 m that rise by 2, 12 and 5 degrees to the east; a gap in the second.
  std::filesystem::path Strips() const {
    return WriteModel(80, 120, [](double r, double c) {
      if (r == 10.0 && c == 60.0) return std::nan("");
      const double second = 40.0 * std::tan(2.0 * kDegree);
      const double third = second + 40.0 * std::tan(12.0 * kDegree);
      if (c < 40.0) return c * std::tan(2.0 * kDegree);
      if (c < 80.0) return second + (c - 40.0) * std::tan(12.0 * kDegree);
      return third + (c - 80.0) * std::tan(5.0 * kDegree);
    });
  }
};

TEST_F(SiteScanTest, SlopesInARangeNearestToItsMiddleFirst) {
  const SiteScan scan =
      ScanSites({.file = Strips(), .size_m = 19.0, .median = {{4.0, 9.0}}, .cell_m = 1.0});
  EXPECT_EQ(scan.windows, 7 * 11);
  EXPECT_GT(scan.incomplete, 0);
  ASSERT_FALSE(scan.sites.empty());
  for (const ScannedSite& site : scan.sites) {
    EXPECT_THAT(site.slopes.median_deg, DoubleNear(5.0, 1e-6));
    EXPECT_GE(site.window.column, 70);
  }
  // Eight windows of 20 x 20 fit beside each other.
  EXPECT_EQ(scan.sites.size(), 8U);
}

TEST_F(SiteScanTest, TheSmoothestFirstWithoutARange) {
  const SiteScan scan = ScanSites({.file = Strips(), .size_m = 19.0, .count = 3, .cell_m = 1.0});
  ASSERT_EQ(scan.sites.size(), 3U);
  for (const ScannedSite& site : scan.sites) {
    EXPECT_THAT(site.slopes.median_deg, DoubleNear(2.0, 1e-6));
    EXPECT_THAT(site.relief_m, DoubleNear(19.0 * std::tan(2.0 * kDegree), 1e-9));
  }
  const image_files::RasterWindow& first = scan.sites.front().window;
  EXPECT_THAT((std::vector<std::int64_t>{first.row, first.column, first.rows, first.columns}),
              ElementsAre(0, 0, 20, 20));
  EXPECT_EQ(scan.sites.front().place, "9.00,70.00");
}

TEST_F(SiteScanTest, GapsAreNoSites) {
  const SiteScan all = ScanSites({.file = Strips(), .size_m = 19.0, .count = 1000, .cell_m = 1.0});
  for (const ScannedSite& site : all.sites) {
    const image_files::RasterWindow& w = site.window;
    EXPECT_FALSE(w.row <= 10 && 10 < w.row + w.rows && w.column <= 60 && 60 < w.column + w.columns);
  }
}

TEST_F(SiteScanTest, NoneAndWrongSizes) {
  EXPECT_TRUE(ScanSites({.file = Strips(), .size_m = 19.0, .median = {{40.0, 50.0}}, .cell_m = 1.0})
                  .sites.empty());
  EXPECT_TRUE(ScanSites({.file = Strips(), .size_m = 19.0, .high = {{40.0, 50.0}}, .cell_m = 1.0})
                  .sites.empty());
  EXPECT_THAT(
      ProblemsOf([&] { ScanSites({.file = Strips(), .size_m = 5.0, .cell_m = 1.0}); })[0].reason,
      HasSubstr("6 cells"));
  EXPECT_THAT(
      ProblemsOf([&] { ScanSites({.file = Strips(), .size_m = 80.0, .cell_m = 1.0}); })[0].reason,
      HasSubstr("is larger than"));
}

}  // namespace
}  // namespace rockyard::campaign
