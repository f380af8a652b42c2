// Batches of planes, by every kernel that this processor can run, against single planes.
#include "math/plane_batch.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/random.h"
#include "math/plane_fit.h"

namespace rockyard::math {
namespace {

std::int64_t Whole(core::RandomStream& stream, double extent) {
  return static_cast<std::int64_t>(core::SampleUniform(stream, -extent, extent));
}

// Points of any number and shape, near and far: boxes as thick as wide, slabs in any plane,
// needles, points in a line and in one place.
PointMoments AnySet(core::RandomStream& stream) {
  std::vector<double> extents_um;
  for (int axis = 0; axis < 3; ++axis) {
    const double digits = core::SampleUniform(stream, -1.0, 6.5);
    extents_um.push_back(stream.Uniform() < 0.2 ? 0.0 : std::pow(10.0, digits));
  }
  const double distance_um = stream.Uniform() < 0.3 ? 5e10 : 5e6;
  const std::int64_t x = Whole(stream, distance_um);
  const std::int64_t y = Whole(stream, distance_um);
  const std::int64_t z = Whole(stream, 1e6);
  const std::int64_t tilt = Whole(stream, 3.0);
  const int points = 1 + static_cast<int>(60.0 * stream.Uniform() * stream.Uniform());
  PointMoments moments;
  for (int i = 0; i < points; ++i) {
    const std::int64_t dx = Whole(stream, extents_um[0]);
    const std::int64_t dy = Whole(stream, extents_um[1]);
    const std::int64_t dz = Whole(stream, extents_um[2]);
    moments.AddPoint(x + dx, y + dy + tilt * dx, z + dz - tilt * dy);
  }
  return moments;
}

void ExpectSameBits(double a, double b, const char* what) {
  EXPECT_EQ(std::bit_cast<std::uint64_t>(a), std::bit_cast<std::uint64_t>(b))
      << what << ": " << a << " and " << b;
}

// Plane i of the batch, less its normal.
void ExpectPlane(const PlaneBatch& batch, std::size_t i, const PlaneFit& expected) {
  ExpectSameBits(batch.Residual_m(i), expected.residual_m, "residual");
  ExpectSameBits(batch.EigenRatio(i), expected.eigen_ratio, "eigen ratio");
}

void ExpectNormal(const PlaneBatch& batch, std::size_t i, const PlaneFit& expected) {
  for (int axis = 0; axis < 3; ++axis) {
    ExpectSameBits(batch.Normal(i)(axis), expected.normal(axis), "normal");
  }
}

TEST(PlaneBatchTest, PairsRunEverywhereAndTheWidestIsUsed) {
  ASSERT_FALSE(PlaneKernels().empty());
  EXPECT_EQ(PlaneKernels().front().name, "pairs");
  EXPECT_EQ(BestPlaneKernel().fit, PlaneKernels().back().fit);
}

TEST(PlaneBatchTest, EveryKernelGivesTheBitsOfSinglePlanes) {
  for (const PlaneKernel& kernel : PlaneKernels()) {
    SCOPED_TRACE(kernel.name);
    core::RandomStream stream({31, 0}, core::Purpose::kTest, 1);
    PlaneBatch batch;
    for (int round = 0; round < 600; ++round) {
      std::vector<PlaneFit> expected;
      while (!batch.full()) {
        const PointMoments moments = AnySet(stream);
        batch.Add(moments);
        expected.push_back(FitPlane(Spread(moments).covariance_m2));
      }
      batch.Fit(PlaneParts::kWithNormals, kernel);
      for (std::size_t i = 0; i < batch.size(); ++i) {
        ExpectPlane(batch, i, expected[i]);
        ExpectNormal(batch, i, expected[i]);
      }
      batch.Fit(PlaneParts::kWithoutNormals, kernel);
      for (std::size_t i = 0; i < batch.size(); ++i) ExpectPlane(batch, i, expected[i]);
      batch.Clear();
      ASSERT_FALSE(HasFailure()) << "round " << round;
    }
  }
}

TEST(PlaneBatchTest, BatchesNeedNotBeFull) {
  for (const PlaneKernel& kernel : PlaneKernels()) {
    SCOPED_TRACE(kernel.name);
    core::RandomStream stream({32, 0}, core::Purpose::kTest, 1);
    for (std::size_t size = 0; size <= PlaneBatch::kSize; ++size) {
      PlaneBatch batch;
      std::vector<PlaneFit> expected;
      for (std::size_t i = 0; i < size; ++i) {
        const PointMoments moments = AnySet(stream);
        batch.Add(moments);
        expected.push_back(FitPlane(Spread(moments).covariance_m2));
      }
      EXPECT_EQ(batch.size(), size);
      batch.Fit(PlaneParts::kWithNormals, kernel);
      for (std::size_t i = 0; i < size; ++i) {
        ExpectPlane(batch, i, expected[i]);
        ExpectNormal(batch, i, expected[i]);
      }
    }
  }
}

}  // namespace
}  // namespace rockyard::math
