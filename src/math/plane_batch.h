// Planes of many sets of points at a time, in the widest registers that the processor has: the
// planes of GESTALT's maps.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "math/plane_kernel.h"
#include "math/point_moments.h"
#include "math/pose.h"

namespace rockyard::math {

// Up to kSize sets of points and their planes. Whatever registers they go through, each plane must
// be FitPlane of the Spread of its set to the last bit.
class PlaneBatch {
 public:
  static constexpr std::size_t kSize = kPlaneBatch;

  PlaneBatch();

  std::size_t size() const { return size_; }
  bool full() const { return size_ == kSize; }
  void Clear() { size_ = 0; }

  // Takes the moments of a set, in which there must be a point; the batch must not be full.
  void Add(const PointMoments& moments) {
    for (std::size_t row = 0; row < kMomentRows; ++row) {
      moments_[row * kSize + size_] = moments.sums[row];
    }
    ++size_;
  }

  // Fits the planes of all sets. kWithoutNormals takes less time where the largest eigenvalue
  // stands apart from the other two, and leaves the normals as they were.
  void Fit(PlaneParts parts) { Fit(parts, BestPlaneKernel()); }
  // Does so by a given kernel, for tests that compare kernels.
  void Fit(PlaneParts parts, const PlaneKernel& kernel);

  // Return what PlaneFit tells of plane i, in the order in which sets were added.
  double Residual_m(std::size_t i) const { return planes_[kResidualRow * kSize + i]; }
  double EigenRatio(std::size_t i) const { return planes_[kEigenRatioRow * kSize + i]; }
  Vector3 Normal(std::size_t i) const {
    return {planes_[kNormalXRow * kSize + i], planes_[kNormalYRow * kSize + i],
            planes_[kNormalZRow * kSize + i]};
  }

 private:
  std::size_t size_ = 0;
  alignas(64) std::array<std::uint64_t, kMomentRows * kSize> moments_{};
  alignas(64) std::array<double, kPlaneRows * kSize> planes_{};
};

}  // namespace rockyard::math
