// Images of a chessboard through a known camera, and points as such a camera would measure them:
// what calibrations are held against. Nothing of src/vision/calibration is used but the board's
// numbers.
#pragma once

#include <vector>

#include "core/random.h"
#include "vision/calibration/chessboard_params.h"
#include "vision/cameras/camera_model.h"
#include "vision/image.h"

namespace rockyard::vision {

struct ImageLook {
  double blur_px = 0.7;  // Gaussian, before the pixels' own box
  double noise = 1.5;    // grey levels, standard deviation
  double dark = 40.0;
  double bright = 200.0;
};

// Casts 4 x 4 rays a pixel through BackProject, blurs and averages them over the pixel.
class TargetRenderer {
 public:
  explicit TargetRenderer(const CameraModel& camera);

  // The board with a white margin of half a square on a grey wall that is its plane; noise from
  // `stream`.
  GrayImage Render(const ChessboardParams& board, const math::Transform& X_AT,
                   core::RandomStream& stream, const ImageLook& look = {}) const;

 private:
  Image<float> Rays(const ChessboardParams& board, const math::Transform& X_AT,
                    const ImageLook& look) const;

  CameraModel camera_;
  Image<math::Vector3> directions_;
};

ChessboardParams TestBoard();  // 6 x 9 corners, 30 mm apart

// A camera of 320 x 240 px and f = 260 px with distortion of some 5 px at the corners, an optical
// axis of its own and rows that are not quite square to columns; told in its own frame: C = 0,
// A = z, H without y.
Cahvor TestCahvor();
inline constexpr ImageSize kTestSize{320, 240};

// The right camera of a pair with TestCahvor on the left: 0.12 m to the right, a little turned.
Cahvor TestRightCahvor();

// Poses of the board in front of both cameras, tilted by up to 40 deg and all over the image. At
// most 12.
std::vector<math::Transform> TestPoses(std::size_t count);

// Where a camera images the corners, with normal errors of `noise_px`.
std::vector<Pixel> MeasuredCorners(const Cahvor& camera, const ChessboardParams& board,
                                   const math::Transform& X_AT, double noise_px,
                                   core::RandomStream& stream);

}  // namespace rockyard::vision
