// Corners of rendered boards against where the camera projects them.
#include "vision/calibration/find_chessboard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "vision/calibration/rendered_target.h"

namespace rockyard::vision {
namespace {

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

}  // namespace
}  // namespace rockyard::vision
