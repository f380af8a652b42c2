// Descents of the cylinder's fit: what moves, what stays, and where they end.
#include <gtest/gtest.h>

#include <cmath>

#include "math/angles.h"
#include "math/decompositions.h"
#include "vision/cylinder/colour_model.h"
#include "vision/cylinder/colour_regions.h"
#include "vision/cylinder/fit_problem.h"
#include "vision/cylinder/painted_cylinder.h"

namespace rockyard::vision {
namespace {

using math::DegToRad;

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

}  // namespace
}  // namespace rockyard::vision
