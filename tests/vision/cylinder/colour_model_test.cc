// Colours of the quadrants against those of the surfaces.
#include "vision/cylinder/colour_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace rockyard::vision {
namespace {

const std::vector<CylinderColour> kAll = {CylinderColour::kBlue, CylinderColour::kMagenta,
                                          CylinderColour::kRed};

// What the surfaces look like in a light, before a camera of a saturation.
std::vector<SeenColour> SeenIn(const LogRatios& light, double saturation, double variance) {
  std::vector<SeenColour> seen;
  for (const CylinderColour colour : kAll) {
    seen.push_back({colour, light + saturation * SurfaceOf(colour, {}),
                    variance * Eigen::Matrix2d::Identity()});
  }
  return seen;
}

double SquaresOf(const std::vector<SeenColour>& seen, const LogRatios& light = LogRatios::Zero()) {
  const std::vector<double> residuals = ColourResiduals(seen, light, {}, {});
  EXPECT_EQ(residuals.size(), 2 * seen.size() + 3);
  return std::inner_product(residuals.begin(), residuals.end(), residuals.begin(), 0.0);
}

// The same for one light and one saturation, term by term.
double PlainSquares(const std::vector<SeenColour>& seen, const LogRatios& light,
                    double saturation) {
  const ColourModelParams params;
  double squares = light.squaredNorm() / std::pow(params.light_sd, 2) +
                   std::pow((saturation - params.saturation) / params.saturation_sd, 2);
  for (const SeenColour& colour : seen) {
    const Eigen::Matrix2d covariance =
        colour.covariance + std::pow(params.surface_sd, 2) * Eigen::Matrix2d::Identity();
    const LogRatios left = colour.ratios - light - saturation * SurfaceOf(colour.colour, {});
    squares += left.dot(covariance.inverse() * left);
  }
  return squares;
}

TEST(ColourModel, ResidualsAreThoseOfTheBestLightAndSaturation) {
  std::vector<SeenColour> seen = SeenIn({0.1, -0.2}, 0.7, 0.02);
  seen[0].ratios += LogRatios(0.3, -0.1);
  seen[0].covariance << 0.5, 0.2, 0.2, 0.1;
  seen[2].ratios += LogRatios(-0.2, 0.4);
  // By a grid over the three unknowns, 0.01 apart.
  double least = std::numeric_limits<double>::infinity();
  for (int red = -50; red <= 50; ++red) {
    for (int blue = -50; blue <= 50; ++blue) {
      for (int saturation = 40; saturation <= 110; ++saturation) {
        least = std::min(least, PlainSquares(seen, {0.01 * red, 0.01 * blue}, 0.01 * saturation));
      }
    }
  }
  EXPECT_LE(SquaresOf(seen), least);
  EXPECT_NEAR(SquaresOf(seen), least, 0.02);
}

TEST(ColourModel, TheSurfacesInAnyLikelyLightAreThemselves) {
  for (const double light : {-0.2, 0.0, 0.2}) {
    for (const double saturation : {0.65, 0.8, 0.95}) {
      EXPECT_LT(SquaresOf(SeenIn({light, -light}, saturation, 0.01)), 3.0);
      EXPECT_LT(SquaresOf(SeenIn({light, -light}, saturation, 0.01), {light, -light}), 1.0);
    }
  }
  // Controls: blue and orange, or blue and pink, that changed their places.
  for (const std::size_t other : {1U, 2U}) {
    std::vector<SeenColour> swapped = SeenIn(LogRatios::Zero(), 0.8, 0.01);
    std::swap(swapped[0].ratios, swapped[other].ratios);
    EXPECT_GT(SquaresOf(swapped), 20.0);
  }
}

// A ratio that nobody knows excuses none that is known: orange too dark in red to tell its red over
// green, and blue.
TEST(ColourModel, EachRatioCountsByWhatIsKnownOfIt) {
  std::vector<SeenColour> seen = SeenIn(LogRatios::Zero(), 0.8, 0.01);
  seen[2].ratios[1] = 1.1;
  seen[2].covariance = Eigen::Vector2d(100.0, 0.01).asDiagonal();
  EXPECT_GT(SquaresOf(seen), 20.0);
  // Control: the mean of both variances for both.
  seen[2].covariance = Eigen::Vector2d(50.0, 50.0).asDiagonal();
  EXPECT_LT(SquaresOf(seen), 3.0);
}

TEST(ColourModel, WhiteningIsTheInverseRoot) {
  Eigen::Matrix2d covariance;
  covariance << 2.0, 0.7, 0.7, 0.5;
  const Eigen::Matrix2d whitening = WhiteningOf(covariance);
  EXPECT_TRUE((whitening * covariance * whitening).isIdentity(1e-12));
  EXPECT_TRUE(whitening.isApprox(whitening.transpose()));
}

TEST(ColourModel, DirectionsAreThoseOfTheSurfaces) {
  ColourModelParams plain{.saturation = 1.0};
  const SurfaceColourParams surfaces;
  const Eigen::Vector3d blue(surfaces.blue[0], surfaces.blue[1], surfaces.blue[2]);
  const Eigen::Vector3d light(1.5, 1.0, 0.8);
  const Eigen::Vector3d seen =
      DirectionOf(CylinderColour::kBlue, LogRatiosOf(100.0 * light), surfaces, plain);
  EXPECT_TRUE(seen.isApprox(light.cwiseProduct(blue).normalized(), 1e-9));
  EXPECT_NEAR(seen.norm(), 1.0, 1e-12);
  // Crosstalk draws it towards the light's.
  plain.saturation = 0.0;
  EXPECT_TRUE(DirectionOf(CylinderColour::kBlue, LogRatiosOf(100.0 * light), surfaces, plain)
                  .isApprox(light.normalized(), 1e-9));
}

}  // namespace
}  // namespace rockyard::vision
