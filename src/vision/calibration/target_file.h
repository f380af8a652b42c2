// Files that describe a target, and where it stood if somebody surveyed that: an input of
// `rockyard calibrate`.
//
//   {"rows": 6, "columns": 9, "spacing_m": 0.03,
//    "poses": [{"position_m": [x, y, z], "rotation_wxyz": [w, x, y, z]}, ...]}
//
// `poses` may be left out. Otherwise it has one pose for each image, in the order of the images:
// X_AT, of the board's frame (chessboard_params.h) in the frame in which the cameras are wanted.
// Must stay, as people keep such files: names, order of numbers and units.
#pragma once

#include <filesystem>
#include <vector>

#include "vision/calibration/chessboard_params.h"

namespace rockyard::vision {

struct Target {
  ChessboardParams board;
  std::vector<math::Transform> surveyed_X_AT;  // empty: not surveyed
};

// Returns the target in a file. Throws core::UserError with everything that is wrong: file and JSON
// path, and what would be right. The number of poses is not compared with that of images.
Target LoadTarget(const std::filesystem::path& path);

}  // namespace rockyard::vision
