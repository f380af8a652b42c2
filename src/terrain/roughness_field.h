// Fractal roughness of the ground as a smooth height field.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/random.h"
#include "terrain/relief.h"

namespace rockyard::terrain {

// The roughness is a sum of octaves. Octave j has wavelength L 2^-j and RMS proportional to 2^(-j
// H), the scaling of a self-affine surface with Hurst exponent H (height differences over a
// distance r grow as r^H). Each octave is a bicubic B-spline whose coefficients are independent
// normals on a square lattice of half its wavelength: twice continuously differentiable, so wheels
// do not snag. The lattice repeats after 64 nodes, i.e. 32 wavelengths of the octave.
//
// The RMS is that of the ensemble: the mean square over a single period of a uniform cubic B-spline
// with unit independent coefficients is 151/315 per axis. One realization over an area of few
// wavelengths scatters around it.
class RoughnessField {
 public:
  // The arguments have rms_m > 0, 0 < hurst <= 1, longest_wavelength_m > 0. Octaves go down to 0.1
  // m. The field draws from (key, kGroundRoughness, octave).
  RoughnessField(double rms_m, double hurst, double longest_wavelength_m, core::TrialKey key);

  // Returns height and slopes at a point; it costs about 30 ns per octave.
  ReliefSample Sample(double x_m, double y_m) const;

  // These are upper bounds of the magnitudes anywhere: of the height, m, of the slope, and of the
  // second derivative in any direction, 1/m.
  double MaxHeight() const { return max_height_m_; }
  double MaxSlope() const { return max_slope_; }
  double MaxCurvature() const { return max_curvature_per_m_; }

  // The octaves, the longest one first, for those who put them together in another way: spacing of
  // the lattice, half of the one before, and the coefficient, m, of the B-spline that is centred on
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
  double max_height_m_ = 0.0;
  double max_slope_ = 0.0;
  double max_curvature_per_m_ = 0.0;
};

}  // namespace rockyard::terrain
