// Files that describe a target, and where it stood if somebody surveyed that.
//
//   {"rows": 6, "columns": 9, "spacing_m": 0.03,
//    "poses": [{"position_m": [x, y, z], "rotation_wxyz": [w, x, y, z]}, ...]}
//
// `poses` may be left out. With it, it has one pose for each image, in their order: X_AT, the frame
// of the board (chessboard_params.h) in the frame in which the cameras are wanted.
#pragma once

#include <filesystem>
#include <vector>

#include "vision/calibration/chessboard_params.h"

namespace rockyard::vision {

struct Target {
  ChessboardParams board;
  std::vector<math::Transform> surveyed_X_AT;  // empty: not surveyed
};

// Throws core::UserError with everything that is wrong: file and JSON path, and what would be
// right.
Target LoadTarget(const std::filesystem::path& path);

}  // namespace rockyard::vision
