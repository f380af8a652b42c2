#include "campaign/site/elevation_file.h"

#include <gmock/gmock.h>

#include <cmath>

#include "campaign/site/height_unit.h"
#include "campaign/site/site_files.h"

namespace rockyard::campaign {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

class ElevationFileTest : public SiteTest {
 protected:
  // A model of 40 rows and 30 columns of 2 m that rises by 1 a column and falls by 100 a row.
  std::filesystem::path Staircase() const {
    return WriteModel(40, 30, [](double r, double c) { return c - 10.0 * r; });
  }
};

TEST_F(ElevationFileTest, XIsEastAndYNorth) {
  const SiteElevation site =
      ReadElevation({.file = Staircase(), .crop = {{4, 6, 5, 7}}, .cell_m = 2.0});
  EXPECT_EQ(site.grid.cell_m, 2.0);
  EXPECT_EQ(site.grid.rows, 5);
  EXPECT_EQ(site.grid.columns, 7);
  EXPECT_EQ(site.origin_column, 3);
  EXPECT_EQ(site.origin_row, 2);
  EXPECT_EQ(site.origin_height_m, 9.0 - 60.0);
  EXPECT_EQ(site.grid.At(3, 2), 0.0);
  EXPECT_EQ(site.grid.At(4, 2), 1.0) << "a node to the east is a column on";
  EXPECT_EQ(site.grid.At(3, 3), 10.0) << "a node to the north is a row before";
  EXPECT_EQ(site.grid.At(0, 0), -3.0 - 20.0);
  EXPECT_FALSE(site.resampled);
  EXPECT_THAT(site.source, HasSubstr("rows 4 to 8, columns 6 to 12"));
  EXPECT_FALSE(site.from_geographic.has_value());
}

// With an even number of rows and columns the origin is the node before the middle in the file.
TEST_F(ElevationFileTest, TheOriginOfEvenCrops) {
  const SiteElevation site =
      ReadElevation({.file = Staircase(), .crop = {{0, 0, 6, 4}}, .cell_m = 2.0});
  EXPECT_EQ(site.origin_column, 1);
  EXPECT_EQ(site.origin_row, 3);
  EXPECT_EQ(site.origin_height_m, 1.0 - 20.0);
}

// The map of a file without a place has its origin in the middle of the last row's first cell.
TEST_F(ElevationFileTest, AroundAPlaceOfTheMap) {
  const SiteElevation site =
      ReadElevation({.file = Staircase(), .at = {{20.0, 30.0}}, .size_m = 16.0, .cell_m = 2.0});
  EXPECT_EQ(site.grid.rows, 9);
  EXPECT_EQ(site.grid.columns, 9);
  EXPECT_EQ(site.origin_column, 4);
  EXPECT_EQ(site.origin_row, 4);
  EXPECT_EQ(site.origin_height_m, 10.0 - 10.0 * (39 - 15));
  EXPECT_THAT(site.from_map.At(20.0, 30.0), ElementsAre(DoubleNear(0, 1e-9), DoubleNear(0, 1e-9)));
  EXPECT_THAT(site.from_map.At(25.0, 28.0), ElementsAre(DoubleNear(5, 1e-9), DoubleNear(-2, 1e-9)));
}

TEST_F(ElevationFileTest, HeightsAreTenthsOfMillimetres) {
  const auto file = WriteModel(4, 4, [](double r, double c) { return 0.00003 * (4.0 * r + c); });
  const SiteElevation site = ReadElevation({.file = file, .cell_m = 1.0});
  EXPECT_EQ(site.grid.At(3, 2), 0.0001);
  EXPECT_EQ(site.grid.At(1, 2), 0.0);
}

TEST_F(ElevationFileTest, UnitsBecomeMetres) {
  std::vector<std::string> notes;
  image_files::RasterInfo info;
  info.unit = "Feet";
  EXPECT_EQ(HeightUnit_m(info, "file", {}, notes), 0.3048);
  info.unit = "km";
  EXPECT_EQ(HeightUnit_m(info, "file", {}, notes), 1000.0);
  info.unit = "meters";
  EXPECT_EQ(HeightUnit_m(info, "file", {}, notes), 1.0);
  EXPECT_EQ(notes.size(), 2U) << "metres go without saying";
  info.unit = "";
  EXPECT_EQ(HeightUnit_m(info, "file", {}, notes), 1.0);
  EXPECT_THAT(notes.back(), HasSubstr("metres are assumed"));
  info.unit = "degC";
  EXPECT_THAT(ProblemsOf([&] { HeightUnit_m(info, "file", {}, notes); })[0].reason,
              HasSubstr("\"degC\""));
  EXPECT_EQ(HeightUnit_m(info, "file", 2.5, notes), 2.5);
  const SiteElevation twice = ReadElevation(
      {.file = Staircase(), .crop = {{0, 0, 5, 5}}, .cell_m = 2.0, .height_scale = 2.0});
  EXPECT_EQ(twice.grid.At(3, 2), 2.0);
}

TEST_F(ElevationFileTest, WrongPartsAreRefused) {
  const auto reason = [&](ElevationRequest request) {
    request.file = Staircase();
    request.cell_m = 2.0;
    return ProblemsOf([&] { ReadElevation(request); })[0];
  };
  EXPECT_EQ(reason({.crop = {{36, 0, 5, 5}}}).path, "--crop");
  EXPECT_EQ(reason({.crop = {{0, -1, 5, 5}}}).path, "--crop");
  EXPECT_EQ(reason({.crop = {{0, 0, 3, 5}}}).path, "--crop");
  EXPECT_EQ(reason({.at = {{20.0, 6.0}}, .size_m = 16.0}).path, "--at");
  EXPECT_EQ(reason({.at = {{1e300, 6.0}}, .size_m = 16.0}).path, "--at");
  EXPECT_EQ(reason({.at = {{20.0, 30.0}}, .size_m = 4.0}).path, "--size");
  EXPECT_EQ(reason({.crop = {{0, 0, 5, 5}}, .at = {{20.0, 30.0}}}).path, "--at");
  EXPECT_THAT(ProblemsOf([&] { ReadElevation({.file = Staircase()}); })[0].suggestion,
              HasSubstr("--cell"));
}

TEST_F(ElevationFileTest, AWholeFileMayBeTooLarge) {
  const auto file = WriteModel(1001, 1000, [](double, double) { return 0.0; });
  EXPECT_THAT(ProblemsOf([&] { ReadElevation({.file = file, .cell_m = 1.0}); })[0].suggestion,
              HasSubstr("--scan-sites"));
  EXPECT_EQ(ReadElevation({.file = file, .crop = {{1, 0, 1000, 1000}}, .cell_m = 1.0}).grid.rows,
            1000);
}

class GapTest : public SiteTest {
 protected:
  // 60 x 60 nodes with a gap of 3 x 3 in the middle.
  std::filesystem::path Holed() const {
    return WriteModel(60, 60, [](double r, double c) {
      return std::max(std::abs(r - 30.0), std::abs(c - 30.0)) < 1.5 ? std::nan("") : 0.1 * c;
    });
  }
};

TEST_F(GapTest, IsToldWithTheNearestPartWithoutIt) {
  const core::Problem problem = ProblemsOf([&] {
    ReadElevation({.file = Holed(), .crop = {{22, 20, 12, 12}}, .cell_m = 1.0});
  })[0];
  EXPECT_THAT(problem.reason, HasSubstr("no data at 9 of the 144 nodes"));
  // A part of 12 rows that begins at 22 has to end before row 29, or in columns before 29.
  EXPECT_THAT(problem.suggestion, HasSubstr("--crop 22,17,12,12"));
  EXPECT_NO_THROW(ReadElevation({.file = Holed(), .crop = {{22, 17, 12, 12}}, .cell_m = 1.0}));
}

TEST_F(GapTest, IsFilledOnRequest) {
  const SiteElevation site =
      ReadElevation({.file = Holed(), .crop = {{20, 20, 20, 20}}, .cell_m = 1.0, .fill = true});
  EXPECT_EQ(site.filled, 9);
  EXPECT_THAT(site.grid.At(10, 9) - site.grid.At(8, 9), DoubleNear(0.2, 2e-4));
  EXPECT_THAT(site.notes, testing::Contains(HasSubstr("9 nodes without data were filled")));
  const auto wide =
      WriteModel(40, 40, [](double r, double) { return r < 20 ? 0.0 : std::nan(""); });
  EXPECT_THAT(
      ProblemsOf([&] { ReadElevation({.file = wide, .cell_m = 1.0, .fill = true}); })[0].reason,
      HasSubstr("in gaps of more than 10 cells"));
}

}  // namespace
}  // namespace rockyard::campaign
