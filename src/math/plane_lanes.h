// Planes from moments, as many at a time as a Number has lanes: what the kernels of plane_batch
// share. Like lanes.h it must not include Eigen or containers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "math/lanes.h"
#include "math/plane_kernel.h"
#include "math/spread_lanes.h"
#include "math/symmetric_eigen_lanes.h"

namespace rockyard::math {

template <typename Number>
struct PlaneLanes {
  Number residual_m, eigen_ratio;
  LaneVector<Number> normal;  // unit, z >= 0
};

// Returns the planes of covariances, with the members of PlaneFit (plane_fit.h).
template <EigenParts kParts, typename Number>
PlaneLanes<Number> PlanesOf(const SymmetricMatrix<Number>& covariance_m2) {
  const SymmetricEigenLanes<Number> eigen = EigenOf<kParts>(covariance_m2);
  // Rounding leaves up to this much, of either sign, of an eigenvalue of zero. Must be the floor of
  // PlaneFrom in plane_fit.h.
  constexpr double kFloor = 4.0 * std::numeric_limits<double>::epsilon();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Number floor = kFloor * eigen.largest;
  const auto thick = eigen.smallest > floor;
  const Number one = All<Number>(1.0);
  const Number infinite = All<Number>(kInfinity);
  const Number thickness = Select(thick, eigen.smallest, one);
  const LaneVector<Number>& axis = eigen.smallest_axis;
  const auto down = axis.z < All<Number>(0.0);
  const auto upward = [&](const Number& along) { return Select<Number>(down, -along, along); };
  return {
      Select(thick, Sqrt(thickness), All<Number>(0.0)),
      Select<Number>(thick, eigen.middle / thickness, Select(eigen.middle > floor, infinite, one)),
      {upward(axis.x), upward(axis.y), upward(axis.z)}};
}

template <typename Number>
void Save(Number numbers, std::size_t row, std::size_t first, double* rows) {
  std::memcpy(rows + row * kPlaneBatch + first, &numbers, sizeof(Number));
}

template <EigenParts kParts, typename Number>
void FitRows(const std::uint64_t* moments, std::size_t size, double* planes) {
  constexpr std::size_t kLanes = sizeof(Number) / sizeof(double);
  for (std::size_t i = 0; i < size; i += kLanes) {
    const auto sum_of = [&](MomentRow row) {
      return Load<typename Whole<Number>::Unsigned>(moments + row * kPlaneBatch + i);
    };
    const PlaneLanes<Number> fits = PlanesOf<kParts>(CovarianceOf<Number>(sum_of));
    Save(fits.residual_m, kResidualRow, i, planes);
    Save(fits.eigen_ratio, kEigenRatioRow, i, planes);
    if (kParts == EigenParts::kValues) continue;
    Save(fits.normal.x, kNormalXRow, i, planes);
    Save(fits.normal.y, kNormalYRow, i, planes);
    Save(fits.normal.z, kNormalZRow, i, planes);
  }
}

// The FitPlaneRows of the kernel with this Number.
template <typename Number>
void FitPlanesBy(const std::uint64_t* moments, std::size_t size, PlaneParts parts, double* planes) {
  if (parts == PlaneParts::kWithNormals) {
    FitRows<EigenParts::kValuesAndAxis, Number>(moments, size, planes);
  } else {
    FitRows<EigenParts::kValues, Number>(moments, size, planes);
  }
}

}  // namespace rockyard::math
