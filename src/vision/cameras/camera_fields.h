// Cameras as files hold them: the fields of every model, their ranges and what must hold across
// them. Files in JSON (camera_file.h) and the text of flight calibrations (camera_text.h) are both
// read through these fields.
//
//   {"model": "cahvore", "columns": 1024, "rows": 1024, "C": [...], "A": [...], "H": [...],
//    "V": [...], "O": [...], "R": [...], "E": [...], "type": "general", "linearity": 0.37}
//   {"model": "brown", "columns": 640, "rows": 480, "position_m": [x, y, z],
//    "rotation_wxyz": [w, x, y, z], "focal_px": [fx, fy], "centre_px": [cx, cy],
//    "radial": [k1, k2, k3], "tangential": [p1, p2]}
//
// cahv has no O, R and E, cahvor no E; linearity belongs to type general alone. position_m and
// rotation_wxyz are X_AC of a pinhole, its pose in the camera's outer frame. No field has a
// default: a calibration with a number left out is refused. Must stay, as people keep such files:
// names of fields, order of numbers and units.
#pragma once

#include <array>
#include <cstdint>

#include "core/fields.h"
#include "core/numbers.h"
#include "vision/cameras/camera_model.h"

namespace rockyard::vision {

// The longest side of an image, px.
inline constexpr int kLongestSide_px = 65536;

using Triple = std::array<double, 3>;
inline constexpr Triple kUnknownTriple = {core::kNaN, core::kNaN, core::kNaN};

struct CameraFields {
  int model = -1;  // place in kModelNames; -1 where nothing is known
  std::int64_t columns = 0;
  std::int64_t rows = 0;
  Triple C_m = kUnknownTriple;
  Triple A = kUnknownTriple;
  Triple H_px = kUnknownTriple;
  Triple V_px = kUnknownTriple;
  Triple O = kUnknownTriple;
  Triple R = kUnknownTriple;
  Triple E_m = kUnknownTriple;
  int type = -1;  // of a cahvore
  double linearity = core::kNaN;
  Triple position_m = kUnknownTriple;
  std::array<double, 4> rotation_wxyz = {core::kNaN, core::kNaN, core::kNaN, core::kNaN};
  std::array<double, 2> focal_px = {core::kNaN, core::kNaN};
  std::array<double, 2> centre_px = {core::kNaN, core::kNaN};
  Triple radial = kUnknownTriple;
  std::array<double, 2> tangential = {core::kNaN, core::kNaN};

  void Visit(core::FieldVisitor& visitor);
};

// The two cameras of a stereo pair, in one outer frame.
struct CameraPairFields {
  CameraFields left;
  CameraFields right;

  void Visit(core::FieldVisitor& v);
};

// Returns the camera of fields that were read without a problem.
CameraModel ModelOf(const CameraFields& fields);

// Returns the fields of a camera: the inverse of ModelOf.
CameraFields FieldsOf(const CameraModel& camera);

}  // namespace rockyard::vision
