// Maps checked by hand, to the last unit of goodness (Goldberg 2002, section 4, step 3): h = 20 cm,
// patches of 5 x 5 cells, roughness fraction 1.
#include <gtest/gtest.h>

#include <array>

#include "math/angles.h"
#include "navigation/gestalt/clouds.h"

namespace rockyard::navigation {
namespace {

constexpr CellValue kBest{255, 255, true};
constexpr CellValue kBorder{250, 255, true};
constexpr CellValue kUnknown{11, 0, false};

// Goodness of known cells with full certainty.
CellValue Good(int goodness) { return {static_cast<std::uint8_t>(goodness), 255, true}; }

// Every cell of columns [x, x_end) and rows [y, y_end) has `inside`, every other cell that is no
// border cell of the window has `outside`.
void ExpectBlock(const GoodnessGrid& grid, const CellBox& box, CellValue inside,
                 CellValue outside) {
  for (int iy = 2; iy < 19; ++iy) {
    for (int ix = 2; ix < 19; ++ix) {
      const bool in = ix >= box.x && ix < box.x_end && iy >= box.y && iy < box.y_end;
      EXPECT_EQ(grid.Cell(ix, iy), in ? inside : outside) << "cell " << ix << ", " << iy;
    }
  }
}

bool In(double x, double y, const CellBox& box) {
  return x > Edge(box.x) && x < Edge(box.x_end) && y > Edge(box.y) && y < Edge(box.y_end);
}

// Of its 25 cells a patch has 9 in the window where it is around the corner, 12 one cell on along
// the edge: unknown, as 13 are half. Further along it has 15: known, at the border. Inside, cells
// (1, 1), (2, 1) and (1, 2) border what is unknown at the corner.
TEST(GestaltHandTest, LevelGround) {
  const GoodnessGrid grid = GridOf(HandParams(), Level);
  ExpectBlock(grid, {}, {}, kBest);
  for (const int end : {0, 20}) {
    const int beside = end == 0 ? 1 : 19;
    const int second = end == 0 ? 2 : 18;
    EXPECT_EQ(grid.Cell(end, end), kUnknown);
    EXPECT_EQ(grid.Cell(beside, end), kUnknown);
    EXPECT_EQ(grid.Cell(end, beside), kUnknown);
    EXPECT_EQ(grid.Cell(beside, beside), kBorder);
    EXPECT_EQ(grid.Cell(second, beside), kBorder);
    EXPECT_EQ(grid.Cell(beside, second), kBorder);
    for (int i = 2; i < 19; ++i) {
      EXPECT_EQ(grid.Cell(i, end), kBorder) << i;
      EXPECT_EQ(grid.Cell(end, i), kBorder) << i;
    }
    for (int i = 3; i < 18; ++i) EXPECT_EQ(grid.Cell(i, beside), kBest) << i;
  }
}

TEST(GestaltHandTest, OnlyCellsThatShareASideBorderWhereFourAreChosen) {
  GestaltMapParams params = HandParams();
  params.border_neighbours = BorderNeighbours::kFour;
  const GoodnessGrid grid = GridOf(params, Level);
  EXPECT_EQ(grid.Cell(1, 1), kBorder);
  EXPECT_EQ(grid.Cell(2, 1), kBest);
}

// 127 (1 - e/20 cm) from e = 6.67 cm on, in the four columns whose patches hold both sides of a
// step between columns 11 and 12.
TEST(GestaltHandTest, StepOfEachHeight) {
  // Heights of 1 to 20 cm; 63.5 at 10 cm rounds up.
  constexpr std::array<int, 20> kGoodness = {255, 255, 255, 255, 255, 255, 83, 76, 70, 64,
                                             57,  51,  44,  38,  32,  25,  19, 13, 6,  0};
  for (int cm = 1; cm <= 30; ++cm) {
    SCOPED_TRACE(cm);
    const auto step = [cm](double x, double) { return x > Edge(12) ? 0.01 * cm : 0.0; };
    const int goodness = cm <= 20 ? kGoodness[static_cast<std::size_t>(cm - 1)] : 0;
    ExpectBlock(GridOf(HandParams(), step), {10, 14, 0, 21}, Good(goodness), kBest);
  }
}

// A pit of one cell counts in the 5 x 5 cells around it. Its 15 cm give 31.75.
TEST(GestaltHandTest, Pit) {
  const auto pit = [](double x, double y) { return In(x, y, {9, 10, 6, 7}) ? -0.15 : 0.0; };
  ExpectBlock(GridOf(HandParams(), pit), {7, 12, 4, 9}, Good(32), kBest);
}

// On a slope s the means of a patch differ by 0.8 m tan s: 4.19, 7.00 and 14.11 cm.
TEST(GestaltHandTest, SlopeIsStepsToTheStepTest) {
  const std::array<std::array<int, 2>, 3> kSlopes = {{{3, 255}, {5, 83}, {10, 37}}};
  for (const auto& [degrees, goodness] : kSlopes) {
    const double slope = std::tan(math::DegToRad(degrees));
    const auto plane = [slope](double x, double) { return slope * x; };
    ExpectBlock(GridOf(HandParams(), plane), {}, {}, Good(goodness));
  }
}

// 255 (1 - s/25 deg), whichever way the slope faces.
TEST(GestaltHandTest, SlopeToThePitchTest) {
  GestaltMapParams params = HandParams();
  params.tests = {.step = false, .rough = false, .pitch = true, .border = false};
  const std::array<std::array<int, 2>, 5> kSlopes = {
      {{0, 255}, {5, 204}, {10, 153}, {20, 51}, {26, 0}}};
  for (const auto& [degrees, goodness] : kSlopes) {
    const double slope = std::tan(math::DegToRad(degrees));
    ExpectBlock(GridOf(params, [&](double x, double) { return slope * x; }), {}, {},
                Good(goodness));
    ExpectBlock(GridOf(params, [&](double x, double y) { return slope * (0.6 * x - 0.8 * y); }), {},
                {}, Good(goodness));
  }
}

// Points that alternate by +-b: no cell is higher than another, and the residual is b.
GoodnessGrid Rough(const GestaltMapParams& params, double b_m) {
  return GridOf(params, [b_m](double x, double y) {
    const auto index = static_cast<int>(std::lround((x + y) / 0.1));
    return index % 2 == 0 ? b_m : -b_m;
  });
}

// 255 (1 - b/20 cm) from 6.67 cm on.
TEST(GestaltHandTest, RoughGround) {
  ExpectBlock(Rough(HandParams(), 0.066), {}, {}, kBest);
  ExpectBlock(Rough(HandParams(), 0.07), {}, {}, Good(166));  // 165.75
  ExpectBlock(Rough(HandParams(), 0.12), {}, {}, Good(102));
  ExpectBlock(Rough(HandParams(), 0.20), {}, {}, Good(0));
}

// With f = 1/2: hazards from 3.33 cm on, 255 (1 - b/40 cm) as printed, 255 (1 - b/10 cm) divided.
TEST(GestaltHandTest, RoughnessFraction) {
  GestaltMapParams params = HandParams();
  params.roughness_fraction = 0.5;
  ExpectBlock(Rough(params, 0.033), {}, {}, kBest);
  ExpectBlock(Rough(params, 0.034), {}, {}, Good(233));  // 233.325
  ExpectBlock(Rough(params, 0.08), {}, {}, Good(204));
  params.roughness_formula = RoughnessFormula::kDivided;
  ExpectBlock(Rough(params, 0.033), {}, {}, kBest);
  ExpectBlock(Rough(params, 0.034), {}, {}, Good(168));  // 168.3
  ExpectBlock(Rough(params, 0.08), {}, {}, Good(51));
}

// In-plane variance of 10 x 10 points 10 cm apart: 0.0825 m2. A residual of 25 cm leaves a ratio of
// 1.32 below 2: no plane, no step, so nothing is known. Where plane tests are skipped, all is well.
TEST(GestaltHandTest, RoughGroundThatIsNoPlane) {
  GestaltMapParams params = HandParams();
  ExpectBlock(Rough(params, 0.25), {}, {}, kUnknown);
  params.failed_fit = FailedFit::kSkipPlaneTests;
  ExpectBlock(Rough(params, 0.25), {}, {}, kBest);
  params.eigen_ratio = 1.3;
  ExpectBlock(Rough(params, 0.25), {}, {}, Good(0));
}

// Nine points in a plane, one a cell: whatever is left out of them, none is an outlier. With eight
// left out there would be no plane.
TEST(GestaltHandTest, CellsInThePlaneAreNoOutliers) {
  GestaltMapParams params = HandParams();
  params.min_cell_points = 1;
  params.min_patch_share = 0.3;
  params.outliers_per_cell = 8;
  messages::PointCloud cloud;
  for (int i = 9; i < 12; ++i) {
    for (int j = 9; j < 12; ++j) cloud.points_R.push_back({Edge(i) + 0.1, Edge(j) + 0.1, 0.0});
  }
  EXPECT_EQ(MapOf(params, cloud).Evaluate().Cell(10, 10), kBest);
}

// Without the cell that stands 1 m above level ground its patch is level; with it the residual
// would be sqrt(0.04 x 0.96) m = 19.6 cm. What was found of the map earlier does not show.
TEST(GestaltHandTest, OutliersOfTheMapAsItIs) {
  GestaltMapParams params = HandParams();
  params.tests.step = false;
  params.outliers_per_cell = 1;
  const auto post = [](double x, double y) { return In(x, y, {10, 11, 10, 11}) ? 1.0 : 0.0; };
  GestaltMap map = MapOf(params, PointsOn(kWholeWindow, Level));
  EXPECT_EQ(map.Evaluate().Cell(10, 10), kBest);
  map.Clear();
  map.Add(PointsOn(kWholeWindow, post), math::Transform::Identity());
  ExpectBlock(map.Evaluate(), {}, {}, kBest);
  params.outliers_per_cell = 0;
  EXPECT_EQ(GridOf(params, post).Cell(10, 10), Good(5));  // 255 (1 - 19.596/20)
}

// A million points in a patch at +-2^32/1000 um: their squares add up to 2^64 um^2 but for a
// rest, in which sums of whole numbers see level ground. The residual is that of the vertical plane
// through them: sqrt(0.0825 m2) = 28.7 cm in the patch around cell (10, 10), which is the only one
// with 25 cells.
TEST(GestaltHandTest, ManyPointsDoNotHideAnObstacle) {
  GestaltMapParams params = HandParams();
  params.eigen_ratio = 1.0;
  GestaltMap map(params);
  map.BeginCycle(kHandRover_m, kHandRover_m);
  messages::PointCloud cloud;
  for (const double height_m : {4.294967, -4.294967}) {
    const messages::PointCloud layer =
        PointsOn({8, 13, 8, 13}, [height_m](double, double) { return height_m; });
    for (int i = 0; i < 5000; ++i) {
      cloud.points_R.insert(cloud.points_R.end(), layer.points_R.begin(), layer.points_R.end());
    }
  }
  map.Add(cloud, math::Transform::Identity());
  EXPECT_EQ(map.Evaluate().Cell(10, 10), Good(0));
  params.rover.obst_height_m = 0.5;  // 255 (1 - 28.72/50) = 108.5
  GestaltMap higher(params);
  higher.BeginCycle(kHandRover_m, kHandRover_m);
  higher.Add(cloud, math::Transform::Identity());
  EXPECT_EQ(higher.Evaluate().Cell(10, 10), Good(109));
}

// Data up to column 9: a patch has 3 of its columns there around column 9, 2 around column 10. At
// the upper and lower edge other borders come in.
TEST(GestaltHandTest, BorderOfTheUnknown) {
  const GoodnessGrid grid = MapOf(HandParams(), PointsOn({0, 10, 0, 21}, Level)).Evaluate();
  for (int iy = 3; iy < 18; ++iy) {
    EXPECT_EQ(grid.Cell(8, iy), kBest) << iy;
    EXPECT_EQ(grid.Cell(9, iy), kBorder) << iy;
    EXPECT_EQ(grid.Cell(10, iy), kUnknown) << iy;
  }
}

TEST(GestaltHandTest, BorderMayHaveTheCertaintyOfTable1) {
  GestaltMapParams params = HandParams();
  params.certainty = CellCertainty::kOfHazard;
  const GoodnessGrid grid = MapOf(params, PointsOn({0, 10, 0, 21}, Level)).Evaluate();
  EXPECT_EQ(grid.Cell(9, 10), (CellValue{250, 128, true}));
  EXPECT_EQ(grid.Cell(8, 10), kBest);
  params.tests.border = false;
  EXPECT_EQ(MapOf(params, PointsOn({0, 10, 0, 21}, Level)).Evaluate().Cell(9, 10), kBest);
}

// A rock of 40 cm on the corner of four cells: one of the four points of each, so that the means
// are 10 cm: 63.5, in the 6 x 6 cells whose patches hold one of the four.
TEST(GestaltHandTest, RockBetweenCells) {
  const auto rock = [](double x, double y) {
    return std::abs(x - Edge(10)) < 0.1 && std::abs(y - Edge(10)) < 0.1 ? 0.4 : 0.0;
  };
  ExpectBlock(GridOf(HandParams(), rock), {7, 13, 7, 13}, Good(64), kBest);
}

// A smooth slope of 14 degrees rises by 0.2 m over the 0.8 m between the outermost cells of a
// patch: an obstacle as printed, and nothing from its own plane.
TEST(GestaltHandTest, SmoothSlopeIsAStepFromTheLevelAndNoneFromItsPlane) {
  GestaltMapParams params = HandParams();
  const auto slope = [](double x, double y) { return 0.15 * x + 0.2 * y; };
  EXPECT_EQ(GridOf(params, slope).Cell(10, 10), Good(0));
  params.step_reference = StepReference::kPlane;
  EXPECT_EQ(GridOf(params, slope).Cell(10, 10), kBest);
  // 255 (1 - atan(0.25) / 25 deg) = 111.8 with the pitch test.
  params.tests.pitch = true;
  EXPECT_EQ(GridOf(params, slope).Cell(10, 10), Good(112));
}

// A step in the slope that its plane cannot follow: one column 18 cm up among twenty-five cells.
TEST(GestaltHandTest, StepInASlopeCountsFromItsPlane) {
  GestaltMapParams params = HandParams();
  params.tests.rough = false;
  params.step_reference = StepReference::kPlane;
  const auto on = [](double slope) {
    return [slope](double x, double y) {
      return slope * y + (In(x, y, {10, 11, 10, 11}) ? 0.18 : 0.0);
    };
  };
  // In the middle of its patch a rock tilts nothing: 127 (1 - 0.18 / 0.2) = 12.7. On a slope the
  // distances that the fit makes least are not those straight up, so that it does a little.
  EXPECT_EQ(GridOf(params, on(0.0)).Cell(10, 10), Good(13));
  EXPECT_NEAR(int{GridOf(params, on(0.1)).Cell(10, 10).goodness}, 13, 1);
  params.step_reference = StepReference::kLevel;
  EXPECT_EQ(GridOf(params, on(0.1)).Cell(10, 10), Good(0)) << "0.18 m and 4 cm of slope";
}

}  // namespace
}  // namespace rockyard::navigation
