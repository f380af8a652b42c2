// From what is seen of the cylinder to its orientation and distance (Matthies 1995, A.1), and how
// far one pixel moves these (A.2).
#pragma once

#include <optional>

#include "vision/cylinder/colour_cylinder.h"

namespace rockyard::vision {

// Which quadrant is not seen: the rows of the table below equation 13, with theta_0 of each.
enum class AbsentQuadrant { kC, kD, kA, kB };

// theta_0, rad: 0, pi/2, pi, 3 pi/2.
double OffsetOf(AbsentQuadrant absent);

// The colours side by side; none on a side where nothing is seen.
struct ColourOrder {
  std::optional<CylinderColour> left;
  CylinderColour middle = CylinderColour::kBlue;
  std::optional<CylinderColour> right;
};

// How a row is chosen. The text takes the row of the colour that is absent, but quadrants B and D
// are both pink and one class, so that the colour alone does not say which of them is absent. The
// order of the colours does:
//
//   left     middle   right      absent  theta_0
//   magenta  blue     magenta    C       0
//   blue     magenta  red        D       pi/2
//   magenta  red      magenta    A       pi
//   red      magenta  blue       B       3 pi/2
//
// A side on which nothing is seen fits any colour. kUnlike: no row has this order; kAnyPink: a
// magenta middle alone, which two rows have.
enum class OrderDoubt { kUnlike, kAnyPink };
struct RowChoice {
  std::optional<AbsentQuadrant> absent;
  OrderDoubt doubt = OrderDoubt::kUnlike;  // where none is chosen
};
RowChoice ChooseRow(const ColourOrder& order);

// What is seen of the middle (k_1), of the one to its right (k_2) and to its left (k_3), in any one
// unit. The sides are those of equations 5 to 8: at theta_0 = 0 they are A, B and D.
struct ColourQuantities {
  double k1 = 0.0;
  double k2 = 0.0;
  double k3 = 0.0;
};

// Equation 14, rad, in [-pi, pi]. Requires a positive k1 and none negative.
//
//   theta = theta_0 + atan2(k1 + k2 - k3, k1 - k2 + k3)
//
// atan2(x, y) of the text is arc tan(x / y), hence the same order of arguments as std::atan2.
double OrientationOf(AbsentQuadrant absent, const ColourQuantities& k);

// Equation 15 with f = M / (2 tan(phi / 2)): d = 2 f rho / m.
double DistanceBySize(double focal_px, double radius_m, double m_px);

// Equation 16, d = d_0 + rho^2 / d with d_0 of equation 15, solved as the quadratic
// d^2 - d_0 d - rho^2 = 0, whose positive root is (d_0 + sqrt(d_0^2 + 4 rho^2)) / 2.
double DistanceBySizeNear(double focal_px, double radius_m, double m_px);

// Of equations 15 to 23, all of an orthographic image: m the cylinder's width in the image, px; M
// the width of the image, px; phi the field of view, rad; rho the radius of the cylinder, b the
// baseline and d the distance, m. tan(phi / 2) = M / (2 f) with f the focal length in pixels.
struct ViewOfCylinder {
  double image_width_px = 512.0;  // M
  double field_of_view_rad = 0.0;
  double radius_m = 0.0;
  double baseline_m = 0.0;
};

// Equations 18 and 19, rad: 2 / m with a boundary of colours in the middle of the cylinder,
// 2 sqrt(2) / m with one 45 deg off it. The text's cos(pi / 4) is that of the middle of a quadrant,
// where both boundaries of it are seen.
double FinestTurn(double m_px);
double CoarsestTurn(double m_px);

// Equations 20 and 21, the same by distance, rad: with m of equation 16.
double FinestTurnAt(const ViewOfCylinder& view, double d_m);
double CoarsestTurnAt(const ViewOfCylinder& view, double d_m);

// Equations 22 and 23: |dd| / d by one pixel of width and of disparity. The text's minus sign says
// that more pixels are less distance.
double RelativeStepBySize(const ViewOfCylinder& view, double d_m);
double RelativeStepByStereo(const ViewOfCylinder& view, double d_m);

}  // namespace rockyard::vision
