// What `rockyard calibrate` does: images of a chessboard to a camera, or to the two of a pair
// (Goldberg 2002 section 2, Gennery 2001).
#pragma once

#include "campaign/calibrate/calibrate_request.h"

namespace rockyard::campaign {

// Reads, finds the board, estimates and writes into the folder, which is made: camera.json and
// camera.txt (cameras.json and cameras.txt of a pair), calibration.json. Throws core::UserError,
// before anything is written, for whatever is wrong with the input: everything that can be told at
// once, such as all images without a board.
CalibrateResult CalibrateCameras(const CalibrateRequest& request);

}  // namespace rockyard::campaign
