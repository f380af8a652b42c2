// The surface through the heights of an elevation model: bicubic splines. relief_spline.h asks it
// for its nodes, and answers rays and samples for the ground. Records of drives on a model depend
// on the bits of Coefficient.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "terrain/elevation_params.h"
#include "terrain/relief.h"

namespace rockyard::terrain {

// A bicubic spline that goes through every height, as coefficients of B-splines. It is twice
// continuously differentiable; at the edges the third derivative goes on over the last node but one
// ("not a knot", de Boor 2001, ch. IV), so that planes and cubics are met exactly up to the edge.
// Of a smooth ground f that was sampled with the cell h the surface is within
//   (5/384) h^4 (max|f_xxxx| + max|f_yyyy|)
// in height (Hall and Meyer 1976, of splines whose slopes at the ends are known) and by h^3 in
// slope; in the three cells at an edge the error is up to seven times that, as tests find. Beyond
// the edges the last coefficients stand for all further ones: the ground goes on level, as
// smoothly.
class ElevationModel {
 public:
  // The parameters must be sound. Cost: about 20 ns a node.
  explicit ElevationModel(const ElevationParams& params);

  double cell_m() const { return cell_m_; }
  // The nodes, counted from the one at the world's origin.
  std::int64_t first_column() const { return first_column_; }
  std::int64_t first_row() const { return first_row_; }
  std::int64_t last_column() const { return first_column_ + columns_ - 1; }
  std::int64_t last_row() const { return first_row_ + rows_ - 1; }

  // Returns the coefficient, m, of the B-spline that is centred on a node, counted from the one at
  // the world's origin; beyond the edges those of the edge.
  double Coefficient(std::int64_t column, std::int64_t row) const {
    // Splines centred on one node beyond each edge reach into the model.
    const std::int64_t i = std::clamp(column - first_column_ + 1, std::int64_t{0}, columns_ + 1);
    const std::int64_t k = std::clamp(row - first_row_ + 1, std::int64_t{0}, rows_ + 1);
    return coefficients_m_[static_cast<std::size_t>(k * (columns_ + 2) + i)];
  }

  // Upper bounds over all points, beyond the edges too.
  const ReliefBounds& bounds() const { return bounds_; }
  // Returns whether the model is that of the parameters.
  bool IsOf(const ElevationParams& params) const;

 private:
  double cell_m_;
  std::int64_t columns_;
  std::int64_t rows_;
  std::int64_t first_column_;
  std::int64_t first_row_;
  std::vector<double> heights_m_;
  std::vector<double> coefficients_m_;  // (columns_ + 2) x (rows_ + 2), row by row
  ReliefBounds bounds_;
};

}  // namespace rockyard::terrain
