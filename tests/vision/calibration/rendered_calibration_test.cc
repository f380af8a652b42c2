// From rendered images to a pair of cameras: what is estimated against what rendered them.
#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "vision/calibration/calibrate.h"
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

TEST_F(RenderedCalibrationTest, PrintsFirst) {
  for (std::uint32_t trial = 0; trial < 3; ++trial) {
    const Calibration found = Calibrated(trial);
    std::printf("rms %.4f sigma %.4f outliers %zu\n", found.rms_px, found.sigma_px,
                found.outliers.size());
    for (std::size_t camera = 0; camera < 2; ++camera) {
      double squares = 0.0;
      double most = 0.0;
      double predicted = 0.0;
      for (int row = 0; row < 9; ++row) {
        for (int column = 0; column < 9; ++column) {
          const Pixel at(column * 39.875, row * 29.875);
          const auto ray = BackProject(truth_[camera], at);
          const Vector3 p_A = ray->origin + 0.5 * ray->direction;
          const double error = (*Project(found.cameras[camera], p_A) - at).norm();
          squares += error * error / 81;
          most = std::max(most, error);
          predicted +=
              std::pow(*PredictedError(found.cameras[camera], CovarianceOf(found, camera), p_A),
                       2) /
              81;
        }
      }
      std::printf("camera %zu rms %.4f most %.4f predicted %.4f\n", camera, std::sqrt(squares),
                  most, std::sqrt(predicted));
    }
  }
}

}  // namespace
}  // namespace rockyard::vision
