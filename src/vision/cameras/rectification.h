// Linearization of a stereo pair: two aligned CAHV cameras, whose rows are epipolar lines, and the
// points in space that disparities of the aligned images stand for. The rover's stereo and visual
// odometry, the commands that match images from files, and the designation of goals work on aligned
// pairs.
//
// The aligned cameras keep the centres of the real ones and share A', H' and V'. Rows run along the
// baseline b = C_right - C_left, A' is the mean viewing direction square to it:
//
//   h' = b / |b|    A' = unit(a - (a . h') h'), a = a_left + a_right    v' = A' x h'
//   H' = f h' + c_h A'    V' = f v' + c_v A'
//
// so that a point at depth Z has the same row in both and the disparity
// column_left - column_right = f |b| / Z >= 0. a_left and a_right are the directions of the middles
// of the images. A rover aligns by its calibration: where the true cameras differ from it, rows do
// not meet and ranges are wrong. The calibrated eyes of rockyard's rovers are aligned as they
// stand: records depend on AlignedPair and Triangulate, on Rectify and SourceOf results of commands
// alone.
#pragma once

#include <limits>
#include <optional>

#include "core/result.h"
#include "vision/cameras/camera_model.h"

namespace rockyard::vision {

// What the aligned images show, of points at infinity.
enum class RectifiedField {
  kOverlap,  // what lies in both of the smallest rectangles around what each camera sees
  kLeft,     // the smallest rectangle around what the left one sees
};

struct RectificationOptions {
  RectifiedField field = RectifiedField::kOverlap;
  // 0: the focal length in the middle of the images (the geometric mean of both), or, where `size`
  // is given, the largest with which the field fits into `size`.
  double focal_px = 0.0;
  // 0 x 0: what the field needs. Otherwise the middle of the field is the middle of the image.
  ImageSize size = {};
  // Parts of the field further off A' than this, in the plane of the rows or of the columns, are
  // left out: a fisheye's image would become endless.
  double largest_angle_rad = 1.3;
};

struct RectifiedPair {
  Cahv left;
  Cahv right;
  ImageSize size = {};
  double focal_px = 0.0;
  double baseline_m = 0.0;
};

// Aligns a pair whose cameras are told in one outer frame. Problems have the paths `left`, `right`,
// `baseline`, `field`, `focal_px`, `largest_angle_rad` and `size`: no baseline (below 1e-6 m); a
// baseline within 20 deg of the viewing direction; eyes that are swapped or one above the other
// (more than 45 deg between the baseline and the rows of the images); cameras that look more than
// 90 deg apart, that mirror, or whose middle pixel has no ray; no overlap, or one of less than 2
// pixels; an aligned image with a side of more than 16384 pixels; numbers that are not finite.
// Cost: some 600 rays.
core::Result<RectifiedPair> Rectify(const CameraModel& left, const CameraModel& right,
                                    const RectificationOptions& options = {});

// Returns where in the real image the point lies that an aligned image shows at `pixel`: the entry
// of a rectification table (stereo/rectification_table.h). Returns nothing where the real camera
// does not see the point or where it is on none of its pixels. The point is taken at `range_m` > 0
// from the aligned camera's centre, infinity included. The range only matters for a CAHVORE with a
// moving entrance pupil: points at other ranges r are off by about
// f s sin(theta) |1 / r - 1 / range_m| pixels (s: cahv.h).
std::optional<Pixel> SourceOf(const CameraModel& real, const Cahv& aligned, const Pixel& pixel,
                              double range_m = std::numeric_limits<double>::infinity());

// A point from a disparity of an aligned pair, with the derivatives by which its error follows from
// that of the measurement:
//
//   p = C_left + Z n    n = M^-1 (column, row, 1), M of the rows H, V, A    Z = H . b / disparity
//
// b is the baseline C_right - C_left. With f h' = H - (H . A) A along the baseline Z is
// f |b| / disparity; it grows with the disparity's error as dZ = Z^2 / (f |b|) ddisparity.
struct TriangulatedPoint {
  math::Vector3 p_A = math::Vector3::Zero();  // m, in the cameras' outer frame
  // The derivative of p_A by column and row (of the left image) and disparity, m per pixel.
  Eigen::Matrix3d by_measurement = Eigen::Matrix3d::Zero();

  // Returns the covariance of p_A, m^2, to first order, from that of column, row and disparity.
  Eigen::Matrix3d Covariance(const Eigen::Matrix3d& measurement_px2) const {
    return by_measurement * measurement_px2 * by_measurement.transpose();
  }
};

// Returns the point at a pixel of the left image with its disparity, column_left - column_right.
// Returns nothing where the disparity is not positive (at or beyond infinity) or where a number is
// not finite.
std::optional<TriangulatedPoint> Triangulate(const Cahv& left, const Cahv& right,
                                             const Pixel& left_pixel, double disparity_px);

// Returns the pair as it stands where both cameras are CAHV with the same A, H and V and a baseline
// along the rows, to 1e-9 of their length: its images need no resampling, and pixels may be longer
// than wide. Otherwise returns nothing, and callers use Rectify.
std::optional<RectifiedPair> AlignedPair(const CameraModel& left, const CameraModel& right);

}  // namespace rockyard::vision
