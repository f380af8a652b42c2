// The map of a site that a navigator gets before it drives: against the terrain that it was made
// of, and the errors that it is told to have.
#include "trial/course/site_map.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "core/archive.h"
#include "core/json_text.h"
#include "core/random.h"
#include "core/refusals.h"
#include "core/statistical_checks.h"
#include "navigation/navigator.h"
#include "trial/course/goal_designation.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

using testing::Each;
using testing::IsEmpty;
using testing::SizeIs;

constexpr core::TrialKey kKey{3, 5};

// A course of 8 m along x, of whose map nothing is wrong.
CourseParams Course(SiteMapKind kind = SiteMapKind::kBoth) {
  CourseParams course;
  course.start_x_m = 0.0;
  course.start_y_m = 0.0;
  course.goal_x_m = 8.0;
  course.goal_y_m = 0.0;
  course.site_map = {
      .kind = kind, .cell_m = 1.0, .height_sd_m = 0.0, .shift_sd_m = 0.0, .margin_m = 2.0};
  return course;
}

terrain::Ground Slope(double slope_rad, double direction_rad) {
  terrain::GroundParams params;
  params.slope_rad = slope_rad;
  params.slope_direction_rad = direction_rad;
  return {params, kKey};
}

// A dome on level ground.
terrain::Rock Dome(double x_m, double y_m, double radius_m, double height_m) {
  return {.center_W = {x_m, y_m, 0.0},
          .semi_axes_m = {radius_m, radius_m, height_m},
          .diameter_m = 2.0 * radius_m,
          .height_m = height_m};
}

terrain::Terrain Rocks() {
  return {terrain::Ground(),
          {Dome(1.3, 0.4, 0.9, 0.5), Dome(4.0, -1.0, 0.3, 0.8), Dome(7.9, 1.6, 1.7, 0.2)},
          {}};
}

messages::SiteMap MapOf(const CourseParams& course, const terrain::Terrain& terrain,
                        core::TrialKey key = kKey) {
  const auto map = MakeSiteMap(course, terrain, key);
  return map == nullptr ? messages::SiteMap{} : *map;
}

TEST(SiteMapTest, NoneIsNone) {
  EXPECT_EQ(MakeSiteMap(Course(SiteMapKind::kNone), Rocks(), kKey), nullptr);
  EXPECT_EQ(MakeSiteMap(CourseParams{}, Rocks(), kKey), nullptr) << "the default";
}

// From orbit only large rocks are told apart: the dome of 0.6 m has no share, but raises heights.
TEST(SiteMapTest, SmallRocksAreNotToldApart) {
  CourseParams course = Course();
  const messages::SiteMap all = MapOf(course, Rocks());
  course.site_map.min_rock_m = 0.61;
  const messages::SiteMap large = MapOf(course, Rocks());
  EXPECT_EQ(large.height_m, all.height_m);
  const std::size_t small_rock = all.Index(6, 1);  // the cell from (4, -1) on
  EXPECT_GT(all.rock_share[small_rock], 0.0);
  EXPECT_EQ(large.rock_share[small_rock], 0.0);
  const std::size_t large_rock = all.Index(3, 2);  // from (1, 0) on
  EXPECT_GT(all.rock_share[large_rock], 0.0);
  EXPECT_EQ(large.rock_share[large_rock], all.rock_share[large_rock]);
  course.site_map.min_rock_m = 0.6;
  EXPECT_EQ(MapOf(course, Rocks()).rock_share, all.rock_share);
}

TEST(SiteMapTest, AKindHoldsWhatItIsNamedFor) {
  const messages::SiteMap both = MapOf(Course(SiteMapKind::kBoth), Rocks());
  const messages::SiteMap elevation = MapOf(Course(SiteMapKind::kElevation), Rocks());
  const messages::SiteMap rocks = MapOf(Course(SiteMapKind::kRocks), Rocks());
  EXPECT_THAT(both.height_m, SizeIs(both.nx * both.ny));
  EXPECT_THAT(both.rock_share, SizeIs(both.nx * both.ny));
  EXPECT_EQ(elevation.height_m, both.height_m);
  EXPECT_THAT(elevation.rock_share, IsEmpty());
  EXPECT_THAT(rocks.height_m, IsEmpty());
  EXPECT_EQ(rocks.rock_share, both.rock_share);
}

TEST(SiteMapTest, ReachesByItsMarginBeyondAllPlaces) {
  const messages::SiteMap plain = MapOf(Course(), Rocks());
  EXPECT_EQ(plain.x0_m, -2.0);
  EXPECT_EQ(plain.y0_m, -2.0);
  EXPECT_EQ(plain.step_m, 1.0);
  EXPECT_EQ(plain.nx, 12);
  EXPECT_EQ(plain.ny, 4);

  // Waypoints lie on the other side of the start, and off the line.
  CourseParams course = Course();
  course.waypoints = {.x_m = {-3.0, 4.0}, .y_m = {1.5, -2.5}};
  course.site_map.cell_m = 0.75;
  const messages::SiteMap map = MapOf(course, Rocks());
  EXPECT_EQ(map.x0_m, -5.0);
  EXPECT_EQ(map.y0_m, -4.5);
  EXPECT_EQ(map.nx, 20);  // 15 m
  EXPECT_EQ(map.ny, 11);  // 8 m, and the last cell reaches a little beyond
  EXPECT_THAT(map.height_m, SizeIs(220));
  course.site_map.height_sd_m = 0.25;
  EXPECT_EQ(MapOf(course, Rocks()).height_sd_m, 0.25);
}

TEST(SiteMapTest, ACourseToTheLeftHasItsCornerThere) {
  CourseParams course = Course();
  course.goal_x_m = -8.0;
  course.goal_y_m = -1.0;
  const messages::SiteMap map = MapOf(course, Rocks());
  EXPECT_EQ(map.x0_m, -10.0);
  EXPECT_EQ(map.y0_m, -3.0);
  EXPECT_EQ(map.nx, 12);
  EXPECT_EQ(map.ny, 5);
}

// In closed form: the mean over a cell of a plane is that at its middle.
TEST(SiteMapTest, HeightsOfAPlaneAreThoseOfTheMiddles) {
  const terrain::Ground ground = Slope(0.2, 0.6);
  const messages::SiteMap map = MapOf(Course(), {ground, {}, {}});
  for (int iy = 0; iy < map.ny; ++iy) {
    for (int ix = 0; ix < map.nx; ++ix) {
      EXPECT_NEAR(map.height_m[map.Index(ix, iy)],
                  ground.Height(map.x0_m + ix + 0.5, map.y0_m + iy + 0.5), 1e-12)
          << ix << " " << iy;
    }
  }
  EXPECT_THAT(map.rock_share, Each(0.0));
}

// Sums of this test's own over 5 x 5 places of each cell.
TEST(SiteMapTest, HeightsAndSharesAreThoseOfTheTerrain) {
  const terrain::Terrain terrain = Rocks();
  CourseParams course = Course();
  course.site_map.cell_m = 0.5;
  const messages::SiteMap map = MapOf(course, terrain);
  double rocks_m2 = 0.0;
  for (std::size_t cell = 0; cell < map.height_m.size(); ++cell) {
    const double west_m = map.x0_m + 0.5 * static_cast<double>(cell % 24);
    const double south_m = map.y0_m + 0.5 * std::floor(static_cast<double>(cell) / 24.0);
    double sum_m = 0.0;
    int on_rock = 0;
    for (const double x : {0.05, 0.15, 0.25, 0.35, 0.45}) {
      for (const double y : {0.05, 0.15, 0.25, 0.35, 0.45}) {
        sum_m += terrain.Height(west_m + x, south_m + y);
        on_rock += terrain.Height(west_m + x, south_m + y) > 0.0 ? 1 : 0;
      }
    }
    EXPECT_NEAR(map.height_m[cell], sum_m / 25.0, 1e-12) << cell;
    EXPECT_EQ(map.rock_share[cell], on_rock / 25.0) << cell;
    rocks_m2 += 0.25 * map.rock_share[cell];
  }
  // What the three domes cover, but for what of the last lies beyond the map: y > 2.
  const double circles_m2 = std::numbers::pi * (0.9 * 0.9 + 0.3 * 0.3);
  EXPECT_GT(rocks_m2, circles_m2);
  EXPECT_LT(rocks_m2, circles_m2 + std::numbers::pi * 1.7 * 1.7);
}

TEST(SiteMapTest, ATrialHasTheSameMapWheneverItIsMade) {
  CourseParams course = Course();
  course.site_map.height_sd_m = 0.2;
  course.site_map.shift_sd_m = 0.5;
  const messages::SiteMap map = MapOf(course, Rocks());
  const messages::SiteMap again = MapOf(course, Rocks());
  EXPECT_EQ(map.height_m, again.height_m);
  EXPECT_EQ(map.rock_share, again.rock_share);
  EXPECT_NE(map.height_m, MapOf(course, Rocks(), {3, 6}).height_m) << "another trial";
  EXPECT_NE(map.height_m, MapOf(course, Rocks(), {4, 5}).height_m) << "another seed";
}

double NormalCdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

// Kolmogorov and Smirnov, alpha 0.001; 4800 heights of level ground, 48 in each of 100 trials of
// seed 3.
TEST(SiteMapTest, HeightsErrAsStated) {
  CourseParams course = Course();
  course.site_map.height_sd_m = 0.3;
  const terrain::Terrain level(terrain::Ground(), {}, {});
  std::vector<double> errors;
  double neighbours = 0.0;
  for (std::uint32_t trial = 0; trial < 100; ++trial) {
    const messages::SiteMap map = MapOf(course, level, {3, trial});
    for (std::size_t i = 0; i < map.height_m.size(); ++i) {
      errors.push_back(map.height_m[i] / 0.3);
      if (i > 0) neighbours += errors[errors.size() - 1] * errors[errors.size() - 2];
    }
    EXPECT_THAT(map.rock_share, Each(0.0)) << "shares do not err";
  }
  ASSERT_EQ(errors.size(), 4800U);
  EXPECT_GT(core::KolmogorovP(errors, NormalCdf), 0.001);
  // Independent of one another: the mean product of two standard normals has the deviation
  // 1 / sqrt(n). Two-sided, alpha 0.001.
  EXPECT_GT(2.0 * NormalCdf(-std::abs(neighbours) / std::sqrt(4700.0)), 0.001);
  // Negative control: errors 15 % larger than stated.
  for (double& z : errors) z *= 1.15;
  EXPECT_LT(core::KolmogorovP(errors, NormalCdf), 0.001);
}

// By how much the map of a trial lies off, as two planes tell it that rise along x and along y: it
// shows at a place what is truly a shift before it.
std::array<double, 2> ShiftOf(const CourseParams& course, core::TrialKey key) {
  constexpr double kSlope_rad = 0.5;
  static const terrain::Terrain kAlongX(Slope(kSlope_rad, 0.0), {}, {});
  static const terrain::Terrain kAlongY(Slope(kSlope_rad, 0.5 * std::numbers::pi), {}, {});
  const messages::SiteMap x = MapOf(course, kAlongX, key);
  const messages::SiteMap y = MapOf(course, kAlongY, key);
  const double half_m = 0.5 * x.step_m;
  return {x.x0_m + half_m - x.height_m.front() / std::tan(kSlope_rad),
          y.y0_m + half_m - y.height_m.front() / std::tan(kSlope_rad)};
}

// Kolmogorov and Smirnov, alpha 0.001 each; 4000 trials of seed 3, with a map of one cell.
TEST(SiteMapTest, TheWholeMapLiesOffAsStated) {
  CourseParams course = Course(SiteMapKind::kElevation);
  course.site_map.shift_sd_m = 0.5;
  course.site_map.cell_m = 12.0;
  std::vector<double> x;
  std::vector<double> y;
  double product = 0.0;
  constexpr std::uint32_t kTrials = 4000;
  for (std::uint32_t trial = 0; trial < kTrials; ++trial) {
    const auto [shift_x_m, shift_y_m] = ShiftOf(course, {3, trial});
    x.push_back(shift_x_m / 0.5);
    y.push_back(shift_y_m / 0.5);
    product += x.back() * y.back();
  }
  EXPECT_GT(core::KolmogorovP(x, NormalCdf), 0.001);
  EXPECT_GT(core::KolmogorovP(y, NormalCdf), 0.001);
  // Independent, as of heights above.
  EXPECT_GT(2.0 * NormalCdf(-std::abs(product) / std::sqrt(double{kTrials})), 0.001);
  // Negative control: maps that lie off by 15 % more.
  for (double& z : x) z *= 1.15;
  EXPECT_LT(core::KolmogorovP(x, NormalCdf), 0.001);
}

// All cells are shifted alike, heights and rocks.
TEST(SiteMapTest, TheShiftIsOneOfTheMap) {
  CourseParams course = Course();
  course.site_map.shift_sd_m = 2.0;
  const auto [shift_x_m, shift_y_m] = ShiftOf(course, kKey);
  EXPECT_GT(std::hypot(shift_x_m, shift_y_m), 0.1);
  // The same map, made without an error where everything stands so much elsewhere.
  std::vector<terrain::Rock> moved;
  const terrain::Terrain rocks = Rocks();
  for (terrain::Rock rock : rocks.rocks()) {
    rock.center_W += math::Vector3(shift_x_m, shift_y_m, 0.0);
    moved.push_back(rock);
  }
  const messages::SiteMap map = MapOf(course, rocks);
  const messages::SiteMap expected = MapOf(Course(), {terrain::Ground(), moved, {}});
  EXPECT_EQ(map.x0_m, expected.x0_m) << "where it believes to lie";
  ASSERT_EQ(map.height_m.size(), expected.height_m.size());
  for (std::size_t i = 0; i < map.height_m.size(); ++i) {
    EXPECT_NEAR(map.height_m[i], expected.height_m[i], 1e-6) << i;
    EXPECT_NEAR(map.rock_share[i], expected.rock_share[i], 0.041) << "a place on the very edge";
  }
}

// Records depend on which numbers are drawn, in which order.
TEST(SiteMapTest, ErrorsAreThoseOfTheStreamsThatAreNamed) {
  CourseParams course = Course();
  course.site_map.shift_sd_m = 0.5;
  core::RandomStream shifts(kKey, core::Purpose::kSiteMap, 0);
  const auto [shift_x_m, shift_y_m] = ShiftOf(course, kKey);
  EXPECT_NEAR(shift_x_m, core::SampleNormal(shifts, 0.0, 0.5), 1e-12);
  EXPECT_NEAR(shift_y_m, core::SampleNormal(shifts, 0.0, 0.5), 1e-12);

  course.site_map.height_sd_m = 0.2;
  core::RandomStream errors(kKey, core::Purpose::kSiteMap, 1);
  for (const double height_m : MapOf(course, {terrain::Ground(), {}, {}}).height_m) {
    EXPECT_EQ(height_m, core::SampleNormal(errors, 0.0, 0.2));
  }
}

// Neither error moves the other, nor does what the map holds.
TEST(SiteMapTest, OneErrorShiftsNoOther) {
  CourseParams course = Course();
  course.site_map.shift_sd_m = 0.5;
  const auto shift_m = ShiftOf(course, kKey);
  course.site_map.height_sd_m = 1e-9;
  const auto with_heights_m = ShiftOf(course, kKey);
  EXPECT_NEAR(with_heights_m[0], shift_m[0], 1e-6);
  EXPECT_NEAR(with_heights_m[1], shift_m[1], 1e-6);

  const terrain::Terrain level(terrain::Ground(), {}, {});
  course.site_map.height_sd_m = 0.2;
  const messages::SiteMap map = MapOf(course, level);
  course.site_map.shift_sd_m = 0.0;
  EXPECT_EQ(MapOf(course, level).height_m, map.height_m);
  course.site_map.kind = SiteMapKind::kElevation;
  EXPECT_EQ(MapOf(course, level).height_m, map.height_m);
}

TEST(SiteMapTest, OfMoreThanAThousandCellsASideIsRefused) {
  const auto problems = [](const char* json) {
    CourseParams course;
    return core::ProblemsIn([&] { core::ReadParams(core::ParseJson(json, "test"), course); });
  };
  EXPECT_THAT(problems(R"({"goal_x_m": 8, "site_map":
                           {"kind": "both", "cell_m": 0.1, "margin_m": 46}})"),
              IsEmpty());
  EXPECT_THAT(problems(R"({"goal_x_m": 8, "site_map":
                           {"kind": "both", "cell_m": 0.1, "margin_m": 46.1}})"),
              core::OneProblem("site_map", "1000 cells", "margin_m"));
  EXPECT_THAT(problems(R"({"goal_x_m": 8, "goal_y_m": -8, "site_map":
                           {"kind": "rocks", "cell_m": 0.1, "margin_m": 500}})"),
              core::OneProblem("site_map", "1000 cells"));
  EXPECT_THAT(problems(R"({"site_map": {"cell_m": 0.1, "margin_m": 500}})"), IsEmpty())
      << "of no map";
}

// A navigator that keeps what it is told at the start of a drive, and gives up.

struct ToyParams {
  std::shared_ptr<navigation::NavigatorSetup> told = std::make_shared<navigation::NavigatorSetup>();

  void Visit(core::FieldVisitor&) {}
};

class Toy final : public navigation::Navigator {
 public:
  navigation::NavigatorDecision Decide(const navigation::NavigatorInput&) override {
    return navigation::Finish(navigation::NavigatorStatus::kGaveUp);
  }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) override {}
  void SetGoal(const messages::Goal&, navigation::GoalChange) override {}
};

// What a drive tells its navigator.
navigation::NavigatorSetup ToldIn(core::TrialKey key, DriveParams* of = nullptr) {
  const ToyParams params;
  scenario::Scenario defaults;
  defaults.drive.navigation.navigators.Add<ToyParams>(
      {.name = "toy",
       .doc = "keeps what it is told",
       .traits = [](const ToyParams&) -> navigation::NavigatorTraits {
         return {navigation::LookReading::kNothing, navigation::CostOfLook{}, {"", 0.1}};
       },
       .make = [](const ToyParams& toy, const navigation::NavigatorSetup& setup)
           -> std::unique_ptr<navigation::Navigator> {
         *toy.told = setup;
         return std::make_unique<Toy>();
       }},
      params);
  const Overrides toy = {"navigation.navigator=toy",
                         "rover.fidelity=quasi_static",
                         "rover.drive.speed_m_s=0.11",
                         "perception.hazard.enabled=false",
                         "course.goal_x_m=8",
                         "course.waypoints.x_m=[3,5]",
                         "course.waypoints.y_m=[0.5,-0.5]",
                         "course.site_map.kind=both",
                         "clock.control_rate_hz=10",
                         "clock.compute.operations_per_s=5e6",
                         "navigation.limits.memory_mb=123"};
  const DriveParams drive = scenario::Shipped("pathfinder/nominal", toy, defaults).drive;
  RunTrial(drive, key);
  if (of != nullptr) *of = drive;
  return *params.told;
}

TEST(NavigatorSetupTest, HoldsTheMapAndAllElseThatADriveKnows) {
  DriveParams drive;
  const navigation::NavigatorSetup told = ToldIn(kKey, &drive);
  const std::vector<messages::Goal> places = DesignatedGoals(drive.course, kKey);
  ASSERT_EQ(told.places.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(told.places[i].x_m, places[i].x_m);
    EXPECT_EQ(told.places[i].y_m, places[i].y_m);
  }
  EXPECT_EQ(told.goal.x_m, told.places[0].x_m);
  EXPECT_FALSE(told.judges_hazards);
  EXPECT_EQ(told.full_speed_m_s, 0.11);
  EXPECT_NEAR(told.control_period_s, 0.1, 0.02);
  EXPECT_EQ(told.operations_per_s, 5e6);
  EXPECT_EQ(told.limits.memory_mb, 123.0);
  EXPECT_EQ(told.rover.length_m, drive.rover.geometry.length_m);
  EXPECT_EQ(told.rover.width_m, drive.rover.geometry.width_m);
  EXPECT_EQ(told.rover.drive.wheel_radius_m, drive.rover.geometry.wheel_radius_m);
  ASSERT_NE(told.site_map, nullptr);
  EXPECT_EQ(told.site_map->nx, 28);
  EXPECT_THAT(told.site_map->rock_share, testing::Contains(testing::Gt(0.0)));
}

// A generator of its own: the same whenever the trial is run, and another one in each.
TEST(NavigatorSetupTest, HasASeedOfTheTrial) {
  const navigation::NavigatorSetup told = ToldIn({3, 5});
  const navigation::NavigatorSetup again = ToldIn({3, 5});
  EXPECT_EQ(told.random_seed, again.random_seed);
  EXPECT_EQ(told.site_map->height_m, again.site_map->height_m);
  EXPECT_NE(told.random_seed, ToldIn({3, 6}).random_seed);
  EXPECT_NE(told.random_seed, ToldIn({4, 5}).random_seed);
}

}  // namespace
}  // namespace rockyard::trial
