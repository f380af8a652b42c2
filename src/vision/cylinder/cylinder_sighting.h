// What a pair of colour images tells about the coloured cylinder, or why it tells nothing: input
// and result of both finders (published_finder.h, robust_finder.h).
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/check.h"
#include "core/fields.h"
#include "math/pose.h"
#include "vision/cameras/camera_model.h"
#include "vision/cylinder/colour_cylinder.h"
#include "vision/image.h"

namespace rockyard::vision {

// Both images of a pair, of the size of their cameras, which are told in one outer frame L. The
// images must outlive the pair.
struct ColourPair {
  const ColourImage& left;
  const ColourImage& right;
  CameraModel left_camera;
  CameraModel right_camera;
};

enum class RegionRole { kWhole, kLeft, kMiddle, kRight };

// Pixels that hang together, with their bounding box. All ends are inclusive.
struct ColourRegion {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;
  int pixels = 0;
  Pixel centroid = Pixel::Zero();        // the mean of its pixels
  std::optional<CylinderColour> colour;  // nothing for a mixture of classes
  RegionRole role = RegionRole::kWhole;

  int Width() const { return right - left + 1; }
  int Height() const { return bottom - top + 1; }
};

struct CylinderSighting {
  // theta: azimuth of the middle between the cameras in the cylinder's frame, in [-pi, pi].
  double orientation_rad = 0.0;
  // The centre of the cylinder in frame L, m.
  math::Vector3 p_LT_L = math::Vector3::Zero();
  // Depths of the centre before the left camera along its optical axis, by the disparity and by the
  // width. The published finder takes them from equations 17, 15 and 16, the robust one from its
  // fit.
  double distance_by_stereo_m = 0.0;
  double distance_by_size_m = 0.0;
  // Of p_LT_L (m) and the orientation (rad), in this order.
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  // Of the left and the right image: the whole first, then the left, middle and right quadrants as
  // far as they are seen.
  std::array<std::vector<ColourRegion>, 2> regions;
};

// Why the cylinder was not found. Must stay, names (below) and order: records of the experiment
// that counts misses have a column for each.
enum class CylinderMiss {
  kNone,           // it was found
  kNothing,        // no region is large enough
  kClipped,        // a region ends at the border of the image or of the area of interest
  kTooFewRegions,  // too few quadrants are seen to tell which they are
  kUnlikeOrder,    // no cylinder has these colours side by side
  kUnlikeEyes,     // left and right image show different things
  kSwappedEyes,    // the disparity is not positive
  kTwoCylinders,   // more than one place looks like a cylinder
  kNotACylinder,   // size, outline or colours are not those of the cylinder
  kAmbiguous,      // two orientations explain the images as well
};

struct CylinderFinding {
  std::optional<CylinderSighting> sighting;
  CylinderMiss miss = CylinderMiss::kNone;
  std::string reason;  // in words, with the numbers; empty where it was found
};

// Returns a finding without a sighting.
inline CylinderFinding NotFound(CylinderMiss miss, std::string reason) {
  EXPECT(miss != CylinderMiss::kNone && !reason.empty());
  return {std::nullopt, miss, std::move(reason)};
}

}  // namespace rockyard::vision

template <>
struct rockyard::core::EnumNames<rockyard::vision::CylinderMiss> {
  static constexpr std::array<std::string_view, 10> kNames{
      "none",        "nothing",      "clipped",       "too_few_regions", "unlike_order",
      "unlike_eyes", "swapped_eyes", "two_cylinders", "not_a_cylinder",  "ambiguous"};
};

template <>
struct rockyard::core::EnumNames<rockyard::vision::RegionRole> {
  static constexpr std::array<std::string_view, 4> kNames{"whole", "left", "middle", "right"};
};
