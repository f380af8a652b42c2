// What a stereo pair could show of the terrain at best, pixel by pixel. Studies of stereo sort
// errors and dropouts by it. No drive asks it: only records of that study depend on it.
#pragma once

#include <Eigen/Core>

#include "math/pose.h"
#include "messages/point_cloud.h"
#include "rendering/sun_params.h"
#include "rover/rover_geometry_params.h"
#include "sensing/stereo_depth.h"
#include "sensing/stereo_params.h"
#include "sensing/stereo_view.h"
#include "sensing/sun_shade.h"
#include "terrain/terrain.h"

namespace rockyard::sensing {

using PixelNumbers = Eigen::Array<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// The truth of one look: a value for each pixel of the left image, [row][column], of the size
// sensors.stereo.rows x columns.
struct StereoTruth {
  DepthImage left_px;  // disparity of what the left eye sees within max_range_m; 0: nothing
  DepthImage both_px;  // left_px where the right eye sees that surface, too, else 0
  PixelNumbers jumps;  // columns to the nearest jump in depth, see JumpDistances
  PixelFlags behind;   // the pixel is on the farther side of that jump
  PixelNumbers rocks;  // index of the rock that the left eye sees there; -1: none
  PixelFlags shaded;   // the surface there turns away from the sun, or something is between
  PixelFlags margin;  // of both_px: what a matching window there holds, and one pixel more, reaches
                      // over the edge of either image, or over the rover's own parts
};

// The truth by rays, without images, so that it holds for every fidelity of the sensor. Rocks have
// to be ellipsoids (StereoScene). The rates of the error model (StereoMatcher) are fitted to what
// studies count by this truth: jumps, margins and shade must mean the same in both.
class StereoGroundTruth {
 public:
  // `window_side_px` is the side of the windows that are matched.
  StereoGroundTruth(const StereoParams& params, const rendering::SunParams& sun,
                    const rover::RoverGeometryParams& rover, int window_side_px);

  // Returns the truth of a look with the rover at X_WR. Pure function. Cost: two rays a pixel, 30
  // ms for 128 x 128 on flat ground.
  StereoTruth See(const terrain::Terrain& terrain, const math::Transform& X_WR,
                  messages::LookDirection direction) const;

  // The left eye's view, in R.
  const StereoView& view_R(messages::LookDirection direction) const {
    return direction == messages::LookDirection::kAhead ? ahead_.view_R : behind_.view_R;
  }

 private:
  struct Pair {
    StereoView view_R;
    // Pixels whose window holds no part of the rover and does not reach over an edge of the image.
    PixelFlags left_free;
    PixelFlags right_free;
  };

  Pair MakePair(const StereoParams& params, messages::LookDirection direction, int reach_px) const;
  PixelFlags FreeWindows(const StereoView& view_R, const math::Vector3& eye_R, int reach_px) const;
  void FindJumps(const DepthImage& all_px, int row, StereoTruth& truth) const;
  void SeeSurfaces(const terrain::Terrain& terrain, const math::Transform& X_WR,
                   const StereoView& view_W, StereoTruth& truth) const;

  double max_range_m_;
  double edge_disparity_px_;
  SunShade shade_;
  Pair ahead_;
  Pair behind_;
};

}  // namespace rockyard::sensing
