// A rock as a pinhole camera sees it: its outline, and the depth of its surface within.
#pragma once

#include "math/pose.h"
#include "sensing/stereo_view.h"
#include "terrain/rock_shape.h"

namespace rockyard::sensing {

// A span of columns of an image row, as real numbers; empty where first > last.
struct ColumnSpan {
  double first = 1.0;
  double last = 0.0;
};

// One row's cut through the rock: quadratics in the column.
struct RowCut {
  double quadratic = 0.0;  // discriminant = (quadratic c + 2 linear) c + constant
  double linear = 0.0;
  double constant = 0.0;
  double approach_0 = 0.0;  // approach = approach_0 + approach_1 c
  double approach_1 = 0.0;
  double inverse_outside_1 = 0.0;
  // The columns within which the row can meet the rock. Where it is exact, every column in it does.
  ColumnSpan span;
  bool exact = true;

  double Discriminant(double column) const {
    return (quadratic * column + 2.0 * linear) * column + constant;
  }
  double Approach(double column) const { return approach_0 + approach_1 * column; }
  // Returns one over the depth at a column, 1/m; 0 where the ray misses.
  double InverseDepth(double column) const;
  // Returns at least the largest InverseDepth of the row, where the span is exact.
  double NearestInverseDepth() const;
};

// The outline of a rock in an image. In the coordinates in which the rock is the unit sphere, with
// the eye at q and the pixel's ray e(c, r) = e0 + c e1 + r e2, the ray meets it at depth Z where |q
// + Z e| = 1, so that
//   1/Z = (B + sqrt(B^2 - K |e|^2)) / K,  B = -q . e, K = |q|^2 - 1 (terrain/rock_shape.h).
// The discriminant is a quadratic form of (c, r): the outline is a conic, and where it is an
// ellipse its rows and the columns of each row have closed forms.
class RockOutline {
 public:
  // The view is given in W; `eye_W` is one of its two eyes.
  RockOutline(const terrain::RockShape& shape, const math::Vector3& center_W,
              const StereoView& view_W, const math::Vector3& eye_W);

  // Returns whether the eye lies within the rock; then there is no outline.
  bool ContainsEye() const { return outside_1_ <= 0.0; }

  // Rows from first_row() to last_row(), within the image, can meet the rock.
  int first_row() const { return first_row_; }
  int last_row() const { return last_row_; }
  RowCut Row(double row) const;

 private:
  void FindRows(int rows);

  double outside_1_;  // K
  double b0_, b1_, b2_;
  double a_;             // of c^2 in the discriminant
  double d0_, d1_;       // of 2 c and of 2 c r
  double f0_, f1_, f2_;  // of 1, 2 r and r^2
  int first_row_ = 0;
  int last_row_ = -1;
};

}  // namespace rockyard::sensing
