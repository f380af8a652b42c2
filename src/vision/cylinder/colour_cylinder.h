// The coloured cylinder by which the lander finds the rover (Matthies 1995, section 5 and appendix
// A).
//
// Frame T of the cylinder: origin in its centre, z along its axis upwards, x forward. Its wall has
// four quadrants, counter-clockwise seen from above:
//
//   A   0 to  90 deg   blue                      C 180 to 270 deg   orange (class "red")
//   B  90 to 180 deg   pink (class "magenta")    D 270 to 360 deg   pink
//
// Its orientation theta is the azimuth of the viewer in T: of the middle between two cameras. The
// viewer's left is n = rho (sin(theta), -cos(theta)) (equations 9, 10), so that quadrant A stands
// in the middle at 0 < theta < 90 deg, D to its left and B to its right (equations 5 to 8), and the
// range -180 < theta < -90 deg, that of section 5 with the large errors, shows no blue.
#pragma once

#include <array>
#include <string_view>

#include "core/fields.h"
#include "math/pose.h"

namespace rockyard::vision {

// The three classes of colours of A.3. The third one is called after the orange of section 5; the
// green panel that section 5 proposes in its place is of the same class with other ranges.
enum class CylinderColour { kBlue, kMagenta, kRed };

inline constexpr int kCylinderColours = 3;

// Quadrants A, B, C and D.
inline constexpr std::array<CylinderColour, 4> kQuadrantColours = {
    CylinderColour::kBlue, CylinderColour::kMagenta, CylinderColour::kRed,
    CylinderColour::kMagenta};

// Section 5: "a cylinder 19.2 cm in diameter by 10 cm high".
struct ColourCylinder {
  double diameter_m = 0.192;  // also that of the lander's law of fixes in drives (sensing)
  double height_m = 0.10;
  // Where its axis points, in the cameras' outer frame L, of any length: upwards.
  std::array<double, 3> axis_L = {0.0, 0.0, 1.0};

  // The axis with length 1.
  math::Vector3 Axis_L() const { return math::Vector3(axis_L.data()).normalized(); }

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::vision

template <>
struct rockyard::core::EnumNames<rockyard::vision::CylinderColour> {
  static constexpr std::array<std::string_view, 3> kNames{"blue", "magenta", "red"};
};
