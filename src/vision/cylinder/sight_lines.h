// Where both eyes see one point, of aligned cameras and of any others.
#pragma once

#include <optional>

#include "vision/cameras/camera_model.h"
#include "vision/cameras/rectification.h"
#include "vision/cylinder/cylinder_sighting.h"

namespace rockyard::vision {

// What the finders ask of a pair of cameras.
struct EyeGeometry {
  double focal_px = 0.0;    // of the left camera in the middle of its image, along the rows
  double baseline_m = 0.0;  // between the centres
  math::Vector3 centre_L = math::Vector3::Zero();  // of the left camera, m
  math::Vector3 middle_L = math::Vector3::Zero();  // between both centres, m
  // Of length 1: its optical axis, and the directions of its rows to the right and of its columns
  // upwards, in the middle of its image.
  math::Vector3 forward_L = math::Vector3::Zero();
  math::Vector3 right_L = math::Vector3::Zero();
  math::Vector3 up_L = math::Vector3::Zero();
  std::optional<RectifiedPair> aligned;  // where rows are epipolar lines as they are
};

// Nothing where the left camera images nothing in its middle.
std::optional<EyeGeometry> GeometryOf(const ColourPair& pair);

struct SeenPoint {
  math::Vector3 p_L = math::Vector3::Zero();  // m
  double depth_m = 0.0;                       // along the left camera's axis
};

// The point that both pixels show. Of aligned cameras by the disparity alone (equation 17 of
// Matthies 1995, whatever the rows), else the middle of the shortest line between both lines of
// sight. Nothing where the eyes look apart: disparity not positive, or nearest behind a camera.
std::optional<SeenPoint> PointSeenAt(const ColourPair& pair, const EyeGeometry& eyes,
                                     const Pixel& left_px, const Pixel& right_px);

}  // namespace rockyard::vision
