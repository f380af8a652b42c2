#include "vision/calibration/chessboard_params.h"

namespace rockyard::vision {

void ChessboardParams::Visit(core::FieldVisitor& v) {
  v.Integer(
      "rows", rows,
      {.doc = "rows of inner corners", .min = 0, .max = 100, .origin = core::Origin::kSetting});
  v.Integer(
      "columns", columns,
      {.doc = "columns of inner corners", .min = 0, .max = 100, .origin = core::Origin::kSetting});
  v.Real("spacing_m", spacing_m,
         {.doc = "side of a square", .min = 0.0, .max = 100.0, .origin = core::Origin::kSetting});
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
