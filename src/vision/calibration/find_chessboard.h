// A chessboard in an image: where each of its corners is. `rockyard calibrate` searches each image
// by it. No record depends on it; its order of corners is that of all of calibration.
#pragma once

#include <vector>

#include "core/result.h"
#include "vision/calibration/chessboard_params.h"
#include "vision/cameras/camera_types.h"
#include "vision/image.h"

namespace rockyard::vision {

// Returns where each corner is, in the order of CornerPosition, to about 0.02 px in an image with
// noise of 1 % of the contrast. Where the board is not seen whole there is a problem with path
// "image" that says how many corners were found. Limits: squares of 12 px and more, seen from the
// front, and every inner corner 5 px or more inside of the image; a second board of the same size
// is not told apart. Cost: about 15 ms a megapixel for smoothing and candidates, and n^2 log n for
// n candidates.
core::Result<std::vector<Pixel>> FindChessboard(const GrayImage& image,
                                                const ChessboardParams& board);

}  // namespace rockyard::vision
