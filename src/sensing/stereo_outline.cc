#include "sensing/stereo_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rockyard::sensing {
namespace {

using math::Vector3;

constexpr double kEverywhere = std::numeric_limits<double>::infinity();

}  // namespace

double RowCut::InverseDepth(double column) const {
  const double discriminant = Discriminant(column);
  const double approach = Approach(column);
  if (!(discriminant >= 0.0 && approach > 0.0)) return 0.0;
  return (approach + std::sqrt(discriminant)) * inverse_outside_1;
}

double RowCut::NearestInverseDepth() const {
  const double approach = std::max(Approach(span.first), Approach(span.last));
  // Most of both terms over the row: the discriminant a c^2 + 2 l c + k with a < 0 has its peak k -
  // l^2 / a, and the linear B is largest at an end of the span.
  const double peak = std::max(constant - linear * linear / quadratic, 0.0);
  return (approach + std::sqrt(peak)) * inverse_outside_1;
}

RockOutline::RockOutline(const terrain::RockShape& shape, const Vector3& center_W,
                         const StereoView& view_W, const Vector3& eye_W) {
  // B = -q . e = b0 + c b1 + r b2, and the discriminant B^2 - K |e|^2 expands to
  //   a c^2 + 2 (d0 + d1 r) c + f0 + 2 f1 r + f2 r^2.
  const Vector3 q = shape.Map(eye_W - center_W);
  const Vector3 e0 = shape.Map(view_W.first);
  const Vector3 e1 = shape.Map(view_W.along_row);
  const Vector3 e2 = shape.Map(view_W.along_column);
  outside_1_ = q.squaredNorm() - 1.0;
  b0_ = -q.dot(e0);
  b1_ = -q.dot(e1);
  b2_ = -q.dot(e2);
  a_ = b1_ * b1_ - outside_1_ * e1.squaredNorm();
  d0_ = b0_ * b1_ - outside_1_ * e0.dot(e1);
  d1_ = b2_ * b1_ - outside_1_ * e2.dot(e1);
  f0_ = b0_ * b0_ - outside_1_ * e0.squaredNorm();
  f1_ = b0_ * b2_ - outside_1_ * e0.dot(e2);
  f2_ = b2_ * b2_ - outside_1_ * e2.squaredNorm();
  if (!ContainsEye()) FindRows(view_W.rows);
}

// Rows r in which the columns' quadratic a c^2 + 2 l c + k, a < 0, has roots: l^2 - a k >= 0, which
// is g2 r^2 + 2 g1 r + g0 >= 0 with g2 < 0, between its roots (-g1 +- sqrt(g1^2 - g2 g0)) / g2.
void RockOutline::FindRows(int rows) {
  first_row_ = 0;
  last_row_ = rows - 1;
  const double g2 = d1_ * d1_ - a_ * f2_;
  if (a_ >= 0.0 || g2 >= 0.0) return;  // no ellipse: any row
  const double g1 = d0_ * d1_ - a_ * f1_;
  const double g0 = d0_ * d0_ - a_ * f0_;
  const double root = g1 * g1 - g2 * g0;
  if (root < 0.0) {
    last_row_ = -1;
    return;
  }
  // One row more on both sides, for rounding; Row says what is in it.
  const double middle = -g1 / g2;
  const double half = -std::sqrt(root) / g2 + 1.0;
  first_row_ = static_cast<int>(std::clamp(middle - half, 0.0, static_cast<double>(rows)));
  last_row_ = static_cast<int>(std::clamp(middle + half, -1.0, rows - 1.0));
}

RowCut RockOutline::Row(double row) const {
  RowCut cut{.quadratic = a_,
             .linear = d0_ + d1_ * row,
             .constant = f0_ + (2.0 * f1_ + f2_ * row) * row,
             .approach_0 = b0_ + b2_ * row,
             .approach_1 = b1_,
             .inverse_outside_1 = 1.0 / outside_1_,
             .span = {},
             .exact = true};
  // The quadratic opens upwards: the columns that meet the rock have no two ends.
  if (a_ >= 0.0) {
    cut.span = {-kEverywhere, kEverywhere};
    cut.exact = false;
    return cut;
  }
  const double root = cut.linear * cut.linear - a_ * cut.constant;
  const double middle = -cut.linear / a_;
  // B <= 0: the rock lies behind the eye. The default span is empty.
  if (root < 0.0 || cut.Approach(middle) <= 0.0) return cut;
  const double half = -std::sqrt(root) / a_;
  cut.span = {middle - half, middle + half};
  return cut;
}

}  // namespace rockyard::sensing
