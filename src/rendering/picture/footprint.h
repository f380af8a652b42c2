// What a pixel sees of a surface.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace rockyard::rendering {

// The parallelogram around a point that a pixel covers in a plane: its sides, m.
struct Footprint {
  Eigen::Vector2d column_m = Eigen::Vector2d::Zero();  // from one column to the next
  Eigen::Vector2d row_m = Eigen::Vector2d::Zero();

  // The rectangle of the same second moments: a box of sides c and r has the moments
  // (c c^T + r r^T) / 12, one along unit axes e, f with lengths l, w has (l^2 e e^T + w^2 f f^T)
  // / 12.
  struct Ellipse {
    Eigen::Vector2d long_axis;  // unit
    double length_m;
    double width_m;  // no more than the length
  };
  Ellipse Axes() const {
    // Eigenvalues and vectors of the symmetric matrix [a b; b d].
    const double a = column_m.x() * column_m.x() + row_m.x() * row_m.x();
    const double b = column_m.x() * column_m.y() + row_m.x() * row_m.y();
    const double d = column_m.y() * column_m.y() + row_m.y() * row_m.y();
    const double half = 0.5 * (a - d);
    const double root = std::sqrt(half * half + b * b);
    const double large = 0.5 * (a + d) + root;
    // The determinant is the square of the area, in the form in which nothing cancels.
    const double area = column_m.x() * row_m.y() - column_m.y() * row_m.x();
    // Of the two rows of M - small I the one along the larger component.
    Eigen::Vector2d axis =
        half >= 0.0 ? Eigen::Vector2d(half + root, b) : Eigen::Vector2d(b, root - half);
    const double norm = axis.norm();
    axis = norm > 0.0 ? Eigen::Vector2d(axis / norm) : Eigen::Vector2d::UnitX();
    const double length = std::sqrt(large);
    return {axis, length, length > 0.0 ? std::abs(area) / length : 0.0};
  }
};

}  // namespace rockyard::rendering
