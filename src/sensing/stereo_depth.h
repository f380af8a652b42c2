// What the left camera of a stereo pair meets, and what of that the right camera does not see. The
// stereo sensor makes its range points of it; the ground truth of stereo studies uses the same
// scene and the same jumps, so that rates counted there fit the error model. Records of drives by
// stereo without images depend on its bits, which are not those of Terrain::CastRay: closed forms
// cost a fraction of its rays.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "math/pose.h"
#include "sensing/stereo_lanes.h"
#include "sensing/stereo_view.h"
#include "terrain/rock.h"
#include "terrain/terrain.h"

namespace rockyard::sensing {

inline constexpr int kNoJump = std::numeric_limits<int>::max() / 2;

// Fills `distance_px` with the number of columns from each pixel of an image row to the nearest
// jump of disparity by jump_px or more between two columns: 1 for the two pixels on its sides,
// kNoJump or more where the row has no jump. A window of half width k around a pixel, 2 k + 1
// columns wide, holds both sides of the jump where the distance is k or less. Both spans have the
// same length. Cost: two passes.
inline void JumpDistances(std::span<const double> row_px, double jump_px,
                          std::span<int> distance_px) {
  const std::size_t size = row_px.size();
  const auto jumps = [&](std::size_t column) {  // between column - 1 and column
    return std::abs(row_px[column] - row_px[column - 1]) >= jump_px;
  };
  int distance = kNoJump;
  for (std::size_t column = 0; column < size; ++column) {
    distance = column > 0 && jumps(column) ? 1 : distance + 1;
    distance_px[column] = distance;
  }
  distance = kNoJump;
  for (std::size_t column = size; column-- > 0;) {
    distance = column + 1 < size && jumps(column + 1) ? 1 : distance + 1;
    if (distance < distance_px[column]) distance_px[column] = distance;
  }
}

// Sets `beside` to whether a jump, as JumpDistances finds it, is `reach` columns away or less. Both
// spans have the same length.
inline void MarkJumps(std::span<const double> row_px, double jump_px, std::int64_t reach,
                      std::span<std::uint8_t> beside) {
  std::fill(beside.begin(), beside.end(), std::uint8_t{0});
  const auto size = static_cast<std::int64_t>(row_px.size());
  for (std::int64_t column = 1; column < size; ++column) {
    const auto at = static_cast<std::size_t>(column);
    if (!(std::abs(row_px[at] - row_px[at - 1]) >= jump_px)) continue;
    const auto first = static_cast<std::size_t>(std::max<std::int64_t>(column - reach, 0));
    const auto end = static_cast<std::size_t>(std::min(column + reach, size));
    for (std::size_t i = first; i < end; ++i) beside[i] = 1;
  }
}

// Returns the first column on the other side of the jump that JumpDistances found `distance_px`
// columns from `column`, with the same jump_px. Of two jumps at the same distance the right one
// counts.
inline std::size_t AcrossJump(std::span<const double> row_px, double jump_px, std::size_t column,
                              int distance_px) {
  const auto distance = static_cast<std::size_t>(distance_px);
  const std::size_t right = column + distance;
  const bool to_the_right =
      right < row_px.size() && std::abs(row_px[right] - row_px[right - 1]) >= jump_px;
  return to_the_right ? right : column - distance;
}

// A span of columns of an image row, as real numbers; empty where first > last.
struct ColumnSpan {
  double first = 1.0;
  double last = 0.0;
};

// The cut of an image row through a rock: quadratics in the column.
struct RowCut : RockRow {
  // The columns within which the row can meet the rock. Where `exact`, all of them meet it.
  ColumnSpan span;
  bool exact = true;

  double Discriminant(double column) const {
    return (quadratic * column + 2.0 * linear) * column + constant;
  }
  double Approach(double column) const { return approach_0 + approach_1 * column; }
  // Returns one over the depth of the rock at a column, 1/m; 0 where the ray misses it.
  double InverseDepth(double column) const;
  // Returns an upper bound of the InverseDepth of the row, 1/m. Requires `exact`.
  double NearestInverseDepth() const;
};

// The outline of a rock in an image. In the coordinates in which the rock is the unit sphere, with
// the eye at q and the pixel's ray e(c, r) = e0 + c e1 + r e2, the ray meets it at depth Z where |q
// + Z e| = 1, so that
//   1/Z = (B + sqrt(B^2 - K |e|^2)) / K,  B = -q . e, K = |q|^2 - 1 (terrain/rock.h).
// The discriminant is a quadratic form of (c, r): the outline is a conic, and where it is an
// ellipse its rows and the columns of each row have closed forms.
class RockOutline {
 public:
  // `eye_W` is one of the two eyes of the view.
  RockOutline(const terrain::RockShape& shape, const math::Vector3& center_W,
              const StereoView& view_W, const math::Vector3& eye_W);

  // Returns whether the eye lies within the rock; then there is no outline.
  bool ContainsEye() const { return outside_1_ <= 0.0; }

  // Rows from first_row() to last_row(), within the image, can meet the rock.
  int first_row() const { return first_row_; }
  int last_row() const { return last_row_; }
  RowCut Row(double row) const;

 private:
  void FindRows(int rows);

  double outside_1_;  // K
  double inverse_outside_1_;
  double b0_, b1_, b2_;  // B = b0 + c b1 + r b2
  double a_;             // factor of c^2 in the discriminant
  double d0_, d1_;       // factors of 2 c and of 2 c r
  double f0_, f1_, f2_;  // factors of 1, 2 r and r^2
  int first_row_ = 0;
  int last_row_ = -1;
};

using PixelFlags = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// The terrain as a stereo pair meets it from one place. With pinhole pixels, one over the depth of
// a plane is linear in column and row, and one over the depth of an ellipsoid is a root of a
// quadratic (RockOutline). So each rock costs its own pixels only. An eye below the ground, in a
// rock or beyond a wall sees nothing. Pointed rocks have no such outline: scenarios refuse them
// where range points are not matched in images.
//
// src/sensing/README.md has the cost at 128 x 128 pixels with both eyes; on rough ground each pixel
// costs a ray march.
class StereoScene {
 public:
  // Surfaces farther than max_range_m along the ray from the left eye are not seen. Terrain and
  // view have to outlive the scene.
  StereoScene(const terrain::Terrain& terrain, const StereoView& view_W, double max_range_m);

  // Returns one over the depth Z of the first surface on each pixel's ray (StereoView::Ray) from
  // the left eye, the same as Terrain::CastRay to rounding.
  DepthImage InverseDepths() const;

  // Sets pixels to 0 that show what lies outside the right image, or there behind something else by
  // kOcclusionMargin_m or more. On rough ground, rays against the ground are cast only for pixels
  // whose place in the right image is not half a column or more to the left of the places of all
  // pixels that follow in the left row.
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
  void HideBehind(const RockOutline& outline_right, double slack_m, DepthImage& image) const;
  double OcclusionSlack_m() const;
  void HideBehindGround(DepthImage& image) const;

  const terrain::Terrain& terrain_;
  const StereoView& view_W_;
  double max_range_m_;
  std::vector<Candidate> rocks_;
  Eigen::ArrayXd columns_;  // 0, 1, 2, ...
  mutable std::vector<int> found_columns_;
};

}  // namespace rockyard::sensing
