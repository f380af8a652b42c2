// A chessboard as a target of known geometry: what target files describe, images are searched for
// and calibration takes as known.
//
// Its frame T: origin at one of the outermost inner corners, x along a row of corners, y along a
// column of them, z into the board, so that x points right and y down for who sees the board
// upright. The square between corners (0, 0), (0, 1), (1, 0) and (1, 1) is dark. As one of rows and
// columns is odd and the other even, the square inside the opposite corner is bright, and an image
// shows which corner is the origin.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/fields.h"
#include "math/pose.h"

namespace rockyard::vision {

struct ChessboardParams {
  std::int64_t rows = 0;     // of inner corners, where four squares meet
  std::int64_t columns = 0;  // of inner corners
  double spacing_m = 0.0;    // between neighbouring corners

  // Nothing has a default: a board that is not described is an error.
  void Visit(core::FieldVisitor& v);

  std::size_t corners() const { return static_cast<std::size_t>(rows * columns); }
};

// Returns where corner `index` is, p_T, m. Corners count row by row from the origin, in this order
// in all of calibration.
math::Vector3 CornerPosition(const ChessboardParams& board, std::size_t index);

}  // namespace rockyard::vision
