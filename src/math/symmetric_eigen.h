// Closed-form eigenvalues of one symmetric 3 x 3 matrix, for plane_fit.h. decompositions.h has
// Eigen's solver, whose bits depend on Eigen.
#pragma once

#include <array>

#include "math/lanes.h"
#include "math/pose.h"
#include "math/symmetric_eigen_lanes.h"

namespace rockyard::math {

using SymmetricMatrix3 = SymmetricMatrix<double>;

struct SymmetricEigen3 {
  std::array<double, 3> values{};            // ascending
  Vector3 smallest_axis = Vector3::UnitZ();  // unit eigenvector of values[0], of either sign
};

// Returns what EigenOf of symmetric_eigen_lanes.h does, for one matrix.
inline SymmetricEigen3 EigenOf(const SymmetricMatrix3& m) {
  const SymmetricEigenLanes<Pair> eigen =
      EigenOf(SymmetricMatrix<Pair>{All<Pair>(m.xx), All<Pair>(m.yy), All<Pair>(m.zz),
                                    All<Pair>(m.xy), All<Pair>(m.xz), All<Pair>(m.yz)});
  const LaneVector<Pair>& axis = eigen.smallest_axis;
  return {{eigen.smallest[0], eigen.middle[0], eigen.largest[0]},
          Vector3(axis.x[0], axis.y[0], axis.z[0])};
}

}  // namespace rockyard::math
