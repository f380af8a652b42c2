#include "sensing/stereo_ground_truth.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "sensing/stereo_depth.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;
using messages::LookDirection;

// The view with both eyes, whatever the fidelity in use: the ideal one has a single eye.
StereoView PairView(StereoParams params, LookDirection direction) {
  params.fidelity = StereoFidelity::kErrorModel;
  return MakeStereoView(params, direction);
}

// Returns where every pixel within `reach` rows and columns is in the image and true.
PixelFlags Eroded(const PixelFlags& flags, int reach) {
  const auto rows = static_cast<int>(flags.rows());
  const auto columns = static_cast<int>(flags.cols());
  PixelFlags eroded = PixelFlags::Constant(rows, columns, false);
  const int side = 2 * reach + 1;
  for (int row = reach; row < rows - reach; ++row) {
    for (int column = reach; column < columns - reach; ++column) {
      eroded(row, column) = flags.block(row - reach, column - reach, side, side).all();
    }
  }
  return eroded;
}

}  // namespace

StereoGroundTruth::StereoGroundTruth(const StereoParams& params, const rendering::SunParams& sun,
                                     const rover::RoverGeometryParams& rover, int window_side_px)
    : max_range_m_(params.max_range_m),
      edge_disparity_px_(params.edge_disparity_px),
      shade_(sun, rover),
      ahead_(MakePair(params, LookDirection::kAhead, window_side_px / 2 + 1)),
      behind_(MakePair(params, LookDirection::kBehind, window_side_px / 2 + 1)) {}

StereoGroundTruth::Pair StereoGroundTruth::MakePair(const StereoParams& params,
                                                    LookDirection direction, int reach_px) const {
  const StereoView view_R = PairView(params, direction);
  return {view_R, FreeWindows(view_R, view_R.eye, reach_px),
          FreeWindows(view_R, view_R.right_eye, reach_px)};
}

PixelFlags StereoGroundTruth::FreeWindows(const StereoView& view_R, const Vector3& eye_R,
                                          int reach_px) const {
  PixelFlags free(view_R.rows, view_R.columns);
  for (int row = 0; row < view_R.rows; ++row) {
    for (int column = 0; column < view_R.columns; ++column) {
      const Vector3 ray_R = view_R.Ray(column, row).normalized();
      free(row, column) = !std::isfinite(shade_.body().Distance(eye_R, ray_R));
    }
  }
  return Eroded(free, reach_px);
}

StereoTruth StereoGroundTruth::See(const terrain::Terrain& terrain, const math::Transform& X_WR,
                                   LookDirection direction) const {
  const Pair& pair = direction == LookDirection::kAhead ? ahead_ : behind_;
  const StereoView view_W = pair.view_R.From(X_WR);
  const double scale_px_m = view_W.focal_px * view_W.baseline_m;
  const StereoScene scene(terrain, view_W, max_range_m_);
  StereoTruth truth;
  truth.left_px = scene.InverseDepths();
  truth.both_px = truth.left_px;
  scene.HideFromRightEye(truth.both_px);
  // Goldberg 2002 section 2: d = f b / Z.
  truth.left_px *= scale_px_m;
  truth.both_px *= scale_px_m;

  // Jumps lie between surfaces: a surface so far away that its disparity is less than a jump counts
  // as sky. |e| of a pixel is below 4 for fields of view up to 150 by 90 deg; in the corners of
  // larger images surfaces may count as sky a little too early.
  constexpr double kLongestRay = 4.0;
  const double far_m = std::max(max_range_m_, kLongestRay * scale_px_m / edge_disparity_px_);
  const DepthImage all_px = scale_px_m * StereoScene(terrain, view_W, far_m).InverseDepths();
  truth.jumps.resize(view_W.rows, view_W.columns);
  truth.behind = PixelFlags::Constant(view_W.rows, view_W.columns, false);
  truth.margin = PixelFlags::Constant(view_W.rows, view_W.columns, true);
  for (int row = 0; row < view_W.rows; ++row) {
    FindJumps(all_px, row, truth);
    for (int column = 0; column < view_W.columns; ++column) {
      const double disparity_px = truth.both_px(row, column);
      if (disparity_px <= 0.0) continue;
      const auto right = std::max(static_cast<int>(std::lround(column - disparity_px)), 0);
      truth.margin(row, column) = !pair.left_free(row, column) || !pair.right_free(row, right);
    }
  }
  SeeSurfaces(terrain, X_WR, view_W, truth);
  return truth;
}

void StereoGroundTruth::FindJumps(const DepthImage& all_px, int row, StereoTruth& truth) const {
  const auto columns = static_cast<std::size_t>(all_px.cols());
  const std::span<const double> row_px(&all_px(row, 0), columns);
  JumpDistances(row_px, edge_disparity_px_, {&truth.jumps(row, 0), columns});
  for (std::size_t column = 0; column < columns; ++column) {
    const auto at = static_cast<Eigen::Index>(column);
    if (truth.jumps(row, at) >= kNoJump) continue;
    const std::size_t across = AcrossJump(row_px, edge_disparity_px_, column, truth.jumps(row, at));
    truth.behind(row, at) = row_px[across] > row_px[column];
  }
}

void StereoGroundTruth::SeeSurfaces(const terrain::Terrain& terrain, const math::Transform& X_WR,
                                    const StereoView& view_W, StereoTruth& truth) const {
  truth.rocks = PixelNumbers::Constant(view_W.rows, view_W.columns, -1);
  truth.shaded = PixelFlags::Constant(view_W.rows, view_W.columns, false);
  for (int row = 0; row < view_W.rows; ++row) {
    for (int column = 0; column < view_W.columns; ++column) {
      if (truth.left_px(row, column) <= 0.0) continue;
      const Vector3 ray_W = view_W.Ray(column, row).normalized();
      const auto hit = terrain.CastRay(view_W.eye, ray_W, max_range_m_);
      if (!hit) continue;
      truth.rocks(row, column) = hit->rock;
      truth.shaded(row, column) = shade_.IsShaded(terrain, X_WR, *hit);
    }
  }
}

}  // namespace rockyard::sensing
