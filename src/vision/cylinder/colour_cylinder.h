// The coloured cylinder by which the lander finds the rover (Matthies 1995, section 5 and appendix
// A). `rockyard cylinder` and the experiment on sightings of the cylinder look for it in images;
// the lander's law of fixes in drives takes its diameter.
//
// Frame T of the cylinder: origin in its centre, z along its axis upwards, x forward. Its wall has
// four quadrants, counter-clockwise seen from above:
//
//   A   0 to  90 deg   blue                      C 180 to 270 deg   orange (class "red")
//   B  90 to 180 deg   pink (class "magenta")    D 270 to 360 deg   pink
//
// Its orientation theta is the azimuth, in T, of the viewer, that is of the middle between two
// cameras. The viewer's left is n = rho (sin(theta), -cos(theta)) (equations 9, 10), so that at
// 0 < theta < 90 deg quadrant A stands in the middle, D to its left and B to its right (equations
// 5 to 8). At -180 < theta < -90 deg, where section 5 has the large errors, no blue is seen.
//
// Words of this folder: L is the cameras' outer frame. The wall is the round surface without the
// lids; its rims are the upper and the lower end. A class is one of three colours, and the label of
// a pixel says its class or background. A region is a set of pixels that hang together, a box its
// bounding box. A surface has a colour of its own: those of the quadrants, and the ground.
#pragma once

#include <array>
#include <string_view>

#include "core/fields.h"
#include "math/pose.h"

namespace rockyard::vision {

// The three classes of colours of A.3. The third is called after the orange of section 5; the green
// panel that section 5 proposes in its place belongs to the same class with other ranges.
enum class CylinderColour { kBlue, kMagenta, kRed };

inline constexpr int kCylinderColours = 3;

// Quadrants A, B, C and D.
inline constexpr std::array<CylinderColour, 4> kQuadrantColours = {
    CylinderColour::kBlue, CylinderColour::kMagenta, CylinderColour::kRed,
    CylinderColour::kMagenta};

// Section 5: "a cylinder 19.2 cm in diameter by 10 cm high".
struct ColourCylinder {
  double diameter_m = 0.192;  // records of drives depend on this default: the lander's law of fixes
  double height_m = 0.10;
  // The direction of its axis upwards, in frame L, of any length.
  std::array<double, 3> axis_L = {0.0, 0.0, 1.0};

  // Returns the axis with length 1.
  math::Vector3 Axis_L() const { return math::Vector3(axis_L.data()).normalized(); }

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::vision

template <>
struct rockyard::core::EnumNames<rockyard::vision::CylinderColour> {
  static constexpr std::array<std::string_view, 3> kNames{"blue", "magenta", "red"};
};
