// Calibrations of corners with known errors: within their covariance, free of bias, outliers found.
#include "vision/calibration/calibrate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <set>

#include "core/distributions.h"
#include "vision/calibration/rendered_target.h"

namespace rockyard::vision {
namespace {

using math::Transform;
using math::Vector3;
using testing::HasSubstr;

core::RandomStream Stream(std::uint32_t substream) {
  return {{231, 0}, core::Purpose::kTest, substream};
}

// Corners of the first `images` test poses by the given cameras.
CalibrationData Data(const std::vector<Cahvor>& cameras, std::size_t images, double noise_px,
                     std::uint32_t substream) {
  core::RandomStream stream = Stream(substream);
  CalibrationData data{TestBoard(), kTestSize, {}, {}};
  for (const Cahvor& camera : cameras) {
    std::vector<CornerImage> corners;
    for (const Transform& X_AT : TestPoses(images)) {
      corners.push_back(MeasuredCorners(camera, data.board, X_AT, noise_px, stream));
    }
    data.corners.push_back(std::move(corners));
  }
  return data;
}

// How far an estimate lies from the truth in units of its covariance, over the directions in which
// it was estimated: chi-squared with `rank` degrees of freedom.
struct Distance {
  double squared = 0.0;
  int rank = 0;
};

Distance DistanceOf(const Calibration& found, const std::vector<Cahvor>& truth) {
  Eigen::VectorXd error(found.covariance.rows());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    error.segment<kCameraNumbers>(static_cast<Eigen::Index>(i) * kCameraNumbers) =
        NumbersOf(found.cameras[i]) - NumbersOf(truth[i]);
  }
  // To numbers of like size.
  const Eigen::VectorXd scale =
      found.covariance.diagonal().cwiseMax(1e-30).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * found.covariance * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled);
  const Eigen::VectorXd along = solver.eigenvectors().transpose() * scale.asDiagonal() * error;
  Distance distance;
  for (Eigen::Index i = 0; i < along.size(); ++i) {
    if (solver.eigenvalues()[i] < 1e-11) continue;
    distance.squared += along[i] * along[i] / solver.eigenvalues()[i];
    ++distance.rank;
  }
  return distance;
}

double Tail(double squared, double degrees) {
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(degrees), squared));
}

TEST(CalibrateTest, CornersWithoutErrorsGiveTheCameras) {
  const std::vector<Cahvor> truth{TestCahvor(), TestRightCahvor()};
  const auto found = Calibrate(Data(truth, 8, 0.0, 1));
  ASSERT_TRUE(found.ok()) << found.problems()[0].reason;
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT((NumbersOf(found->cameras[i]) - NumbersOf(truth[i])).cwiseAbs().maxCoeff(), 1e-3)
        << i;
  }
  EXPECT_LT(found->rms_px, 1e-5);
  EXPECT_TRUE(found->outliers.empty());
}

TEST(CalibrateTest, EstimatesLieWithinTheirCovariance) {
  const std::vector<Cahvor> truth{TestCahvor(), TestRightCahvor()};
  double sum = 0.0;
  double degrees = 0.0;
  for (std::uint32_t trial = 0; trial < 20; ++trial) {
    const auto found = Calibrate(Data(truth, 8, 0.05, 100 + trial));
    ASSERT_TRUE(found.ok()) << found.problems()[0].reason;
    const Distance distance = DistanceOf(*found, truth);
    std::printf("%f %d rms %f sigma %f\n", distance.squared, distance.rank, found->rms_px,
                found->sigma_px);
    sum += distance.squared;
    degrees += distance.rank;
  }
  std::printf("%f %f %f\n", sum, degrees, Tail(sum, degrees));
}

}  // namespace
}  // namespace rockyard::vision
