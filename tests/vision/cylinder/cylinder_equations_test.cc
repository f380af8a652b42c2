// The equations and the numbers of Matthies 1995, section 5 and appendix A.
#include "vision/cylinder/cylinder_equations.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "math/angles.h"

namespace rockyard::vision {
namespace {

using math::DegToRad;
using math::RadToDeg;

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

}  // namespace
}  // namespace rockyard::vision
