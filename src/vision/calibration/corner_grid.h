// From loose corners to the grid of a chessboard.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "vision/cameras/camera_types.h"
#include "vision/image.h"

namespace rockyard::vision {

// Corners that belong together, by their places in a grid of unknown origin and orientation. The
// first coordinate grows towards the second one's right hand as it does in images: turning from the
// direction of the first to that of the second is turning from columns to rows.
using CornerGrid = std::map<std::pair<int, int>, Pixel>;

// The grids among `corners`, largest first. Two corners are neighbours where the line between them
// is an edge from end to end: brightness differs across it, with the same sign at five places.
// Longer lines of a board change their sign halfway, diagonals have none. From a corner with two
// edges the grid grows along edges, directions handed on from corner to corner, so that perspective
// and distortion may turn them slowly. `smooth` is the image smoothed by 1.5 px or so.
std::vector<CornerGrid> FindGrids(const Image<float>& smooth, const std::vector<Pixel>& corners);

}  // namespace rockyard::vision
