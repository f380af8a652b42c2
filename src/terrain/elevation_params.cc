#include "terrain/elevation_params.h"

namespace rockyard::terrain {

bool ElevationParams::Holds(double x_min_m, double x_max_m, double y_min_m, double y_max_m) const {
  // A micrometre of tolerance for edges that fall on nodes.
  constexpr double kTolerance_m = 1e-6;
  const auto at = [this](std::int64_t node) { return static_cast<double>(node) * cell_m; };
  return x_min_m >= at(-origin_column) - kTolerance_m &&
         x_max_m <= at(columns - 1 - origin_column) + kTolerance_m &&
         y_min_m >= at(-origin_row) - kTolerance_m &&
         y_max_m <= at(rows() - 1 - origin_row) + kTolerance_m;
}

void ElevationParams::Visit(core::FieldVisitor& v) {
  v.Real("cell_m", cell_m,
         core::Setting("side of a cell: distance of neighbouring nodes along x and along y",
                       {0.01, 1000.0}));
  v.Integer("columns", columns,
            core::Setting("nodes of a row, along x; 0: no model", {0, std::int64_t{kMostNodes}}));
  v.Integer("origin_column", origin_column,
            core::Setting("column, from 0, of the node at the world's origin",
                          {0, std::int64_t{kMostNodes}}));
  v.Integer("origin_row", origin_row,
            core::Setting("row, from 0, of the node at the world's origin",
                          {0, std::int64_t{kMostNodes}}));
  core::FieldInfo heights = core::Setting(
      "height of every node, row by row from the smallest y on, x ascending", {-20000.0, 20000.0});
  heights.max_entries = kMostNodes;
  v.Reals("heights_m", heights_m, heights);
  v.Text("source", source,
         core::Setting("what the heights are: product, crop, licence; decides nothing"));
  v.Require("columns", columns > 0 || heights_m.empty(), "is 0 where heights_m has heights",
            "give the number of nodes of a row, or leave heights_m empty");
  v.Require("heights_m", columns <= 0 || IsSound(),
            "does not hold four or more full rows of four or more columns",
            "give columns times rows heights, at least 4 x 4");
  if (!IsGiven() || !IsSound()) return;
  v.Require("origin_column", origin_column < columns, "lies beyond the last column",
            "use 0 to columns - 1");
  v.Require("origin_row", origin_row < rows(), "lies beyond the last row", "use 0 to rows - 1");
}

}  // namespace rockyard::terrain
