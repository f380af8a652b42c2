// A few matches of textured points, searched over rows as well as columns, from which
// FindRowAlignment (row_alignment.h) learns how the rows of a pair lie. No record depends on it.
//
// The points are, in each cell of a grid over the left image, the pixel with the most texture,
//   T = min(sum |I(x + 1, y) - I(x, y)|, sum |I(x, y + 1) - I(x, y)|)
// over its window of the difference of Gaussians I, so that an edge, which fixes one coordinate
// only, counts little. A point is searched in the right image by the sum S of absolute differences
// over the window. The best place is a match where
//   - its S is below max_ratio times that of every place more than 3 pixels from it (in either
//     direction),
//   - it is not at the end of the places searched,
//   - the search back from it in the same way finds the point again within a pixel.
// The row's fraction is the lowest point of two lines of opposite slope through S of the rows
// above, at and below (SubPixel).
#pragma once

#include <optional>
#include <vector>

#include "vision/image.h"

namespace rockyard::vision {

struct RowMatchOptions {
  int grid_columns = 24;  // cells, at least 1 a side
  int grid_rows = 18;
  int window_side_px = 15;  // odd, at least 3
  int max_rows_px = 12;     // rows searched above and below, at least 1
  // The range of columns searched, as disparities: column of the left image less that of the right
  // one. Without a value -width / 8 and width / 4 hold.
  std::optional<int> min_disparity_px = std::nullopt;
  std::optional<int> max_disparity_px = std::nullopt;
  double max_ratio = 0.8;  // of S at the match to S at every other place, in (0, 1]
};

// A point at a pixel of the left image, and where it is in the right one.
struct RowMatch {
  int left_column = 0;
  int right_column = 0;
  int left_row = 0;
  double right_row = 0.0;
};

// Returns the matches by rows of the grid, none where windows do not fit into the images. Requires
// images of one size. Brightness may differ, contrast by little. Cost for a point: up to columns
// times rows searched, times two, times the window; most places are left after a part of their
// window.
std::vector<RowMatch> FindRowMatches(const GrayImage& left, const GrayImage& right,
                                     const RowMatchOptions& options);

}  // namespace rockyard::vision
