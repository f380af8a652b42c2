// Band-limited noise over a plane, filtered to what a pixel sees of it: the textures of soil and
// rocks in pictures of the terrain. Records of drives by pictures depend on its bits; numbers are
// drawn by node, so that neither the order of queries nor Trim changes one.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "core/random.h"
#include "rendering/picture/picture_params.h"

namespace rockyard::rendering {

// The parallelogram around a point that a pixel covers in a plane: its sides, m.
struct Footprint {
  Eigen::Vector2d column_m = Eigen::Vector2d::Zero();  // from one column to the next
  Eigen::Vector2d row_m = Eigen::Vector2d::Zero();

  // The rectangle with the same second moments. A parallelogram of sides c and r has the moments
  // (c c^T + r r^T) / 12, a rectangle along unit axes e, f with lengths l, w has
  // (l^2 e e^T + w^2 f f^T) / 12.
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
    // The axis is one of the two rows of M - small I: the one that is larger.
    Eigen::Vector2d axis =
        half >= 0.0 ? Eigen::Vector2d(half + root, b) : Eigen::Vector2d(b, root - half);
    const double norm = axis.norm();
    axis = norm > 0.0 ? Eigen::Vector2d(axis / norm) : Eigen::Vector2d::UnitX();
    const double length = std::sqrt(large);
    return {axis, length, length > 0.0 ? std::abs(area) / length : 0.0};
  }
};

// A texture and its gradient at a place, per metre along u and v.
struct TextureSample {
  double value = 0.0;
  double slope_u = 0.0;
  double slope_v = 0.0;
};

// A sum of octaves of wavelet noise (Cook and DeRose 2005, "Wavelet noise"), zero on average and of
// unit variance. Octave j lies on a lattice of spacing s_j = longest_wavelength / 3 * 2^-j and is
//   sum over nodes of B(u/s - i) B(v/s - k) (N - U D N)_ik,
// B the cubic B-spline, N independent normal numbers by node, D a low-pass that keeps every other
// node and U the refinement of B-splines, [1 4 6 4 1]/8 along each axis, which tells the same
// surface on the finer lattice. What is left lies between the wavelengths 2 s and 6 s or so, so
// that an octave averages out over a larger pixel. D is [-1 -1 5 10 5 -1 -1]/16 along each axis: U
// D keeps constants and cubics, so that the power of an octave falls as f^8 towards long
// wavelengths; Cook and DeRose project exactly, with 32 coefficients.
//
// As U is exact, the octaves 0 to j are together one B-spline on lattice j, C_j = U C_(j-1) + a_j
// (N - U D N): a sample costs one spline, whatever the number of octaves. Nodes are worked out in
// pages, where a place is first asked for, and kept.
//
// Numbers come from (key, purpose, octave) by node, see PixelNoise; lattices repeat after 2^16 rows
// of nodes and 2^19 columns. An object serves one thread at a time, as pages are filled in. Objects
// of the same key give the same bits.
class TextureField {
 public:
  static constexpr int kMostTaps = 8;

  TextureField(const TextureParams& texture, core::TrialKey key, core::Purpose purpose,
               int most_taps = kMostTaps);

  // Returns the mean of the texture over a pixel's footprint around (u, v), and the mean of its
  // gradient. A footprint is sampled up to most_taps times along its longer axis. At each sample
  // octaves fade by the shorter axis w: they are there in full for s >= 0.85 w and gone for s <=
  // 0.42 w, linearly in an approximation of log2(s) between. Cost: 15 to 100 ns, and some ns for
  // each new node.
  TextureSample Mean(double u_m, double v_m, const Footprint& footprint);

  // Returns the standard deviation of the gradient of the unfiltered texture along an axis, 1/m.
  double SlopeDeviation() const;

  // Forgets its pages where they take more than about 64 MB.
  void Trim();

  int octaves() const { return static_cast<int>(amplitudes_.size()); }
  double spacing_m(int octave) const { return spacings_m_[static_cast<std::size_t>(octave)]; }

 private:
  static constexpr int kPage = 64;           // nodes along a page's side
  static constexpr int kStored = kPage + 4;  // with those that its splines reach beyond, and one

  struct Page {
    // Node (column, row) of the page lies at (row + 1) * kStored + column + 1: of all coarser
    // octaves, refined, and of the page's own.
    using Nodes = std::array<float, std::size_t{kStored} * kStored>;
    Nodes coarser;
    Nodes octave;
  };
  // A page by octave, column and row, in one number.
  struct Place {
    int octave;
    std::int64_t column, row;
    std::uint64_t Key() const {
      // Columns and rows of 2^28 pages reach far beyond where lattices repeat.
      constexpr std::uint64_t kMask = (1ULL << 28) - 1;
      return (static_cast<std::uint64_t>(octave) << 56) |
             ((static_cast<std::uint64_t>(column) & kMask) << 28) |
             (static_cast<std::uint64_t>(row) & kMask);
    }
  };
  struct Latest {
    std::uint64_t key = 0;
    const Page* page = nullptr;
  };
  // How a footprint is sampled: C_(octave - 1) + share a_octave (N - U D N), at `taps` places.
  struct Level {
    int octave;
    double share;
    int taps;
  };

  const Page& PageAt(const Place& place) {
    const Latest& latest = latest_[static_cast<std::size_t>(place.octave)];
    return latest.page != nullptr && latest.key == place.Key() ? *latest.page : FindPage(place);
  }
  const Page& FindPage(const Place& place);
  const Page& MakePage(const Place& place);
  static void AddParent(const Page& parent, const Place& place, Page& page);
  TextureSample Taps(const Level& level, double u_m, double v_m, const Footprint::Ellipse& ellipse);

  core::TrialKey key_;
  core::Purpose purpose_;
  int most_taps_;
  std::vector<double> spacings_m_;
  std::vector<double> amplitudes_;  // of N, by octave
  // The page that was last asked for, of each octave.
  std::vector<Latest> latest_;
  std::unordered_map<std::uint64_t, std::unique_ptr<Page>> pages_;
};

}  // namespace rockyard::rendering
