// What the left camera of a stereo pair meets, and what of it the right one does not see.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "sensing/stereo_outline.h"
#include "sensing/stereo_view.h"
#include "terrain/terrain.h"

namespace rockyard::sensing {

// A value for each pixel, [row][column]: one over a depth, 1/m, or a disparity, px; 0 where the
// pixel shows nothing.
using DepthImage = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using PixelFlags = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// The terrain as a stereo pair meets it from one place. Pinhole pixels make one over the depth of
// every plane linear in column and row, and that of an ellipsoid a root of a quadratic
// (RockOutline), so that each rock costs its own pixels only. An eye below the ground, in a rock or
// beyond a wall sees nothing.
//
// src/sensing/README.md has the cost at 128 x 128 pixels with both eyes; on rough ground each pixel
// costs a ray march.
class StereoScene {
 public:
  // Surfaces farther than max_range_m from the left eye are not seen. The view is one in W; both
  // have to outlive the scene.
  StereoScene(const terrain::Terrain& terrain, const StereoView& view_W, double max_range_m);

  // Returns one over the depth Z of the first surface on each pixel's ray (StereoView::Ray) from
  // the left eye, the same as Terrain::CastRay to rounding.
  DepthImage InverseDepths() const;

  // Sets to 0 what lies outside the right image or behind something else there, by 0.5 mm or more.
  // On rough ground what the ground hides is looked for only where disparity changes by half a
  // column or more from one to the next.
  void HideFromRightEye(DepthImage& inverse_depths) const;

 private:
  // A rock near enough to be seen.
  struct Candidate {
    terrain::RockShape shape;
    math::Vector3 center_W;
  };

  bool SeesNothing(const math::Vector3& eye_W) const;
  void AddPlanes(DepthImage& image) const;
  void AddRock(const RockOutline& outline, DepthImage& image) const;
  void AddRoughGround(DepthImage& image) const;
  void DropFarther(DepthImage& image) const;
  void HideBehind(const RockOutline& outline_right, DepthImage& image) const;
  void HideBehindGround(DepthImage& image) const;

  const terrain::Terrain& terrain_;
  const StereoView& view_W_;
  double max_range_m_;
  std::vector<Candidate> rocks_;
  Eigen::ArrayXd columns_;  // 0, 1, 2, ...
};

}  // namespace rockyard::sensing
