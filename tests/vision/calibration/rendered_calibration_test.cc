// From rendered images to a pair of cameras: what is estimated against what rendered them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "math/decompositions.h"
#include "vision/calibration/calibrate.h"
#include "vision/calibration/calibration_distance.h"
#include "vision/calibration/find_chessboard.h"
#include "vision/calibration/rendered_target.h"

namespace rockyard::vision {
namespace {

using math::Vector3;

constexpr std::size_t kImages = 12;

class RenderedCalibrationTest : public testing::Test {
 protected:
  Calibration Calibrated(std::uint32_t trial) const {
    core::RandomStream stream({235, trial}, core::Purpose::kTest);
    CalibrationData data{TestBoard(), kTestSize, {}, {}};
    for (const TargetRenderer* renderer : {&left_, &right_}) {
      std::vector<CornerImage> images;
      for (const math::Transform& X_AT : TestPoses(kImages)) {
        const GrayImage image = renderer->Render(data.board, X_AT, stream);
        images.push_back(FindChessboard(image, data.board).OrThrow());
      }
      data.corners.push_back(std::move(images));
    }
    return Calibrate(data).OrThrow();
  }

  const std::vector<Cahvor> truth_{TestCahvor(), TestRightCahvor()};
  const TargetRenderer left_{{TestCahvor(), kTestSize}};
  const TargetRenderer right_{{TestRightCahvor(), kTestSize}};
};

// Pixels all over the parts of both images that targets covered, as points at two ranges, and where
// the estimated cameras image them. What is left is told after the rigid motion of both cameras
// together that fits best: the frame is the first camera's own, and where in it the rays lie is the
// principal point's error again.
struct PixelErrors {
  double rms_px = 0.0;
  double most_px = 0.0;
};

PixelErrors PixelErrorsOf(const std::vector<Cahvor>& found, const std::vector<Cahvor>& truth) {
  std::vector<Pixel> errors;
  std::vector<Eigen::Matrix<double, 2, 6>> by_motion;
  for (std::size_t camera = 0; camera < truth.size(); ++camera) {
    for (int i = 0; i < 49; ++i) {
      const double first = camera == 0 ? 80.0 : 20.0;
      const Pixel at(first + 30.0 * (i % 7), 30.0 + 30.0 * (i / 7));
      const auto ray = BackProject(truth[camera], at);
      const Vector3 p_A = ray->origin + (i % 2 == 0 ? 0.4 : 0.8) * ray->direction;
      PixelJacobian by_point;
      errors.emplace_back(*Project(found[camera], p_A, &by_point) - at);
      Eigen::Matrix3d cross;
      cross << 0, -p_A.z(), p_A.y(), p_A.z(), 0, -p_A.x(), -p_A.y(), p_A.x(), 0;
      by_motion.emplace_back();
      by_motion.back() << -by_point * cross, by_point;
    }
  }
  math::Matrix6 normal = math::Matrix6::Zero();
  math::Vector6 right = math::Vector6::Zero();
  for (std::size_t i = 0; i < errors.size(); ++i) {
    normal += by_motion[i].transpose() * by_motion[i];
    right -= by_motion[i].transpose() * errors[i];
  }
  const math::Vector6 motion = math::SolveSymmetric(normal, right);
  PixelErrors result;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double left_px = (errors[i] + by_motion[i] * motion).norm();
    result.rms_px += left_px * left_px / static_cast<double>(errors.size());
    result.most_px = std::max(result.most_px, left_px);
  }
  result.rms_px = std::sqrt(result.rms_px);
  return result;
}

// Two-sided at kAlpha, over four pairs of 24 numbers each.
TEST_F(RenderedCalibrationTest, PairsAreWithinTheirCovarianceAndProjectTruly) {
  constexpr double kAlpha = 0.001;
  constexpr std::uint32_t kTrials = 4;
  Distance all;
  std::vector<CameraVector> sums(truth_.size(), CameraVector::Zero());
  Calibration mean;
  for (std::uint32_t trial = 0; trial < kTrials; ++trial) {
    const Calibration found = Calibrated(trial);
    const Distance distance = DistanceOf(found, truth_);
    all.squared += distance.squared;
    all.rank += distance.rank;
    const PixelErrors errors = PixelErrorsOf(found.cameras, truth_);
    EXPECT_LT(errors.rms_px, 0.02);
    EXPECT_LT(errors.most_px, 0.05);
    EXPECT_LT(found.outliers.size(), 0.02 * static_cast<double>(found.corners));
    for (std::size_t i = 0; i < truth_.size(); ++i) sums[i] += NumbersOf(found.cameras[i]);
    mean = found;
  }
  EXPECT_EQ(all.rank, 24 * static_cast<int>(kTrials));
  EXPECT_GT(Tail(all.squared, all.rank), kAlpha / 2);
  EXPECT_LT(Tail(all.squared, all.rank), 1.0 - kAlpha / 2);
  // No bias of the mean that four pairs would show.
  mean.covariance /= kTrials;
  for (std::size_t i = 0; i < truth_.size(); ++i)
    mean.cameras[i] = CameraOfNumbers(sums[i] / kTrials);
  const Distance bias = DistanceOf(mean, truth_);
  EXPECT_GT(Tail(bias.squared, bias.rank), kAlpha);

  // The controls: deviations 40 % too small or too large, and a focal length 0.1 % too long.
  EXPECT_LT(Tail(all.squared / 0.36, all.rank), kAlpha / 2);
  EXPECT_GT(Tail(all.squared / 1.96, all.rank), 1.0 - kAlpha / 2);
  std::vector<Cahvor> longer = truth_;
  longer[1].linear.H += 0.26 * (longer[1].linear.H - 157.0 * longer[1].linear.A).normalized();
  EXPECT_GT(PixelErrorsOf(longer, truth_).rms_px, 0.02);
  const Distance control = DistanceOf(mean, longer);
  EXPECT_LT(Tail(control.squared, control.rank), kAlpha);
}

}  // namespace
}  // namespace rockyard::vision
