#include "vision/cylinder/published_finder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "math/angles.h"
#include "math/decompositions.h"
#include "vision/cylinder/colour_model.h"
#include "vision/cylinder/colour_regions.h"
#include "vision/cylinder/cylinder_equations.h"
#include "vision/cylinder/fit_problem.h"
#include "vision/cylinder/painted_cylinder.h"

namespace rockyard::vision {
namespace {

using math::DegToRad;
using math::RadToDeg;
using testing::HasSubstr;

// The equations and the numbers of Matthies 1995, section 5 and appendix A.

// The widths of quadrants A to D that a distant viewer at theta sees: by where the quadrants' ends
// stand across the view, without the text's equations.
std::array<double, 4> WidthsSeen(double theta_rad) {
  std::array<double, 4> widths{};
  constexpr int kParts = 20000;
  for (int i = 0; i < kParts; ++i) {
    const double across = 2.0 * (i + 0.5) / kParts - 1.0;  // from the left rim to the right one
    double azimuth_rad = theta_rad + std::asin(across);
    azimuth_rad -= 2.0 * std::numbers::pi * std::floor(azimuth_rad / (2.0 * std::numbers::pi));
    widths.at(static_cast<std::size_t>(2.0 * azimuth_rad / std::numbers::pi)) += 1.0 / kParts;
  }
  return widths;
}

ColourOrder OrderSeen(const std::array<double, 4>& widths, ColourQuantities& k) {
  std::size_t middle = 0;
  for (std::size_t i = 1; i < 4; ++i) {
    if (widths.at(i) > widths.at(middle)) middle = i;
  }
  // Counter-clockwise seen from above is to the right.
  const std::size_t right = (middle + 1) % 4;
  const std::size_t left = (middle + 3) % 4;
  k = {widths.at(middle), widths.at(right), widths.at(left)};
  ColourOrder order;
  order.middle = kQuadrantColours.at(middle);
  if (k.k2 > 0.0) order.right = kQuadrantColours.at(right);
  if (k.k3 > 0.0) order.left = kQuadrantColours.at(left);
  return order;
}

TEST(CylinderEquationsTest, EveryOrientationIsFoundFromTheWidthsThatItShows) {
  for (int deg = -179; deg <= 180; ++deg) {
    const double theta_rad = DegToRad(deg + 0.25);
    ColourQuantities k;
    const RowChoice row = ChooseRow(OrderSeen(WidthsSeen(theta_rad), k));
    ASSERT_TRUE(row.absent) << deg;
    const double error_rad = math::WrapAngle(OrientationOf(*row.absent, k) - theta_rad);
    EXPECT_NEAR(RadToDeg(error_rad), 0.0, 0.05) << deg;
  }
}

// Equations 5 to 8 in the first quadrant.
TEST(CylinderEquationsTest, TheFirstRowIsOfBlueBetweenPinks) {
  const double theta_rad = DegToRad(30.0);
  const ColourQuantities k{std::sin(theta_rad) + std::cos(theta_rad), 1.0 - std::cos(theta_rad),
                           1.0 - std::sin(theta_rad)};
  EXPECT_NEAR(OrientationOf(AbsentQuadrant::kC, k), theta_rad, 1e-12);
  EXPECT_NEAR(OrientationOf(AbsentQuadrant::kD, k), theta_rad + DegToRad(90.0), 1e-12);
  EXPECT_NEAR(OrientationOf(AbsentQuadrant::kA, k), theta_rad - DegToRad(180.0), 1e-12);
  EXPECT_NEAR(OrientationOf(AbsentQuadrant::kB, k), theta_rad - DegToRad(90.0), 1e-12);
}

// Section 5: without blue -180 < theta < -90, the range with large errors.
TEST(CylinderEquationsTest, WithoutBlueIsTheRangeThatTheTextNamesAsBad) {
  for (const double k3 : {0.01, 0.29, 0.99}) {
    const double theta_deg =
        RadToDeg(OrientationOf(AbsentQuadrant::kA, {2.0 - 1.0 - k3 + 0.4, 0.6, k3}));
    EXPECT_GT(theta_deg, -180.0);
    EXPECT_LT(theta_deg, -90.0);
  }
}

TEST(CylinderEquationsTest, TheOrderOfColoursTellsTheRow) {
  using enum CylinderColour;
  const auto row = [](std::optional<CylinderColour> left, CylinderColour middle,
                      std::optional<CylinderColour> right) {
    return ChooseRow({left, middle, right});
  };
  EXPECT_EQ(row(kMagenta, kBlue, kMagenta).absent, AbsentQuadrant::kC);
  EXPECT_EQ(row(kBlue, kMagenta, kRed).absent, AbsentQuadrant::kD);
  EXPECT_EQ(row(kMagenta, kRed, kMagenta).absent, AbsentQuadrant::kA);
  EXPECT_EQ(row(kRed, kMagenta, kBlue).absent, AbsentQuadrant::kB);
  // One side or both unseen.
  EXPECT_EQ(row({}, kBlue, kMagenta).absent, AbsentQuadrant::kC);
  EXPECT_EQ(row({}, kRed, {}).absent, AbsentQuadrant::kA);
  EXPECT_EQ(row(kBlue, kMagenta, {}).absent, AbsentQuadrant::kD);
  EXPECT_EQ(row({}, kMagenta, kBlue).absent, AbsentQuadrant::kB);
}

TEST(CylinderEquationsTest, ImpossibleOrdersAndAnyPinkHaveNoRow) {
  using enum CylinderColour;
  for (const ColourOrder& order : {ColourOrder{kRed, kBlue, kMagenta},
                                   {kMagenta, kBlue, kRed},
                                   {kBlue, kRed, {}},
                                   {kBlue, kMagenta, kBlue},
                                   {kRed, kMagenta, kRed}}) {
    const RowChoice row = ChooseRow(order);
    EXPECT_FALSE(row.absent);
    EXPECT_EQ(row.doubt, OrderDoubt::kUnlike);
  }
  const RowChoice pink = ChooseRow({{}, kMagenta, {}});
  EXPECT_FALSE(pink.absent);
  EXPECT_EQ(pink.doubt, OrderDoubt::kAnyPink);
}

// A.1.2: 17 pixels are 11.24 m with rho = 0.1 m, 512 pixels and 30 deg.
const ViewOfCylinder kTextView = {512.0, DegToRad(30.0), 0.1, 0.2};
const double kTextFocal_px = 256.0 / std::tan(DegToRad(15.0));

TEST(CylinderEquationsTest, SeventeenPixelsAreElevenMetres) {
  EXPECT_NEAR(DistanceBySize(kTextFocal_px, 0.1, 17.0), 11.24, 0.005);
  const double d_m = DistanceBySizeNear(kTextFocal_px, 0.1, 17.0);
  EXPECT_NEAR(d_m, 11.24, 0.005);
  // Equation 16 itself.
  EXPECT_NEAR(d_m, DistanceBySize(kTextFocal_px, 0.1, 17.0) + 0.01 / d_m, 1e-12);
}

// Figure 19: the rims are seen where lines of sight touch the circle, f tan(asin(rho / d)) off.
TEST(CylinderEquationsTest, TheNearSolutionIsThatOfTheTangents) {
  for (const double d_m : {0.3, 0.838, 5.0}) {
    const double half_px = kTextFocal_px * std::tan(std::asin(0.1 / d_m));
    const double near_m = DistanceBySizeNear(kTextFocal_px, 0.1, 2.0 * half_px);
    // Of rho^2 / d, equation 16 leaves a part of the order rho^4 / d^3.
    EXPECT_NEAR(near_m, d_m, 0.2 * std::pow(0.1, 4) / std::pow(d_m, 3) + 0.5 * 0.01 / d_m);
    EXPECT_LT(std::abs(near_m - d_m),
              std::abs(DistanceBySize(kTextFocal_px, 0.1, 2.0 * half_px) - d_m) + 1e-12);
  }
}

// A.2.1: 6.7 and 9.5 deg with 17 pixels.
TEST(CylinderResolutionTest, OnePixelOfSeventeenTurnsBySevenToTenDegrees) {
  EXPECT_NEAR(RadToDeg(FinestTurn(17.0)), 6.7, 0.05);
  EXPECT_NEAR(RadToDeg(CoarsestTurn(17.0)), 9.5, 0.05);
  const double d_m = DistanceBySizeNear(kTextFocal_px, 0.1, 17.0);
  // Equation 20 with d of equation 16: d / rho - rho / d is 2 f / m.
  EXPECT_NEAR(FinestTurnAt(kTextView, d_m), FinestTurn(17.0), 1e-12);
  EXPECT_NEAR(CoarsestTurnAt(kTextView, d_m), CoarsestTurn(17.0), 1e-12);
}

// A.2.2: 0.66 m. The text's "about 5.8 %" is 5.88 %, 1 / 17.
TEST(CylinderResolutionTest, OnePixelOfSeventeenIsSixtySixCentimetres) {
  const double d_m = DistanceBySize(kTextFocal_px, 0.1, 17.0);
  EXPECT_NEAR(d_m * RelativeStepBySize(kTextView, d_m), 0.66, 0.005);
  EXPECT_NEAR(RelativeStepBySize(kTextView, d_m), 1.0 / 17.0, 1e-12);
  // A.2.3: with a baseline of the cylinder's diameter the same by stereo.
  EXPECT_NEAR(RelativeStepByStereo(kTextView, d_m), RelativeStepBySize(kTextView, d_m), 1e-12);
}

// The table of section 5; d from the fronts of the cameras. Its 2.70 deg at 4.496 m is 2.74 by
// equation 20.
TEST(CylinderResolutionTest, TheTableOfSection5) {
  struct Row {
    double d_m, turn_deg, relative, turn_places, relative_places;
  };
  const ViewOfCylinder view = {512.0, DegToRad(29.33), 0.096, 0.12};
  for (const Row& row : {Row{0.838, 0.50, 0.0071, 0.01, 1e-4},
                         {1.753, 1.06, 0.015, 0.01, 1e-3},
                         {4.496, 2.70, 0.038, 0.045, 1e-3},
                         {9.982, 6.09, 0.085, 0.01, 1e-3}}) {
    EXPECT_NEAR(RadToDeg(FinestTurnAt(view, row.d_m)), row.turn_deg, row.turn_places) << row.d_m;
    EXPECT_NEAR(RelativeStepByStereo(view, row.d_m), row.relative, row.relative_places) << row.d_m;
    EXPECT_NEAR(CoarsestTurnAt(view, row.d_m), std::sqrt(2.0) * FinestTurnAt(view, row.d_m), 1e-12);
  }
}

// Descents of the cylinder's fit: what moves, what stays, and where they end.

constexpr double kTheta_rad = DegToRad(30.0);

// The fit of a painted cylinder 4.5 m away, of which the finder is told a diameter.
class Wall {
 public:
  explicit Wall(double diameter_m, double tint_sd = CylinderFitParams{}.tint_sd)
      : pair_(painted_.Pair()), eyes_(*GeometryOf(pair_)) {
    cylinder_.diameter_m = diameter_m;
    params_.fit.tint_sd = tint_sd;
    light_ = LightOf(pair_.left, pair_.right, params_.surfaces, params_.colours);
    const auto labels = [&](const ColourImage& image) {
      return LabelSurfaces(image, light_, params_.surfaces, params_.colours);
    };
    const CandidateSearch search = FindCandidates(pair_, eyes_, cylinder_, labels(pair_.left),
                                                  labels(pair_.right), params_.candidates);
    candidate_ = search.pairs.at(0);
  }

  FitProblem Problem() const { return {pair_, eyes_, cylinder_, candidate_, light_, params_}; }

 private:
  PaintedPair painted_ = Paint(SceneAt(4.5, kTheta_rad));
  ColourPair pair_;
  EyeGeometry eyes_;
  ColourCylinder cylinder_;
  RobustFinderParams params_;
  LogRatios light_ = LogRatios::Zero();
  RegionPair candidate_;
};

double SquaresAt(const FitProblem& problem, const FitUnknowns& unknowns) {
  return problem.Evaluate(unknowns, RadiusDeviation(FitRadius::kFixed))->residuals.squaredNorm();
}

FitUnknowns TurnedBy(double turn_rad) {
  FitUnknowns unknowns = FitUnknowns::Zero();
  unknowns[2] = kTheta_rad + turn_rad;
  return unknowns;
}

TEST(FitDescent, FindsTheOrientationAndLeavesAFixedRadius) {
  const Wall wall(0.192);
  const FitProblem problem = wall.Problem();
  for (const double turn_deg : {-6.0, 6.0}) {
    const FitUnknowns start = TurnedBy(DegToRad(turn_deg));
    const FitState state = DescendFrom(problem, start, FitRadius::kFixed, 30);
    EXPECT_NEAR(state.unknowns[2], kTheta_rad, DegToRad(0.7));
    EXPECT_LT(std::abs(state.unknowns[4]), 1e-4);
    EXPECT_LT(state.squares, SquaresAt(problem, start));
    EXPECT_DOUBLE_EQ(state.squares, SquaresAt(problem, state.unknowns));
    EXPECT_DOUBLE_EQ(state.evaluation.residuals.squaredNorm(), state.squares);
  }
}

TEST(FitDescent, OfAFreeRadiusTellsASizeThatIsWrong) {
  const Wall wall(0.96 * 0.192);
  const FitState state = DescendFrom(wall.Problem(), TurnedBy(0.0), FitRadius::kFree, 30);
  EXPECT_NEAR(state.unknowns[4], 1.0 / 0.96 - 1.0, 0.01);
  EXPECT_LT(std::sqrt(math::InverseOf(state.information)(4, 4)), 0.02);
}

// A quadrant whose colour may change across it could be two: its edge tells less.
TEST(FitDescent, QuadrantsOfOneColourTellMoreOfTheOrientation) {
  const auto turned_squares = [](double tint_sd) {
    const Wall wall(0.192, tint_sd);
    const FitProblem problem = wall.Problem();
    return SquaresAt(problem, TurnedBy(DegToRad(8.0))) - SquaresAt(problem, TurnedBy(0.0));
  };
  EXPECT_GT(turned_squares(0.02), 1.5 * turned_squares(0.1));
}

TEST(FitDescent, MoreStepsAreNoWorse) {
  const Wall wall(0.192);
  const FitProblem problem = wall.Problem();
  const FitUnknowns start = TurnedBy(DegToRad(5.0));
  double before = SquaresAt(problem, start);
  for (const int steps : {1, 2, 4, 8}) {
    const double after = DescendFrom(problem, start, FitRadius::kFixed, steps).squares;
    EXPECT_LE(after, before) << steps;
    before = after;
  }
}

// The published finder on painted pairs: all orientations, and every way to find nothing.

CylinderFinding Find(const PaintedPair& pair, const PublishedFinderParams& params = {}) {
  return FindCylinderAsPublished(pair.Pair(), {}, params);
}

void ExpectMiss(const CylinderFinding& finding, CylinderMiss miss, const std::string& words) {
  EXPECT_FALSE(finding.sighting);
  EXPECT_EQ(finding.miss, miss) << finding.reason;
  EXPECT_THAT(finding.reason, HasSubstr(words));
}

// Within what one pixel moves (equations 21 and 23), but for what perspective does to near ones:
// the middle between both rims is not the image of the axis, which is 1.2 % short at 0.838 m.
TEST(PublishedFinderTest, FindsAllOrientationsWithinOnePixel) {
  const ViewOfCylinder view = {512.0, DegToRad(29.33), 0.096, 0.12};
  for (const double d_m : {0.838, 1.753, 4.496, 9.982}) {
    for (int deg = -175; deg < 180; deg += 80) {
      const CylinderFinding finding = Find(Paint(SceneAt(d_m, DegToRad(deg))));
      ASSERT_TRUE(finding.sighting) << finding.reason << ", " << d_m << " m, " << deg << " deg";
      EXPECT_EQ(finding.miss, CylinderMiss::kNone);
      const CylinderSighting& seen = *finding.sighting;
      const double error_rad = math::WrapAngle(seen.orientation_rad - DegToRad(deg));
      EXPECT_LT(std::abs(error_rad), CoarsestTurnAt(view, d_m) + DegToRad(1.0))
          << d_m << " " << deg;
      const double step_m = d_m * RelativeStepByStereo(view, d_m);
      EXPECT_NEAR(seen.distance_by_stereo_m, d_m, step_m + 0.015 * d_m);
      EXPECT_NEAR(seen.distance_by_size_m, d_m,
                  1.5 * d_m * RelativeStepBySize(view, d_m) + 0.01 * d_m);
      EXPECT_NEAR(seen.p_LT_L.x(), seen.distance_by_stereo_m, 1e-9);
      EXPECT_NEAR(seen.p_LT_L.y(), -0.06, 0.02 * d_m);
      EXPECT_NEAR(seen.p_LT_L.z(), 0.0, 0.02 * d_m);
    }
  }
}

TEST(PublishedFinderTest, TellsRegionsFromLeftToRight) {
  const CylinderFinding finding = Find(Paint(SceneAt(2.0, DegToRad(-30.0))));
  ASSERT_TRUE(finding.sighting);
  for (const auto& regions : finding.sighting->regions) {
    ASSERT_EQ(regions.size(), 4U);
    EXPECT_EQ(regions[0].role, RegionRole::kWhole);
    EXPECT_EQ(regions[1].colour, CylinderColour::kRed);
    EXPECT_EQ(regions[1].role, RegionRole::kLeft);
    EXPECT_EQ(regions[2].colour, CylinderColour::kMagenta);
    EXPECT_EQ(regions[3].colour, CylinderColour::kBlue);
    EXPECT_EQ(regions[3].role, RegionRole::kRight);
    EXPECT_LT(regions[1].right, regions[2].left + 1);
    EXPECT_NEAR(regions[0].Width(), 0.192 * 999.0 / 2.0, 4.0);
  }
}

// The covariance is that of one pixel: equation 23 along the view, 19 for theta.
TEST(PublishedFinderTest, TheCovarianceIsThatOfPixelErrors) {
  const PaintedPair pair = Paint(SceneAt(4.496, DegToRad(20.0)));
  const Eigen::Matrix4d one = Find(pair).sighting->covariance;
  const double d_m = Find(pair).sighting->distance_by_stereo_m;
  const double f_px = pair.cameras.focal_px;
  EXPECT_NEAR(std::sqrt(one(0, 0)), d_m * d_m / (f_px * 0.12), 1e-3 * d_m);
  EXPECT_NEAR(std::sqrt(one(2, 2)), d_m / f_px, 0.02 * d_m / f_px);
  const double m_px = 0.5 * (Find(pair).sighting->regions[0][0].Width() +
                             Find(pair).sighting->regions[1][0].Width());
  EXPECT_NEAR(std::sqrt(one(3, 3)), CoarsestTurn(m_px), 1e-9);
  PublishedFinderParams two_pixels;
  two_pixels.pixel_error_px = 2.0;
  EXPECT_TRUE(Find(pair, two_pixels).sighting->covariance.isApprox(4.0 * one, 1e-9));
}

TEST(PublishedFinderTest, WidthsTellTheSameAsPixels) {
  PublishedFinderParams params;
  params.measure = QuadrantMeasure::kWidth;
  const CylinderFinding finding = Find(Paint(SceneAt(2.0, DegToRad(70.0))), params);
  ASSERT_TRUE(finding.sighting) << finding.reason;
  EXPECT_NEAR(RadToDeg(finding.sighting->orientation_rad), 70.0, 3.0);
}

TEST(PublishedFinderTest, NothingInViewIsNothing) {
  PaintedScene scene;
  scene.cylinders.clear();
  ExpectMiss(Find(Paint(scene)), CylinderMiss::kNothing, "0 pixels");
}

TEST(PublishedFinderTest, AClippedCylinderIsClipped) {
  PaintedScene scene = SceneAt(2.0, 0.5);
  scene.cylinders.front().p_LT_L.y() = 0.45;
  ExpectMiss(Find(Paint(scene)), CylinderMiss::kClipped, "border");
  // The area of interest has a border, too.
  PublishedFinderParams params;
  params.sky_share = 0.5;
  ExpectMiss(Find(Paint(SceneAt(2.0, 0.5)), params), CylinderMiss::kClipped, "border");
}

TEST(PublishedFinderTest, SwappedEyesAreSaidSo) {
  const PaintedPair pair = Paint(SceneAt(2.0, 0.5));
  ExpectMiss(FindCylinderAsPublished(pair.Swapped(), {}, {}), CylinderMiss::kSwappedEyes,
             "swapped");
}

TEST(PublishedFinderTest, UnlikeEyesAreRefused) {
  const PaintedPair pair = Paint(SceneAt(2.0, 0.5));
  PaintedPair mixed = Paint(SceneAt(3.0, 0.5));
  mixed.left = pair.left;
  ExpectMiss(Find(mixed), CylinderMiss::kUnlikeEyes, "columns");
  mixed.right = Paint(SceneAt(2.0, 1.8)).right;
  ExpectMiss(Find(mixed), CylinderMiss::kUnlikeEyes, "deg");
}

TEST(PublishedFinderTest, MirroredImagesShowAnOrderThatNoCylinderHas) {
  PaintedPair pair = Paint(SceneAt(2.0, DegToRad(135.0)));
  for (ColourImage* image : {&pair.left, &pair.right}) {
    // Blue, pink and red become red, blue and pink.
    for (Rgb& pixel : image->values()) {
      if (pixel.blue > pixel.red && pixel.blue > 100) {
        pixel = {190, 50, 120};
      } else if (pixel.red > 150 && pixel.blue > 80) {
        pixel = {24, 60, 170};
      }
    }
  }
  ExpectMiss(Find(pair), CylinderMiss::kUnlikeOrder, "magenta, blue, red");
}

TEST(PublishedFinderTest, PinkAloneIsTooFew) {
  PaintedScene scene = SceneAt(2.0, DegToRad(135.0));
  scene.quadrants[0] = scene.ground;
  scene.quadrants[2] = scene.ground;
  ExpectMiss(Find(Paint(scene)), CylinderMiss::kTooFewRegions, "pink");
}

TEST(PublishedFinderTest, OneOrTwoRegionsAreEnough) {
  // At 45 deg blue fills the middle: alone it says 45 deg.
  PaintedScene scene = SceneAt(2.0, DegToRad(45.0));
  scene.quadrants[1] = scene.ground;
  scene.quadrants[3] = scene.ground;
  const CylinderFinding one = Find(Paint(scene));
  ASSERT_TRUE(one.sighting) << one.reason;
  EXPECT_NEAR(RadToDeg(one.sighting->orientation_rad), 45.0, 1e-6);
  EXPECT_EQ(one.sighting->regions[0].size(), 2U);
  const CylinderFinding two = Find(Paint(SceneAt(2.0, 0.0)));
  ASSERT_TRUE(two.sighting) << two.reason;
  EXPECT_NEAR(RadToDeg(two.sighting->orientation_rad), 0.0, 3.0);
}

}  // namespace
}  // namespace rockyard::vision
