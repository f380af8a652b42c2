// How far one pixel moves what the cylinder's image tells (Matthies 1995, A.2).
//
// All are of an orthographic image: m the cylinder's width in the image, px; M the width of the
// image, px; phi the field of view, rad; rho the radius of the cylinder, b the baseline and d the
// distance, m. tan(phi / 2) = M / (2 f) with f the focal length in pixels.
#pragma once

namespace rockyard::vision {

// Of equations 15 to 23.
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
