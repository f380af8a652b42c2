// Batches of planes, by every kernel that this processor can run, against single planes.

#include "math/plane_batch.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <bit>
#include <vector>

#include "core/random.h"
#include "math/plane_fit.h"
#include "math/symmetric_eigen.h"

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

// The closed form against Eigen's iterative solver and against matrices with known eigenvalues.

Eigen::Matrix3d Full(const SymmetricMatrix3& m) {
  Eigen::Matrix3d full;
  full << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz;
  return full;
}

SymmetricMatrix3 FromFull(const Eigen::Matrix3d& m) {
  return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)};
}

double Largest(const SymmetricMatrix3& m) { return Full(m).cwiseAbs().maxCoeff(); }

// Bounds in units of the largest element: eigenvalues, and what is left of (A - lambda I) v.
void ExpectAgrees(const SymmetricMatrix3& m) {
  constexpr double kTolerance = 4e-15;
  const double scale = Largest(m);
  const Eigen::Matrix3d full = Full(m);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> reference(full / scale);
  const SymmetricEigen3 eigen = EigenOf(m);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(eigen.values[static_cast<std::size_t>(i)] / scale, reference.eigenvalues()(i),
                kTolerance)
        << "eigenvalue " << i << " of\n"
        << full;
  }
  EXPECT_NEAR(eigen.smallest_axis.norm(), 1.0, 1e-14);
  const Vector3 left =
      (full / scale) * eigen.smallest_axis - (eigen.values[0] / scale) * eigen.smallest_axis;
  EXPECT_LT(left.norm(), 2.0 * kTolerance) << full;
}

Eigen::Matrix3d RandomRotation(core::RandomStream& stream) {
  Eigen::Quaterniond q(core::SampleNormal(stream, 0.0, 1.0), core::SampleNormal(stream, 0.0, 1.0),
                       core::SampleNormal(stream, 0.0, 1.0), core::SampleNormal(stream, 0.0, 1.0));
  return q.normalized().toRotationMatrix();
}

TEST(SymmetricEigenTest, AgreesWithEigenOnRandomMatrices) {
  core::RandomStream stream({11, 0}, core::Purpose::kTest, 1);
  for (int i = 0; i < 20000; ++i) {
    const double scale = std::pow(10.0, core::SampleUniform(stream, -12.0, 12.0));
    SymmetricMatrix3 m;
    for (double* element : {&m.xx, &m.yy, &m.zz, &m.xy, &m.xz, &m.yz}) {
      *element = scale * core::SampleUniform(stream, -1.0, 1.0);
    }
    ExpectAgrees(m);
  }
}

// Eigenvalues that are equal, nearly equal, zero, far apart: in any orientation.
TEST(SymmetricEigenTest, AgreesWithEigenOnNastySpectra) {
  const std::vector<std::array<double, 3>> spectra = {
      {1, 1, 1},         {0, 0, 1},         {0, 1, 1},        {-1, 0, 1},
      {1, 1, 1 + 1e-15}, {1, 1, 1 + 1e-12}, {1, 1, 1 + 1e-8}, {1, 1 + 1e-8, 2},
      {0, 1e-12, 1},     {0, 1e-15, 1},     {1e-16, 1, 1e8},  {1e-20, 1e-10, 1},
      {1, 2, 2 + 1e-13}, {-2, 1, 1},        {-1, -1, 2},      {1, 1e-3, 1e-3},
      {1, 1, 1e-9},      {3, 2, 1},         {-5, -5, -5},     {1, 1 - 1e-10, 1 + 1e-10}};
  core::RandomStream stream({12, 0}, core::Purpose::kTest, 1);
  for (const auto& values : spectra) {
    const Eigen::Vector3d diagonal(values[0], values[1], values[2]);
    ExpectAgrees(FromFull(diagonal.asDiagonal()));
    for (int i = 0; i < 300; ++i) {
      const Eigen::Matrix3d R = RandomRotation(stream);
      const Eigen::Matrix3d m = R * diagonal.asDiagonal() * R.transpose();
      ExpectAgrees(FromFull(0.5 * (m + m.transpose())));
    }
  }
}

TEST(SymmetricEigenTest, ExtremeScales) {
  for (const double scale : {1e-290, 1e-150, 1e150, 1e290}) {
    const SymmetricEigen3 eigen =
        EigenOf(SymmetricMatrix3{2 * scale, 2 * scale, 5 * scale, scale, 0, 0});
    EXPECT_NEAR(eigen.values[0] / scale, 1.0, 1e-15);
    EXPECT_NEAR(eigen.values[1] / scale, 3.0, 4e-15);
    EXPECT_NEAR(eigen.values[2] / scale, 5.0, 4e-15);
    EXPECT_NEAR(std::abs(eigen.smallest_axis.dot(Vector3(1, -1, 0).normalized())), 1.0, 1e-15);
  }
}

TEST(SymmetricEigenTest, ZeroMatrixHasZeros) {
  const SymmetricEigen3 eigen = EigenOf(SymmetricMatrix3{});
  EXPECT_EQ(eigen.values, (std::array<double, 3>{0, 0, 0}));
  EXPECT_EQ(eigen.smallest_axis, Vector3::UnitZ());
}

TEST(SymmetricEigenTest, SwappingAxesKeepsTheBits) {
  core::RandomStream stream({13, 0}, core::Purpose::kTest, 1);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Matrix3d half =
        Eigen::Matrix3d::NullaryExpr([&] { return core::SampleUniform(stream, -1.0, 1.0); });
    const SymmetricMatrix3 m = FromFull(half * half.transpose());
    const SymmetricEigen3 a = EigenOf(m);
    // A quarter turn about z: x to y, y to -x.
    const SymmetricEigen3 b = EigenOf(SymmetricMatrix3{m.yy, m.xx, m.zz, -m.xy, -m.yz, m.xz});
    EXPECT_EQ(a.values, b.values);
    EXPECT_EQ(std::abs(a.smallest_axis.x()), std::abs(b.smallest_axis.y()));
    EXPECT_EQ(std::abs(a.smallest_axis.z()), std::abs(b.smallest_axis.z()));
  }
}

TEST(SymmetricEigenTest, CosineOfAThirdToTheLastBits) {
  for (int i = 0; i <= 10000; ++i) {
    const double t = i / 10000.0;
    EXPECT_NEAR(internal::CosOfThird(All<Pair>(t))[0], std::cos(std::acos(t) / 3.0), 5e-16) << t;
  }
}

}  // namespace
}  // namespace rockyard::math
