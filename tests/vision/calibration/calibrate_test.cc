#include "vision/calibration/calibrate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "math/decompositions.h"
#include "vision/calibration/find_chessboard.h"
#include "vision/calibration/rendered_target.h"

namespace rockyard::vision {
namespace {

using math::Transform;
using math::Vector3;
using testing::HasSubstr;

// How far a calibration lies from the truth, in units of what it says of itself.

// Chi-squared with `rank` degrees of freedom, over the directions in which there is an estimate.
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

// The probability that chi-squared is larger.
double Tail(double squared, double degrees) {
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(degrees), squared));
}

// Calibrations of corners with known errors: within their covariance, free of bias, outliers found.

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

constexpr double kAlpha = 0.001;
constexpr double kNoise_px = 0.05;
constexpr std::uint32_t kTrials = 30;

// Chi-squared sums over trials with noise of their own.
struct Repeated {
  std::vector<Calibration> found;
  Distance all;   // of each trial by its covariance, summed
  Distance mean;  // of the mean error by the mean's covariance
};

Repeated Repeat(const std::vector<Cahvor>& truth, bool surveyed, EstimatedLens lens,
                std::uint32_t first) {
  Repeated repeated;
  Eigen::VectorXd numbers =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(truth.size()) * kCameraNumbers);
  for (std::uint32_t trial = 0; trial < kTrials; ++trial) {
    CalibrationData data = Data(truth, 8, kNoise_px, first + trial);
    if (surveyed) data.surveyed_X_AT = TestPoses(8);
    repeated.found.push_back(Calibrate(data, {.lens = lens}).OrThrow());
    const Distance distance = DistanceOf(repeated.found.back(), truth);
    repeated.all.squared += distance.squared;
    repeated.all.rank += distance.rank;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      numbers.segment<kCameraNumbers>(static_cast<Eigen::Index>(i) * kCameraNumbers) +=
          NumbersOf(repeated.found.back().cameras[i]) / kTrials;
    }
  }
  Calibration mean = repeated.found.front();
  mean.covariance /= kTrials;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    mean.cameras[i] = CameraOfNumbers(
        numbers.segment<kCameraNumbers>(static_cast<Eigen::Index>(i) * kCameraNumbers));
  }
  repeated.mean = DistanceOf(mean, truth);
  return repeated;
}

void ExpectWithinCovariance(const Repeated& repeated, int rank) {
  EXPECT_EQ(repeated.all.rank, rank * static_cast<int>(kTrials));
  EXPECT_GT(Tail(repeated.all.squared, repeated.all.rank), kAlpha / 2);
  EXPECT_LT(Tail(repeated.all.squared, repeated.all.rank), 1.0 - kAlpha / 2);
  // No bias that 30 trials would show.
  EXPECT_GT(Tail(repeated.mean.squared, repeated.mean.rank), kAlpha);
  // The controls: deviations 40 % too small or too large are found.
  EXPECT_LT(Tail(repeated.all.squared / 0.36, repeated.all.rank), kAlpha / 2);
  EXPECT_GT(Tail(repeated.all.squared / 1.96, repeated.all.rank), 1.0 - kAlpha / 2);
}

Cahvor WithoutDistortion(const Cahvor& camera) {
  return {camera.linear, camera.linear.A, Vector3::Zero()};
}

TEST(CalibrateTest, APairLiesWithinItsCovariance) {
  const std::vector<Cahvor> truth{TestCahvor(), TestRightCahvor()};
  const Repeated repeated = Repeat(truth, false, EstimatedLens::kCahvor, 100);
  ExpectWithinCovariance(repeated, 9 + 15);
  // The control of the bias: a focal length 0.1 % longer is no longer the mean.
  std::vector<Cahvor> other = truth;
  other[0].linear.H.x() *= 1.001;
  Calibration mean = repeated.found.front();
  mean.covariance /= kTrials;
  mean.cameras = truth;
  const Distance apart = DistanceOf(mean, other);
  EXPECT_LT(Tail(apart.squared, apart.rank), kAlpha);
}

TEST(CalibrateTest, ACameraInTheFrameOfASurveyLiesWithinItsCovariance) {
  ExpectWithinCovariance(Repeat({TestRightCahvor()}, true, EstimatedLens::kCahvor, 200), 15);
}

TEST(CalibrateTest, ALinearCameraLiesWithinItsCovariance) {
  ExpectWithinCovariance(
      Repeat({WithoutDistortion(TestCahvor())}, false, EstimatedLens::kCahv, 300), 5);
}

// What follows from the covariance, against the scatter of the trials: 30 values tell a standard
// deviation to 13 %, so that a ratio beyond 1.5 either way is a matter of 1e-3.
TEST(CalibrateTest, DeviationsOfWhatFollowsAreThoseOfTheTrials) {
  const std::vector<Cahvor> truth{TestCahvor(), TestRightCahvor()};
  const Repeated repeated = Repeat(truth, false, EstimatedLens::kCahvor, 400);
  const auto expect_ratio = [&](const auto& estimate, double true_value, const char* what) {
    double squares = 0.0, variance = 0.0;
    for (const Calibration& found : repeated.found) {
      const Estimate value = estimate(found);
      squares += std::pow(value.value - true_value, 2);
      variance += value.sd * value.sd;
    }
    EXPECT_GT(squares / variance, 1.0 / 2.25) << what;
    EXPECT_LT(squares / variance, 2.25) << what;
  };
  const auto intrinsics = [](const Calibration& found) {
    return IntrinsicsOf(found.cameras[1], CovarianceOf(found, 1));
  };
  const Cahv& right = truth[1].linear;
  expect_ratio([&](const Calibration& found) { return intrinsics(found).focal_h_px; }, 263.0,
               "f_h");
  expect_ratio([&](const Calibration& found) { return intrinsics(found).focal_v_px; },
               std::hypot(0.5, 261.5), "f_v");
  expect_ratio([&](const Calibration& found) { return intrinsics(found).centre_h_px; }, 157.0,
               "c_h");
  expect_ratio([&](const Calibration& found) { return intrinsics(found).centre_v_px; }, 121.0,
               "c_v");
  expect_ratio([](const Calibration& found) { return BaselineOf(found); }, right.C.norm(),
               "baseline");
  // The predicted error of pixels, here of a point near a corner of the right image.
  const Vector3 p_A(0.40, 0.20, 0.6);
  const Pixel true_pixel = *Project(truth[1], p_A);
  double squares = 0.0, predicted = 0.0;
  for (const Calibration& found : repeated.found) {
    squares += (*Project(found.cameras[1], p_A) - true_pixel).squaredNorm();
    predicted += std::pow(*PredictedError(found.cameras[1], CovarianceOf(found, 1), p_A), 2);
  }
  EXPECT_GT(squares / predicted, 1.0 / 2.25);
  EXPECT_LT(squares / predicted, 2.25);
}

TEST(CalibrateTest, SigmaIsTheNoise) {
  const Repeated repeated = Repeat({TestCahvor()}, false, EstimatedLens::kCahvor, 500);
  double squares = 0.0, degrees = 0.0;
  for (const Calibration& found : repeated.found) {
    // 864 coordinates, 9 of the camera, 48 of poses, two measurements of the prior.
    EXPECT_EQ(found.degrees_of_freedom, 2 * found.corners + 2 - 57);
    squares += found.sigma_px * found.sigma_px * static_cast<double>(found.degrees_of_freedom);
    degrees += static_cast<double>(found.degrees_of_freedom);
    EXPECT_NEAR(found.rms_px * found.rms_px * static_cast<double>(found.corners),
                found.sigma_px * found.sigma_px * static_cast<double>(found.degrees_of_freedom),
                1e-9);
  }
  // Two-sided at kAlpha; a noise 3 % off is found.
  const double statistic = squares / (kNoise_px * kNoise_px);
  EXPECT_GT(Tail(statistic, degrees), kAlpha / 2);
  EXPECT_LT(Tail(statistic, degrees), 1.0 - kAlpha / 2);
  EXPECT_LT(Tail(statistic * 1.06, degrees), kAlpha / 2);
}

TEST(CalibrateTest, OutliersAreNamedAndLeftOut) {
  CalibrationData data = Data({TestCahvor(), TestRightCahvor()}, 8, kNoise_px, 600);
  const std::set<std::tuple<std::size_t, std::size_t, std::size_t>> wrong{
      {0, 2, 7}, {1, 5, 0}, {1, 5, 53}, {0, 0, 30}};
  for (const auto& [camera, image, corner] : wrong) {
    data.corners[camera][image][corner] += Pixel(0.7, -0.5);
  }
  const auto found = Calibrate(data);
  ASSERT_TRUE(found.ok());
  std::set<std::tuple<std::size_t, std::size_t, std::size_t>> named;
  for (const CornerResidual& out : found->outliers) {
    named.insert({out.camera, out.image, out.corner});
    EXPECT_LT((out.residual_px - Pixel(0.7, -0.5)).norm(), 0.3);
  }
  EXPECT_EQ(named, wrong);
  EXPECT_EQ(found->corners, 2 * 8 * 54 - 4);
  EXPECT_NEAR(found->sigma_px, kNoise_px, 0.1 * kNoise_px);
  const Distance distance = DistanceOf(*found, {TestCahvor(), TestRightCahvor()});
  EXPECT_GT(Tail(distance.squared, distance.rank), kAlpha);
}

// Without distortion nothing tells O from A but what is expected of it.
TEST(CalibrateTest, ALensWithoutDistortionKeepsItsAxisNearTheNormal) {
  const auto found = Calibrate(Data({WithoutDistortion(TestCahvor())}, 8, kNoise_px, 700));
  ASSERT_TRUE(found.ok()) << found.problems()[0].reason;
  EXPECT_LT((found->cameras[0].O - found->cameras[0].linear.A).norm(), 4 * 0.02);
  const auto deviation = [&](int i) { return std::sqrt(found->covariance(i, i)); };
  EXPECT_LT(deviation(kBlockO), 0.021);
  EXPECT_GT(deviation(kBlockO), 0.005);
  // A narrower expectation is heeded.
  const auto narrow =
      Calibrate(Data({WithoutDistortion(TestCahvor())}, 8, kNoise_px, 700), {.axis_sd_rad = 0.001});
  EXPECT_LT(std::sqrt(narrow->covariance(kBlockO, kBlockO)), 0.00105);
}

TEST(CalibrateTest, ALinearCameraDoesNotFitADistortedOne) {
  const auto linear =
      Calibrate(Data({TestCahvor()}, 8, kNoise_px, 800), {.lens = EstimatedLens::kCahv});
  ASSERT_TRUE(linear.ok());
  EXPECT_GT(linear->sigma_px, 4 * kNoise_px);
  EXPECT_TRUE(
      std::holds_alternative<Cahv>(ModelOf(*linear, 0, kTestSize, EstimatedLens::kCahv).lens));
  EXPECT_TRUE(
      std::holds_alternative<Cahvor>(ModelOf(*linear, 0, kTestSize, EstimatedLens::kCahvor).lens));
}

// Targets that leave a camera open.
class OpenTargetsTest : public testing::Test {
 protected:
  static std::string Refusal(const std::vector<Transform>& poses, bool surveyed = false) {
    core::RandomStream stream = Stream(900);
    CalibrationData data{TestBoard(), kTestSize, {{}}, {}};
    for (const Transform& X_AT : poses) {
      data.corners[0].push_back(MeasuredCorners(TestCahvor(), data.board, X_AT, kNoise_px, stream));
    }
    if (surveyed) data.surveyed_X_AT = poses;
    const auto found = Calibrate(data);
    return found.ok() ? "" : found.problems()[0].reason;
  }
};

TEST_F(OpenTargetsTest, TooFewImagesAreRefused) {
  EXPECT_THAT(Refusal(TestPoses(2)), HasSubstr("seen in 2 images"));
}

TEST_F(OpenTargetsTest, OneTiltAgainAndAgainIsRefused) {
  EXPECT_THAT(Refusal(std::vector<Transform>(6, TestPoses(2)[1])), HasSubstr("parallel planes"));
}

TEST_F(OpenTargetsTest, BoardsSquareToTheAxisAreRefused) {
  std::vector<Transform> poses(5, TestPoses(1)[0]);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i].translation() += 0.02 * static_cast<double>(i) * Vector3(0.3, -0.2, 1.0);
  }
  EXPECT_THAT(Refusal(poses), HasSubstr("parallel planes"));
}

TEST_F(OpenTargetsTest, SmallTiltsThatLeaveTheFocalLengthOpenAreRefused) {
  std::vector<Transform> poses;
  for (const double tilt_rad : {0.0, 0.12, -0.02, 0.01}) {
    Transform X_AT = TestPoses(1)[0];
    X_AT.translation().z() = 1.2;
    X_AT.linear() = (X_AT.linear() * math::MakePose({0, 0, 0}, 0, tilt_rad, 0).linear()).eval();
    poses.push_back(X_AT);
  }
  EXPECT_THAT(Refusal(poses), HasSubstr("leave the focal length of camera 1 open"));
}

TEST_F(OpenTargetsTest, SurveyedTargetsInOnePlaneAreRefused) {
  std::vector<Transform> poses(2, TestPoses(1)[0]);
  poses[1].translation().x() += 0.02;
  EXPECT_THAT(Refusal(poses, true), HasSubstr("in one plane"));
}

// Parallel surveyed targets at two distances are enough.
TEST_F(OpenTargetsTest, SurveyedTargetsAtTwoDistancesAreNot) {
  std::vector<Transform> poses(2, TestPoses(1)[0]);
  poses[1].translation().z() += 0.15;
  EXPECT_EQ(Refusal(poses, true), "");
}

// From rendered images to a pair of cameras: what is estimated against what rendered them.

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
  constexpr std::uint32_t kPairs = 4;
  Distance all;
  std::vector<CameraVector> sums(truth_.size(), CameraVector::Zero());
  Calibration mean;
  for (std::uint32_t trial = 0; trial < kPairs; ++trial) {
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
  EXPECT_EQ(all.rank, 24 * static_cast<int>(kPairs));
  EXPECT_GT(Tail(all.squared, all.rank), kAlpha / 2);
  EXPECT_LT(Tail(all.squared, all.rank), 1.0 - kAlpha / 2);
  // No bias of the mean that four pairs would show.
  mean.covariance /= kPairs;
  for (std::size_t i = 0; i < truth_.size(); ++i)
    mean.cameras[i] = CameraOfNumbers(sums[i] / kPairs);
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
