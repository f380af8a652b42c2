// Signed distance of a wheel from a rock, exactly and without sampling; the contacts of the
// quasi-static rover are found by it. Records of that rover depend on the normal from which each
// search starts, as it ends within micrometres.
#pragma once

#include <Eigen/Core>
#include <array>

#include "math/pose.h"
#include "rover/rover_geometry_params.h"
#include "terrain/rock.h"

namespace rockyard::rover {

// A wheel: all points within the margin of a core, which is a disc of core_radius_m, as wide as
// twice core_half_width_m along the axle. Must be the wheel of MakeParts (part_shapes.cc), with
// which the multibody meets rocks.
struct WheelShape {
  double core_radius_m;
  double core_half_width_m;
  double margin_m;

  explicit WheelShape(const RoverGeometryParams& params);
};

// A rock by its support function D(n) = n . o + sign sqrt(n' S n) about its centre, for unit n.
//
// An ellipsoid has one piece: S = diag(a^2, b^2, c^2) in its own frame, sign 1, o = 0. A cap has
// two pieces, which meet at the normals of the edge of its base, h n_z = (1 - A/2) sqrt(m) with m =
// (a n_x)^2 + (b n_y)^2. Above, S is that of the quadric, (A/2B)^2 diag(-B a^2, -B b^2, h^2) about
// the quadric's centre, A h / 2B over the top, with the sign of -B (B = 1 - A); below, it is that
// of the rim of the base, diag(a^2, b^2, 0). D is once differentiable where they meet.
class RockSupport {
 public:
  // One piece of D.
  struct Piece {
    Eigen::Matrix3d S_m2;
    double sign = 1.0;
    double above_center_m = 0.0;  // o, along z
    bool is_rim = false;
  };

  explicit RockSupport(const terrain::Rock& rock);

  const math::Vector3& center_W() const { return center_W_; }
  double bounding_radius_m() const { return bounding_radius_m_; }
  double top_W_m() const { return top_W_m_; }
  bool IsCap() const { return growth_ > 0.0; }

  const Piece& PieceAt(const math::Vector3& n_W) const {
    return IsCap() && FromBorder_m(n_W) < 0.0 ? pieces_[1] : pieces_[0];
  }
  // Returns how far n, of any length, lies on the quadric's side of the border between a cap's
  // pieces: h n_z - (1 - A/2) sqrt(m), a concave function.
  double FromBorder_m(const math::Vector3& n_W) const;
  // Returns D(n), the farthest that the rock reaches from its centre along n, m.
  double Along(const math::Vector3& n_W) const;

  // Returns a normal from which FindGap may start: from the rock towards center_W, bent by the
  // rock's axes.
  math::Vector3 GuessNormal(const math::Vector3& center_W) const;

 private:
  math::Vector3 center_W_;
  double bounding_radius_m_;
  double top_W_m_;
  double growth_;    // A of a cap, 0 for an ellipsoid
  double height_m_;  // of a cap
  std::array<Piece, 2> pieces_;
};

// What FindGap returns, in W.
struct WheelRockGap {
  double gap_m = 0.0;                          // negative: penetration
  math::Vector3 n_W = math::Vector3::UnitZ();  // from the rock to the wheel
  math::Vector3 p_W = math::Vector3::Zero();   // on the wheel
};

// Returns the gap as the largest separation over unit normals,
//   f(n) = n . (c - o) - D(n) - r sqrt(1 - t^2) - w |t| - m,   t = n . axle,
// for core radius r, half width w, margin m (the difference of both support functions). Where the
// rim lies flat on the rock, t = 0 and n has one angle; elsewhere n has two. Newton's method on the
// circle or sphere starts from `n_W`, the normal found at a pose nearby or GuessNormal for a new
// pair, and ends within some micrometres. Penetration may reach about the margin. A cap's flank has
// nearly one normal, across which D bends hundreds of times as much as beside it: steps from the
// rim's piece end at the border, and those that go too far are halved.
//
// Every f(n) is a lower bound of the gap. If f(n_W) exceeds reach_m, FindGap returns it at once,
// with n_W as the normal, which costs 20 ns; else a call costs 0.1 us.
WheelRockGap FindGap(const WheelShape& wheel, const math::Vector3& center_W,
                     const math::Vector3& axle_W, const RockSupport& rock, double reach_m,
                     const math::Vector3& n_W);

}  // namespace rockyard::rover
