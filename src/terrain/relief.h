// What the ground has beside its plane, fractal roughness, ditches and pits, and where a ray
// crosses it. Ground puts them together; relief_spline.h tells the same roughness for images.
// Records of drives on such ground depend on the bits of samples and of bounds, as rays step by
// both.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/random.h"
#include "math/functions.h"
#include "terrain/terrain_params.h"

namespace rockyard::terrain {

// Height and slopes at one point.
struct ReliefSample {
  double height_m = 0.0;
  double slope_x = 0.0;  // dz/dx
  double slope_y = 0.0;  // dz/dy
};

// Upper bounds over all points of a relief.
struct ReliefBounds {
  double height_m = 0.0;
  double slope = 0.0;            // magnitude
  double curvature_per_m = 0.0;  // magnitude of the second derivative in any direction
};

// Returns bounds of a bicubic B-spline on a lattice from its coefficients, m, `at`(column, row) for
// column and row from 0 on, and two more each. The derivative of a B-spline is a B-spline of the
// coefficients' differences over the spacing, and a B-spline lies within the hull of its
// coefficients.
template <typename Coefficient>
ReliefBounds BoundsOfSplines(int columns, int rows, double spacing_m, const Coefficient& at) {
  double height = 0.0, along_x = 0.0, along_y = 0.0, bend_x = 0.0, bend_y = 0.0, twist = 0.0;
  const auto grow = [](double& bound, double value) { bound = std::max(bound, std::abs(value)); };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double here = at(column, row);
      const double right = at(column + 1, row);
      const double above = at(column, row + 1);
      grow(height, here);
      // First differences bound the slope (over spacing), second differences the curvature (over
      // its square), the mixed one the twist.
      grow(along_x, right - here);
      grow(along_y, above - here);
      grow(bend_x, at(column + 2, row) - 2.0 * right + here);
      grow(bend_y, at(column, row + 2) - 2.0 * above + here);
      grow(twist, at(column + 1, row + 1) - right - above + here);
    }
  }
  // The norm of the matrix of second derivatives is no larger than its Frobenius norm.
  return {height, math::Hypot(along_x, along_y) / spacing_m,
          math::Hypot(math::Hypot(bend_x, bend_y), std::numbers::sqrt2 * twist) /
              (spacing_m * spacing_m)};
}

// How a ray nears the ground at one of its points.
struct Approach {
  double gap_m;  // height above the ground
  double rate;   // closing of the gap per metre of ray
};

// Returns a zero of `gap` between `above`, where it is positive, and `below`, where it is not, to
// 1e-12 m: false position with the Illinois rule (Dowell and Jarratt 1971), which halves the value
// at an end that stays. Both ways of RayWay (ground.h) must end here, so that they meet one point.
template <typename Gap>
double FindCrossing(const Gap& gap, double above, double gap_above, double below,
                    double gap_below) {
  // Records on rough ground depend on this width in their last bits.
  constexpr double kCrossingWidth_m = 1e-12;
  constexpr int kMaxCrossingSteps = 100;
  int kept_end = 0;  // -1 below, +1 above: the end that the last step left where it was
  for (int i = 0; i < kMaxCrossingSteps && below - above > kCrossingWidth_m; ++i) {
    // The secant's zero between the two ends.
    const double t = below - gap_below * (below - above) / (gap_below - gap_above);
    const double gap_t = gap(t);
    if (std::abs(gap_t) < kCrossingWidth_m) return t;
    if (gap_t > 0.0) {
      above = t;
      gap_above = gap_t;
      if (kept_end == -1) gap_below *= 0.5;
      kept_end = -1;
    } else {
      below = t;
      gap_below = gap_t;
      if (kept_end == 1) gap_above *= 0.5;
      kept_end = 1;
    }
  }
  return above;
}

// Ditches and pits as a height field. At the distance r from its segment a depression of depth D,
// half width R and flank e is
//   D          where r <= R - e: the floor,
//   D (1 - S)  with s = (r - R + e) / e and S = s^3 (10 - 15 s + 6 s^2) on the flank,
//   0          where r >= R
// deep: twice continuously differentiable, without libm. Where several overlap the deepest counts,
// so that a ditch across another is no deeper than either; only there the slope can jump, over a
// ridge.
class DepressionField {
 public:
  explicit DepressionField(const std::vector<Depression>& depressions);

  // Returns height, 0 or less, and slopes at a point. Cost: 1 to 3 ns for each depression.
  ReliefSample Sample(double x_m, double y_m) const;

  // Returns whether any depression reaches into the disc around (x, y).
  bool Reaches(double x_m, double y_m, double radius_m) const;

  // These are the largest magnitudes of the slope and of the second derivative in any direction,
  // 1/m, of any of the depressions: 15/8 D/e and 10/sqrt(3) D/e^2. The slope also jumps across a
  // ridge between two depressions, but falls there, so that no ray from above meets the ground
  // sooner.
  double MaxSlope() const { return max_slope_; }
  double MaxCurvature() const { return max_curvature_per_m_; }

 private:
  // A depression with its direction as a unit vector.
  struct Shape {
    double x_m, y_m, along_x, along_y;
    double half_length_m, half_width_m, flank_m, depth_m;
  };

  // A point in the frame of the segment: how far beyond its end, with the sign of the end, and how
  // far across.
  struct Place {
    double beyond_m, across_m;
  };
  static Place PlaceOf(const Shape& shape, double x_m, double y_m);
  static ReliefSample SampleOf(const Shape& shape, double x_m, double y_m);

  std::vector<Shape> shapes_;
  double max_slope_ = 0.0;
  double max_curvature_per_m_ = 0.0;
};

// Fractal roughness of the ground as a smooth height field: a sum of octaves. Octave j has
// wavelength L 2^-j and RMS proportional to 2^(-j H), the scaling of a self-affine surface with
// Hurst exponent H (height differences over a distance r grow as r^H). Each octave is a bicubic
// B-spline whose coefficients are independent normals on a square lattice of half its wavelength:
// twice continuously differentiable, so wheels do not snag. The lattice repeats after 64 nodes,
// i.e. 32 wavelengths of the octave.
//
// The RMS is that of the ensemble: the mean square of a uniform cubic B-spline with unit
// independent coefficients is 151/315 per axis. One realization over an area of few wavelengths
// scatters around it.
class RoughnessField {
 public:
  // The arguments have rms_m > 0, 0 < hurst <= 1, longest_wavelength_m > 0. Octaves go down to 0.1
  // m. The field draws from (key, kGroundRoughness, octave).
  RoughnessField(double rms_m, double hurst, double longest_wavelength_m, core::TrialKey key);

  // Returns height and slopes at a point; it costs about 30 ns per octave.
  ReliefSample Sample(double x_m, double y_m) const;

  // Returns upper bounds of the magnitudes anywhere. Rays step by them: a bound that is too small
  // lets rays through crests, one that is too large costs steps.
  const ReliefBounds& bounds() const { return bounds_; }

  // These give the octaves to ReliefSpline, the longest one first: the spacing of the lattice,
  // half of that of the octave before, and the coefficient, m, of the B-spline that is centred on
  // the node at (column, row) * spacing.
  static constexpr int kNodes = 64;
  int octaves() const { return static_cast<int>(octaves_.size()); }
  double Spacing(int octave) const { return octaves_[static_cast<std::size_t>(octave)].spacing_m; }
  double Coefficient(int octave, std::int64_t column, std::int64_t row) const {
    // The first of the four splines over a cell is centred on the node before it.
    const std::int64_t place = ((row + 1) & (kNodes - 1)) * kNodes + ((column + 1) & (kNodes - 1));
    return octaves_[static_cast<std::size_t>(octave)]
        .coefficients_m[static_cast<std::size_t>(place)];
  }

 private:
  struct Octave {
    double spacing_m = 1.0;
    std::vector<double> coefficients_m;  // kNodes x kNodes, row by row in y
  };

  static void AddOctave(const Octave& octave, double x_m, double y_m, ReliefSample& sum);
  void AddBounds(const Octave& octave);

  std::vector<Octave> octaves_;
  ReliefBounds bounds_;
};

}  // namespace rockyard::terrain
