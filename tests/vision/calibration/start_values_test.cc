// Corners of rendered boards, and closed forms of the start of a calibration.
#include "vision/calibration/start_values.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "vision/calibration/find_chessboard.h"
#include "vision/calibration/rendered_target.h"
#include "vision/cameras/test_cameras.h"

namespace rockyard::vision {
namespace {

using math::Transform;
using math::Vector3;

// Corners of rendered boards against where the camera projects them.

class FindChessboardTest : public testing::Test {
 protected:
  static core::RandomStream Stream(std::uint32_t substream) {
    return {{23, 0}, core::Purpose::kTest, substream};
  }
  static std::vector<Pixel> Truth(const math::Transform& X_AT) {
    core::RandomStream stream = Stream(0);
    return MeasuredCorners(TestCahvor(), TestBoard(), X_AT, 0.0, stream);
  }
  static GrayImage Flipped(const GrayImage& image) {
    GrayImage flipped = image;
    std::reverse(flipped.values().begin(), flipped.values().end());
    return flipped;
  }

  const ChessboardParams board_ = TestBoard();
  const TargetRenderer renderer_{{TestCahvor(), kTestSize}};
};

struct Errors {
  double rms_px = 0.0;
  double most_px = 0.0;
  Pixel mean_px = Pixel::Zero();
};

Errors ErrorsOf(const std::vector<Pixel>& found, const std::vector<Pixel>& truth) {
  Errors errors;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Pixel error = found[i] - truth[i];
    errors.rms_px += error.squaredNorm() / static_cast<double>(truth.size());
    errors.mean_px += error / static_cast<double>(truth.size());
    errors.most_px = std::max(errors.most_px, error.norm());
  }
  errors.rms_px = std::sqrt(errors.rms_px);
  return errors;
}

TEST_F(FindChessboardTest, CornersOfEveryPoseAreWhereTheyAreProjected) {
  const std::vector<math::Transform> poses = TestPoses(12);
  Pixel mean_px = Pixel::Zero();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    core::RandomStream stream = Stream(1 + static_cast<std::uint32_t>(i));
    const auto found = FindChessboard(renderer_.Render(board_, poses[i], stream), board_);
    ASSERT_TRUE(found.ok()) << "pose " << i << ": " << found.problems()[0].reason;
    const Errors errors = ErrorsOf(*found, Truth(poses[i]));
    EXPECT_LT(errors.rms_px, 0.06) << "pose " << i;
    EXPECT_LT(errors.most_px, 0.25) << "pose " << i;
    mean_px += errors.mean_px / 12.0;
  }
  // 648 corners of 0.04 px or so: an average of 0.002 px, and no half pixel.
  EXPECT_LT(mean_px.norm(), 0.008);
}

// Closed forms of a calibration's start against the cameras that made the corners.

// What the closed forms assume: square pixels, the axis in the middle, no distortion.
Cahvor PlainCamera() {
  const Cahv linear{{0, 0, 0}, {0, 0, 1}, {260, 0, 159.5}, {0, 260, 119.5}};
  return {linear, linear.A, Vector3::Zero()};
}

CornerImage Corners(const Cahvor& camera, const Transform& X_AT) {
  core::RandomStream stream({234, 0}, core::Purpose::kTest);
  return MeasuredCorners(camera, TestBoard(), X_AT, 0.0, stream);
}

std::vector<Eigen::Matrix3d> Homographies(const std::vector<Transform>& poses) {
  std::vector<Eigen::Matrix3d> homographies;
  for (const Transform& X_AT : poses) {
    homographies.push_back(PlaneHomography(TestBoard(), Corners(PlainCamera(), X_AT)));
  }
  return homographies;
}

TEST(StartValuesTest, AHomographyTakesTheBoardToItsImage) {
  const CornerImage corners = Corners(PlainCamera(), TestPoses(3)[2]);
  const Eigen::Matrix3d homography = PlaneHomography(TestBoard(), corners);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector3 p_T = CornerPosition(TestBoard(), i);
    const Vector3 image = homography * Vector3(p_T.x(), p_T.y(), 1.0);
    EXPECT_LT((image.hnormalized() - corners[i]).norm(), 1e-8);
  }
}

TEST(StartValuesTest, TiltedBoardsTellTheFocalLengthAndTheirPoses) {
  const std::vector<Transform> poses = TestPoses(8);
  const auto homographies = Homographies(poses);
  const Pixel middle = MiddleOf(kTestSize);
  const auto focal_px = FocalLength(homographies, middle);
  ASSERT_TRUE(focal_px.has_value());
  EXPECT_NEAR(*focal_px, 260.0, 1e-6);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Transform found = PoseOfBoard(homographies[i], *focal_px, middle);
    EXPECT_LT((found.matrix() - poses[i].matrix()).norm(), 1e-7) << i;
    EXPECT_NEAR(found.linear().determinant(), 1.0, 1e-12);
    // The sign of a homography is nobody's choice.
    const Transform other = PoseOfBoard(-homographies[i], *focal_px, middle);
    EXPECT_LT((other.matrix() - poses[i].matrix()).norm(), 1e-7) << i;
  }
}

TEST(StartValuesTest, PointsInSpaceTellALinearCamera) {
  const Cahvor camera{TestCahv(TestPose()), Vector3::UnitZ(), Vector3::Zero()};
  std::vector<Vector3> points;
  std::vector<Pixel> pixels;
  for (int i = 0; i < 20; ++i) {
    const Vector3 p_A =
        TestPose() * Vector3(0.1 * (i % 5) - 0.2, 0.07 * (i % 7) - 0.2, 1.0 + 0.1 * (i % 3));
    points.push_back(p_A);
    pixels.push_back(*Project(camera.linear, p_A));
  }
  const Cahv found = LinearCamera(points, pixels);
  EXPECT_LT((found.C - camera.linear.C).norm(), 1e-9);
  EXPECT_LT((found.A - camera.linear.A).norm(), 1e-9);
  EXPECT_LT((found.H - camera.linear.H).norm(), 1e-6);
  EXPECT_LT((found.V - camera.linear.V).norm(), 1e-6);
}

}  // namespace
}  // namespace rockyard::vision
