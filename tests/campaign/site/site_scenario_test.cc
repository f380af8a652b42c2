#include "campaign/site/site_scenario.h"

#include <gmock/gmock.h>

#include <cmath>
#include <optional>
#include <utility>

#include "campaign/site/site_files.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "scenario/load.h"
#include "terrain/arena.h"

namespace rockyard::campaign {
namespace {

using testing::Contains;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

class SiteScenarioTest : public SiteTest {
 protected:
  // A rough slope of 61 x 51 nodes of 1 m, which rises to the north.
  std::filesystem::path Slope() const {
    return WriteModel(61, 51, [](double r, double c) {
      return -0.05 * r + 0.02 * std::sin(2.0 * r * r + 3.0 * c) + 0.03 * std::sin(c * c);
    });
  }
  SiteRequest Request(const std::string& base = "pathfinder/nominal") const {
    SiteRequest request;
    request.base = std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/" + base + ".json";
    request.out = own_.path() / "my_site.json";
    request.elevation = ElevationRequest{.file = Slope(), .cell_m = 1.0};
    return request;
  }
  // What the written file holds.
  scenario::Scenario Loaded(const SiteRequest& request) {
    made_ = MakeSiteScenario(request);
    Write("my_site.json", core::DumpJson(made_.document));
    return scenario::LoadScenario(request.out);
  }

  SiteScenario made_;
};

TEST_F(SiteScenarioTest, HasTheModelAndWhatTheBaseHas) {
  const scenario::Scenario site = Loaded(Request());
  EXPECT_EQ(site.name, "my_site");
  EXPECT_EQ(site.trials, 300);
  EXPECT_EQ(site.drive.terrain.rocks.k_per_m2, 0.00415);
  const terrain::ElevationParams& elevation = site.drive.terrain.ground.elevation;
  EXPECT_EQ(elevation.columns, 51);
  EXPECT_EQ(elevation.heights_m.size(), 61U * 51U);
  EXPECT_EQ(elevation.origin_column, 25);
  EXPECT_EQ(elevation.origin_row, 30);
  EXPECT_EQ(elevation.heights_m[30 * 51 + 25], 0.0);
  EXPECT_LT(elevation.heights_m[25], -1.0) << "the first row is the southernmost";
  EXPECT_THAT(elevation.source, HasSubstr("model.npy"));
  EXPECT_EQ(site.drive.terrain.rocks.pointedness, 0.0);
}

TEST_F(SiteScenarioTest, TheArenaLiesInTheModel) {
  for (const image_files::RasterWindow& crop :
       {image_files::RasterWindow{0, 0, 61, 51}, {0, 0, 40, 21}, {3, 3, 8, 30}}) {
    SiteRequest request = Request();
    request.elevation->crop = crop;
    const scenario::Scenario site = Loaded(request);
    const terrain::Rectangle bounds = terrain::DrivableBounds(site.drive.terrain.arena);
    const terrain::ElevationParams& model = site.drive.terrain.ground.elevation;
    const auto rows = static_cast<std::int64_t>(model.heights_m.size()) / model.columns;
    EXPECT_GE(bounds.x_min_m, -static_cast<double>(model.origin_column));
    EXPECT_LE(bounds.x_max_m, static_cast<double>(model.columns - 1 - model.origin_column));
    EXPECT_GE(bounds.y_min_m, -static_cast<double>(model.origin_row));
    EXPECT_LE(bounds.y_max_m, static_cast<double>(rows - 1 - model.origin_row));
    // And fills it, but for what lies on one side of y = 0 alone, and a margin of a tenth.
    EXPECT_GE(bounds.x_max_m - bounds.x_min_m, static_cast<double>(model.columns) - 1.01);
    EXPECT_GE(bounds.y_max_m - bounds.y_min_m, static_cast<double>(rows) - 2.01);
  }
}

TEST_F(SiteScenarioTest, TheCourseLiesAroundTheOrigin) {
  const trial::CourseParams course = Loaded(Request()).drive.course;
  EXPECT_EQ(course.start_x_m, -3.8);
  EXPECT_EQ(course.goal_x_m, 3.8);
  EXPECT_EQ(course.start_y_m, 0.0);
  EXPECT_EQ(course.goal_y_m, 0.0);
  SiteRequest request = Request();
  request.start = {{-10.0, -5.0}};
  request.goal = {{-10.0, 15.0}};
  const trial::CourseParams north = Loaded(request).drive.course;
  EXPECT_EQ(north.start_y_m, -5.0);
  EXPECT_EQ(north.goal_y_m, 15.0);
  EXPECT_THAT(north.start_heading_rad, DoubleNear(std::acos(0.0), 1e-4));
}

TEST_F(SiteScenarioTest, ACourseThatDoesNotFitIsShortened) {
  SiteRequest request = Request();
  request.elevation->crop = image_files::RasterWindow{0, 0, 20, 10};
  const trial::CourseParams course = Loaded(request).drive.course;
  EXPECT_LT(course.goal_x_m - course.start_x_m, 7.6);
  EXPECT_GT(course.goal_x_m - course.start_x_m, 4.0);
  EXPECT_THAT(made_.notes, Contains(HasSubstr("do not fit")));
  request.elevation->crop = image_files::RasterWindow{0, 0, 4, 4};
  EXPECT_EQ(ProblemsOf([&] { MakeSiteScenario(request); })[0].path, "--size");
  request = Request();
  request.goal = {{100.0, 0.0}};
  EXPECT_EQ(ProblemsOf([&] { MakeSiteScenario(request); })[0].path, "--goal");
}

TEST_F(SiteScenarioTest, RoughnessGoesOnBelowTheModel) {
  const terrain::GroundParams ground = Loaded(Request()).drive.terrain.ground;
  ASSERT_TRUE(made_.figures->roughness.has_value());
  EXPECT_EQ(ground.roughness_rms_m, made_.figures->roughness->rms_m);
  EXPECT_GT(ground.roughness_rms_m, 0.0);
  const double octaves = std::log2(ground.roughness_wavelength_m / ground.elevation.cell_m);
  EXPECT_EQ(octaves, std::round(octaves));
  SiteRequest request = Request();
  request.roughness = false;
  EXPECT_EQ(Loaded(request).drive.terrain.ground.roughness_rms_m, 0.0);
}

TEST_F(SiteScenarioTest, RocksOfTheLawEndAtTheResolution) {
  SiteRequest request = Request();
  request.resolution_m = 1.0;
  EXPECT_EQ(Loaded(request).drive.terrain.rocks.max_diameter_m, 1.0);
  request.base = std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/pathfinder/nominal.json";
  request.elevation->file = WriteModel(101, 101, [](double r, double) { return 0.01 * r; });
  request.elevation->cell_m = 0.25;
  request.resolution_m = 0.5;
  EXPECT_EQ(Loaded(request).drive.terrain.rocks.max_diameter_m, 0.5);
  EXPECT_THAT(made_.notes, Contains(HasSubstr("end at 0.5 m")));
  request.elevation->cell_m = 0.08;
  request.resolution_m = 0.09;
  EXPECT_EQ(Loaded(request).drive.terrain.rocks.kind, terrain::RockFieldKind::kNone);
}

TEST_F(SiteScenarioTest, SettingsAreWrittenOver) {
  SiteRequest request = Request();
  request.overrides = {"trials=7", "terrain.rocks.k_per_m2=0.002"};
  const scenario::Scenario site = Loaded(request);
  EXPECT_EQ(site.trials, 7);
  EXPECT_EQ(site.drive.terrain.rocks.k_per_m2, 0.002);
  request.overrides = {"terrain.rocks.min_diameter_m=0.02"};
  EXPECT_THAT(ProblemsOf([&] { MakeSiteScenario(request); })[0].reason,
              HasSubstr("more than 50000 rocks"));
}

class SiteRocksTest : public SiteScenarioTest {
 protected:
  SiteRequest WithRocks(const std::string& text, bool model) {
    SiteRequest request = Request();
    if (!model) request.elevation.reset();
    request.rocks = CatalogueRequest{.file = Write("rocks.csv", text)};
    return request;
  }
};

TEST_F(SiteRocksTest, BecomeListedRocks) {
  const terrain::RockFieldParams rocks =
      Loaded(WithRocks("x,y,d,h,height_m,burial\n3,0.5,0.4,1,0.2,0.1\n5,-1,0.3,1,,\n99,0,1,1,1,0\n",
                       false))
          .drive.terrain.rocks;
  EXPECT_EQ(rocks.kind, terrain::RockFieldKind::kListed);
  EXPECT_THAT(rocks.listed.x_m, ElementsAre(3.0, 5.0));
  EXPECT_THAT(rocks.listed.y_m, ElementsAre(0.5, -1.0));
  EXPECT_THAT(rocks.listed.diameter_m, ElementsAre(0.4, 0.3));
  // The second has the mean shape of the law's rocks: as high as wide, a third buried.
  EXPECT_THAT(rocks.listed.height_m, ElementsAre(0.2, DoubleNear(0.2, 1e-3)));
  EXPECT_THAT(rocks.listed.buried_share, ElementsAre(0.1, DoubleNear(1.0 / 3.0, 1e-12)));
  EXPECT_TRUE(rocks.listed.yaw_deg.empty());
  EXPECT_EQ(made_.listed, 2U);
  EXPECT_THAT(made_.notes, Contains(HasSubstr("1 rocks of the catalogue lie beyond the arena")));
}

TEST_F(SiteRocksTest, BumpsOfTheModelAreLeftOut) {
  SiteRequest request = WithRocks("x,y,d\n3,0.5,0.4\n5,-1,1.5\n", true);
  request.resolution_m = 1.0;
  EXPECT_THAT(Loaded(request).drive.terrain.rocks.listed.x_m, ElementsAre(3.0));
  EXPECT_THAT(made_.notes, Contains(HasSubstr("--keep-bumps")));
  request.keep_bumps = true;
  EXPECT_THAT(Loaded(request).drive.terrain.rocks.listed.x_m, ElementsAre(3.0, 5.0));
}

TEST_F(SiteRocksTest, PlacesOfTheMap) {
  SiteRequest request = WithRocks("x,y,d\n28,31,0.4\n", true);
  request.rock_places = RockPlaces::kMap;
  const terrain::ListedRocksParams rocks = Loaded(request).drive.terrain.rocks.listed;
  // The origin is the node of column 25 and row 30, so that its map has x 25 and y 30.
  EXPECT_THAT(rocks.x_m, ElementsAre(DoubleNear(3.0, 1e-6)));
  EXPECT_THAT(rocks.y_m, ElementsAre(DoubleNear(1.0, 1e-6)));
}

TEST_F(SiteRocksTest, LongitudesAroundAStatedPlace) {
  SiteRequest request = WithRocks("lon,lat,d\n-222.59999,-4.50001,0.4\n", false);
  EXPECT_THAT(ProblemsOf([&] { MakeSiteScenario(request); })[0].suggestion, HasSubstr("--around"));
  request.around = {{-4.5, 137.4}};
  const terrain::ListedRocksParams rocks = Loaded(request).drive.terrain.rocks.listed;
  const double degree_m = 3389500.0 * std::acos(-1.0) / 180.0;
  EXPECT_THAT(rocks.x_m, ElementsAre(DoubleNear(
                             1e-5 * degree_m * std::cos(4.5 * std::acos(-1.0) / 180.0), 1e-3)));
  EXPECT_THAT(rocks.y_m, ElementsAre(DoubleNear(-1e-5 * degree_m, 1e-3)));
}

TEST_F(SiteRocksTest, TheLawGoesOnBelowTheSmallest) {
  SiteRequest request = WithRocks("x,y,d\n3,0.5,0.4\n5,-1,0.3\n", false);
  request.rest = true;
  const terrain::RockFieldParams rocks = Loaded(request).drive.terrain.rocks;
  EXPECT_EQ(rocks.listed.rest, terrain::RestOfRocks::kMoore);
  EXPECT_EQ(rocks.max_diameter_m, 0.3);
  request.rocks->file = Write("small.csv", "x,y,d\n3,0.5,0.05\n");
  EXPECT_EQ(ProblemsOf([&] { MakeSiteScenario(request); })[0].path, "--rest");
}

TEST_F(SiteRocksTest, OutsideAltogetherIsRefused) {
  EXPECT_THAT(ProblemsOf([&] { MakeSiteScenario(WithRocks("x,y,d\n300,0,1\n", false)); })[0].reason,
              HasSubstr("none of whose rocks"));
}

TEST_F(SiteScenarioTest, RoughnessBeyondWhatAScenarioMayHaveIsCutAndTold) {
  const auto told = [&](double height_m) {
    SiteElevation elevation;
    elevation.grid = {1.0, 40, 40, {}};
    for (int i = 0; i < 1600; ++i) {
      elevation.grid.heights_m.push_back(height_m * std::sin(7.0 * i * i));
    }
    return FiguresOf(std::move(elevation), std::nullopt);
  };
  const SiteFigures rough = told(5.0);
  ASSERT_TRUE(rough.roughness);
  EXPECT_EQ(rough.roughness->rms_m, 0.5);
  EXPECT_THAT(rough.elevation.notes, Contains(HasSubstr("is cut to 0.5 m")));
  EXPECT_THAT(told(0.05).elevation.notes, testing::IsEmpty());
}

}  // namespace
}  // namespace rockyard::campaign
