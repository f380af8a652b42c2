// The text form of flight calibrations (.cahv, .cahvor, .cahvore), as JPL's camera model library
// writes it: a line `Key = values` for everything, `#` before comments. camera_file.h reads it, and
// `rockyard calibrate` writes it.
//
//   # A fisheye on a mast.
//   Model = CAHVORE3,0.37 = general
//   Dimensions = 1024 768
//   C = 0.1 0.25 -1.2
//   A = 1 0 0
//   H = 511.5 400 0
//   V = 383.5 0 400
//   O = 1 0 0
//   R = 0 -0.013 -0.0075
//   E = 0.001 0.002 0.0015
//
// Model is CAHV, CAHVOR, CAHVORE1 (perspective), CAHVORE2 (fisheye) or CAHVORE3 with its linearity
// after a comma; what follows a second `=` is for people. Mclass is another name of Model. CAHVORE
// may get its number from Mtype or T and its linearity from Mparm or P; a linearity of types 1 and
// 2 is read and ignored. CAHV ends at V, CAHVOR at R. Covariances (`S =`, `S internal =`, and the
// rows of numbers below them) and what follows from the vectors (Hs, Hc, Vs, Vc, Theta) are passed
// over. Any other key is an error.
//
// A pair is two such blocks in one text, below lines `Camera = left` and `Camera = right`.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/json_value.h"
#include "vision/cameras/camera_model.h"

namespace rockyard::vision {

struct CameraPair {
  CameraModel left;
  CameraModel right;
};

// Longer files of cameras are refused, in bytes: a covariance of 21 x 21 numbers takes 8 KiB.
inline constexpr std::size_t kLargestCameraFile = std::size_t{1} << 20;

// Returns the camera in a text. Throws UserError with everything that is wrong: the paths are
// `source_name`, the reasons name lines.
CameraModel ParseCameraText(std::string_view text, std::string_view source_name);

// Returns the pair in a text. Throws as ParseCameraText does.
CameraPair ParseCameraPairText(std::string_view text, std::string_view source_name);

// Returns the text of a Cahv, Cahvor or Cahvore (no other lens is allowed), which reads back to the
// same bits. `comment` becomes lines behind `#`.
std::string CameraText(const CameraModel& camera, std::string_view comment = {});
std::string CameraPairText(const CameraPair& pair, std::string_view comment = {});

// The lines of one camera, sorted into the fields of camera_fields.h.
struct CameraBlock {
  std::string camera;  // left or right; empty where the text says neither
  int line = 1;        // where it begins
  core::JsonValue fields = core::JsonValue::Object();
  std::map<std::string, int, std::less<>> lines;  // by the field's name
};

struct CameraBlocks {
  std::vector<CameraBlock> blocks;
  std::vector<core::Problem> problems;  // the first 20, each names its line
};

// Sorts the lines of a text. A block begins with each line `Camera = NAME`. There are at most three
// blocks, one more than a pair has, so that the reader can refuse what follows.
CameraBlocks SortLines(std::string_view text, std::string_view source_name);

}  // namespace rockyard::vision
