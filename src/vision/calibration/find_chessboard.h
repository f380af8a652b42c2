// A chessboard in an image: which pixel shows which of its corners.
#pragma once

#include <vector>

#include "core/result.h"
#include "vision/calibration/chessboard_params.h"
#include "vision/cameras/camera_types.h"
#include "vision/image.h"

namespace rockyard::vision {

// Where each corner is, in the order of CornerPosition, to about 0.02 px in an image with noise of
// 1 % of the contrast. The problem, with path "image", where the board is not seen whole: then it
// says how much of it is there. Limits: squares of 12 px and more, seen from the front, and every
// inner corner 5 px or more inside of the image; a second board of the same size is not told apart.
// Cost: about 15 ms a megapixel for smoothing and candidates, and n^2 log n for n candidates.
core::Result<std::vector<Pixel>> FindChessboard(const GrayImage& image,
                                                const ChessboardParams& board);

}  // namespace rockyard::vision
