#include "vision/calibration/chessboard_params.h"

namespace rockyard::vision {

using core::Setting;

void ChessboardParams::Visit(core::FieldVisitor& v) {
  // Ranges include 0, the value of a missing field, so that the conditions below can name it.
  v.Integer("rows", rows, Setting("rows of inner corners", {0, 100}));
  v.Integer("columns", columns, Setting("columns of inner corners", {0, 100}));
  v.Real("spacing_m", spacing_m, Setting("side of a square", {0.0, 100.0}));
  v.Require("rows", rows >= 3, "is missing or below 3",
            "count the corners where four squares meet");
  v.Require("columns", columns >= 3, "is missing or below 3",
            "count the corners where four squares meet");
  v.Require("spacing_m", spacing_m > 0.0, "is missing or 0", "give the side of a square in m");
  v.Require("rows", rows < 3 || columns < 3 || (rows + columns) % 2 == 1,
            "is odd or even as columns is: half a turn of such a board looks the same",
            "use a board with one of them odd and the other even, such as 6 by 9");
}

math::Vector3 CornerPosition(const ChessboardParams& board, std::size_t index) {
  const auto columns = static_cast<std::size_t>(board.columns);
  const std::size_t row = index / columns;
  return {static_cast<double>(index % columns) * board.spacing_m,
          static_cast<double>(row) * board.spacing_m, 0.0};
}

}  // namespace rockyard::vision
