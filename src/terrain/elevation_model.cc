#include "terrain/elevation_model.h"

#include <cmath>
#include <memory>

#include "core/check.h"
#include "terrain/relief_spline.h"

namespace rockyard::terrain {
namespace {

// Finds the coefficients of the cubic spline through values at 0, 1, ..., n - 1, n >= 4: with c_i
// centred on i, (c_(i-1) + 4 c_i + c_(i+1)) / 6 = f_i. That the third derivative does not jump at 1
// says that the fourth difference of c_(-1) to c_3 is 0; with the equations of f_0, f_1 and f_2
//   c_1 = (8 f_1 - f_0 - f_2) / 6,
// and likewise c_(n-2). What lies between is a tridiagonal system, what lies outside follows.
class NotAKnot {
 public:
  explicit NotAKnot(std::size_t size) : size_(size), pivots_(size) {
    EXPECT(size >= 4);
    // Elimination of (1 4 1): the pivot after p is 4 - 1/p.
    for (std::size_t i = 2; i + 2 < size_; ++i) {
      pivots_[i] = 1.0 / (i == 2 ? 4.0 : 4.0 - pivots_[i - 1]);
    }
  }

  // Reads the values at values[0], values[stride], ..., and writes one coefficient more at each
  // end: the first one is that of -1.
  void Solve(const double* values, std::size_t value_stride, double* out,
             std::size_t out_stride) const {
    const auto f = [&](std::size_t i) { return values[i * value_stride]; };
    const auto c = [&](std::size_t i) -> double& { return out[(i + 1) * out_stride]; };
    const std::size_t last = size_ - 1;
    c(1) = (8.0 * f(1) - f(0) - f(2)) / 6.0;
    c(last - 1) = (8.0 * f(last - 1) - f(last) - f(last - 2)) / 6.0;
    for (std::size_t i = 2; i + 2 < size_; ++i) {
      const double ahead = i + 3 == size_ ? c(last - 1) : 0.0;
      c(i) = (6.0 * f(i) - ahead - c(i - 1)) * pivots_[i];
    }
    for (std::size_t i = last - 2; i-- > 2;) c(i) -= c(i + 1) * pivots_[i];
    c(0) = 6.0 * f(1) - 4.0 * c(1) - c(2);
    out[0] = 6.0 * f(0) - 4.0 * c(0) - c(1);
    c(last) = 6.0 * f(last - 1) - 4.0 * c(last - 1) - c(last - 2);
    c(last + 1) = 6.0 * f(last) - 4.0 * c(last) - c(last - 1);
  }

 private:
  std::size_t size_;
  std::vector<double> pivots_;  // inverse
};

}  // namespace

ElevationModel::ElevationModel(const ElevationParams& params)
    : cell_m_(params.cell_m),
      columns_(params.columns),
      rows_(params.rows()),
      first_column_(-params.origin_column),
      first_row_(-params.origin_row),
      heights_m_(params.heights_m) {
  EXPECT(params.IsSound());
  const auto columns = static_cast<std::size_t>(columns_);
  const auto rows = static_cast<std::size_t>(rows_);
  const std::size_t width = columns + 2;
  std::vector<double> along_x(width * rows);
  const NotAKnot row_solver(columns);
  for (std::size_t row = 0; row < rows; ++row) {
    row_solver.Solve(heights_m_.data() + row * columns, 1, along_x.data() + row * width, 1);
  }
  coefficients_m_.resize(width * (rows + 2));
  const NotAKnot column_solver(rows);
  for (std::size_t column = 0; column < width; ++column) {
    column_solver.Solve(along_x.data() + column, width, coefficients_m_.data() + column, width);
  }
  // Differences reach two nodes further, where the coefficients of the edge repeat.
  const std::int64_t left = first_column_ - 3;
  const std::int64_t low = first_row_ - 3;
  bounds_ =
      BoundsOfSplines(static_cast<int>(columns_ + 6), static_cast<int>(rows_ + 6), cell_m_,
                      [&](int column, int row) { return Coefficient(left + column, low + row); });
  // A model lies on one side of zero as often as on both.
  bounds_.height_m = *std::max_element(coefficients_m_.begin(), coefficients_m_.end());
}

bool ElevationModel::IsOf(const ElevationParams& params) const {
  return cell_m_ == params.cell_m && columns_ == params.columns &&
         first_column_ == -params.origin_column && first_row_ == -params.origin_row &&
         heights_m_ == params.heights_m;
}

std::shared_ptr<const ReliefSpline> SharedSurface::Of(const ElevationParams& params) {
  const std::lock_guard lock(mutex_);
  if (!surface_ || !surface_->model()->IsOf(params)) {
    surface_ = std::make_shared<const ReliefSpline>(std::make_shared<const ElevationModel>(params),
                                                    nullptr);
  }
  return surface_;
}

}  // namespace rockyard::terrain
