// Signed distance of a wheel from a rock: the wheel that part_shapes.h describes (a disc grown to a
// rounded cylinder) against the ellipsoid, exactly and without sampling.
#pragma once

#include <Eigen/Core>

#include "math/pose.h"
#include "rover/rover_geometry_params.h"
#include "terrain/rock.h"

namespace rockyard::rover {

// A wheel: a disc of core radius, as wide as twice the core's half width along the axle, and all
// points within the margin of it.
struct WheelShape {
  double core_radius_m;
  double core_half_width_m;
  double margin_m;

  explicit WheelShape(const RoverGeometryParams& params);
};

// A rock by its support function D(n) = sqrt(n' S n) about its centre.
struct RockSupport {
  math::Vector3 center_W;
  Eigen::Matrix3d S_m2;
  double bounding_radius_m;
  double top_W_m;

  explicit RockSupport(const terrain::Rock& rock);
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
// circle or sphere starts from `n_W`, the normal of a pose nearby or GuessNormal for a new pair,
// and ends within some micrometres. Penetration may reach about the margin.
//
// Every unit n bounds the gap from below. If that says that the gap exceeds reach_m, FindGap
// returns that bound at once with an unfinished normal. It costs 20 ns for such a bound, 0.1 us
// otherwise.
WheelRockGap FindGap(const WheelShape& wheel, const math::Vector3& center_W,
                     const math::Vector3& axle_W, const RockSupport& rock, double reach_m,
                     const math::Vector3& n_W);

// Returns a first normal: from the rock's centre to the wheel's, scaled by the rock's axes.
math::Vector3 GuessNormal(const math::Vector3& center_W, const RockSupport& rock);

}  // namespace rockyard::rover
