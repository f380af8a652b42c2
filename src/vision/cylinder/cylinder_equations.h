// From what is seen of the cylinder to its orientation and distance (Matthies 1995, A.1), and how
// far one pixel moves both (A.2): the published finder runs on these equations, and the lander's
// law of fixes in drives on equation 20. Also how the cameras of a pair stand, and the point that
// both see, for both finders.
#pragma once

#include <optional>

#include "vision/cameras/camera_model.h"
#include "vision/cameras/rectification.h"
#include "vision/cylinder/colour_cylinder.h"
#include "vision/cylinder/cylinder_sighting.h"

namespace rockyard::vision {

// Which quadrant is not seen: the rows of the table below equation 13, in its order, which OffsetOf
// relies on.
enum class AbsentQuadrant { kC, kD, kA, kB };

// Returns theta_0 of a row, rad: 0, pi/2, pi, 3 pi/2.
double OffsetOf(AbsentQuadrant absent);

// The colours side by side; nothing on a side where none is seen.
struct ColourOrder {
  std::optional<CylinderColour> left;
  CylinderColour middle = CylinderColour::kBlue;
  std::optional<CylinderColour> right;
};

// Why no row is chosen. kUnlike: no row has this order; kAnyPink: only a magenta middle is seen,
// which two rows have.
enum class OrderDoubt { kUnlike, kAnyPink };
struct RowChoice {
  std::optional<AbsentQuadrant> absent;
  OrderDoubt doubt = OrderDoubt::kUnlike;  // where none is chosen
};
// Chooses the row of the table. The text takes the row of the colour that is absent, but quadrants
// B and D are both pink and one class, so that the colour alone does not say which of them is
// absent. The order of the colours does:
//
//   left     middle   right      absent  theta_0
//   magenta  blue     magenta    C       0
//   blue     magenta  red        D       pi/2
//   magenta  red      magenta    A       pi
//   red      magenta  blue       B       3 pi/2
//
// A side on which nothing is seen fits any colour.
RowChoice ChooseRow(const ColourOrder& order);

// How much is seen of the middle quadrant (k_1), of that to its right (k_2) and to its left (k_3),
// in any one unit. As in equations 5 to 8, at theta_0 = 0 these are A, B and D.
struct ColourQuantities {
  double k1 = 0.0;
  double k2 = 0.0;
  double k3 = 0.0;
};

// Returns theta by equation 14, rad, in [-pi, pi]. Requires k1 > 0, k2 >= 0 and k3 >= 0.
//
//   theta = theta_0 + atan2(k1 + k2 - k3, k1 - k2 + k3)
//
// atan2(x, y) of the text is arc tan(x / y), hence the same order of arguments as std::atan2.
double OrientationOf(AbsentQuadrant absent, const ColourQuantities& k);

// Returns the distance by equation 15 with f = M / (2 tan(phi / 2)): d = 2 f rho / m.
double DistanceBySize(double focal_px, double radius_m, double m_px);

// Returns the distance by equation 16, d = d_0 + rho^2 / d with d_0 of equation 15, solved as the
// quadratic d^2 - d_0 d - rho^2 = 0, whose positive root is (d_0 + sqrt(d_0^2 + 4 rho^2)) / 2.
double DistanceBySizeNear(double focal_px, double radius_m, double m_px);

// The quantities of equations 15 to 23, which take the image for orthographic: m is the cylinder's
// width in the image, px; M the width of the image, px; phi the field of view, rad; rho the radius
// of the cylinder, b the baseline and d the distance, m. tan(phi / 2) = M / (2 f) with f the focal
// length in pixels.
struct ViewOfCylinder {
  double image_width_px = 512.0;  // M
  double field_of_view_rad = 0.0;
  double radius_m = 0.0;
  double baseline_m = 0.0;
};

// Return the change of theta by one pixel, rad: 2 / m with a boundary of colours in the middle of
// the cylinder (equation 18), 2 sqrt(2) / m with a boundary 45 deg off the middle (equation 19).
// The latter is the text's cos(pi / 4), where both boundaries of the middle quadrant are seen.
double FinestTurn(double m_px);
double CoarsestTurn(double m_px);

// Return the same by distance, rad, with m of equation 16 (equations 20 and 21). Records of drives
// depend on FinestTurnAt: the lander's law of fixes takes the cylinder's width from it.
double FinestTurnAt(const ViewOfCylinder& view, double d_m);
double CoarsestTurnAt(const ViewOfCylinder& view, double d_m);

// Return |dd| / d by one pixel of width and of disparity (equations 22 and 23, without the minus
// sign by which more pixels are less distance).
double RelativeStepBySize(const ViewOfCylinder& view, double d_m);
double RelativeStepByStereo(const ViewOfCylinder& view, double d_m);

// How the cameras of a pair stand, as far as the finders need it.
struct EyeGeometry {
  double focal_px = 0.0;    // of the left camera in the middle of its image, along the rows
  double baseline_m = 0.0;  // between the centres
  math::Vector3 centre_L = math::Vector3::Zero();  // of the left camera, m
  math::Vector3 middle_L = math::Vector3::Zero();  // between both centres, m
  // Directions of the left camera, of length 1: its optical axis, and, in the middle of its image,
  // to the right along a row and upwards along a column.
  math::Vector3 forward_L = math::Vector3::Zero();
  math::Vector3 right_L = math::Vector3::Zero();
  math::Vector3 up_L = math::Vector3::Zero();
  std::optional<RectifiedPair> aligned;  // where the pair is aligned as it stands (AlignedPair)
};

// Returns nothing where the left camera images nothing in its middle.
std::optional<EyeGeometry> GeometryOf(const ColourPair& pair);

struct SeenPoint {
  math::Vector3 p_L = math::Vector3::Zero();  // m
  double depth_m = 0.0;                       // along the left camera's axis
};

// Returns the point that both pixels show: for aligned cameras by the disparity alone (equation 17
// of Matthies 1995, whatever the rows), otherwise the middle of the shortest line between both
// lines of sight. Returns nothing where the lines of sight do not meet before the cameras: the
// disparity is not positive, or the nearest point is behind a camera.
std::optional<SeenPoint> PointSeenAt(const ColourPair& pair, const EyeGeometry& eyes,
                                     const Pixel& left_px, const Pixel& right_px);

}  // namespace rockyard::vision
