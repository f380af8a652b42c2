/// @file
/// A camera of the light stripe sensor: where it sits, what its lens does, how large its image is.
/// Rendering and on-board finders of stripes both count the pixels of an image by it.
#pragma once

#include "math/pose.h"

namespace rockyard::messages {

/// The first and the last column of a part of an image row, counted as in Camera.
struct ColumnRange {
  int first = 0;
  int last = -1;

  /// Returns whether it has no column.
  bool empty() const { return last < first; }
  /// Returns whether a place in an image row lies in the range, ends included.
  bool Contains(double column_px) const { return column_px >= first && column_px <= last; }
};

/// Returns all columns of an image. An even number has one more to the left of the axis than to the
/// right.
inline ColumnRange ImageColumns(int columns) { return {-columns / 2, columns - columns / 2 - 1}; }

/// How a lens maps directions to image positions; the equations stand in vision/lens.h.
enum class Lens {
  kEquidistantRows,  ///< rows are planes through the lateral axis; angles grow with pixels
  kEquidistant,      ///< f-theta, radially symmetric
  kPinhole,          ///< rectilinear
};

/// The parameters of every camera model in vision/lens.h.
struct Camera {
  Lens lens = Lens::kEquidistantRows;
  math::Transform X_RC = math::Transform::Identity();  ///< x along the optical axis, y left, z up
  /// Angle per pixel, on the axis; columns count to the camera's right, rows downwards.
  double column_pitch_rad = 0.0;
  double row_pitch_rad = 0.0;
  /// Size of the image, pixels.
  int columns = 0;
  int rows = 0;

  /// Return the columns and rows of the image, counted from the pixel on the optical axis.
  ColumnRange image_columns() const { return ImageColumns(columns); }
  int first_row() const { return -rows / 2; }  ///< an even number has one more above the axis
  int last_row() const { return rows - rows / 2 - 1; }
};

}  // namespace rockyard::messages
