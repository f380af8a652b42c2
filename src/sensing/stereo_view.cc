#include "sensing/stereo_view.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "math/functions.h"
#include "sensing/stereo_lanes.h"

namespace rockyard::sensing {

using math::Vector3;

StereoView StereoView::From(const math::Transform& X_WR) const {
  StereoView view = *this;
  view.eye = X_WR * eye;
  view.right_eye = X_WR * right_eye;
  view.first = X_WR.linear() * first;
  view.along_row = X_WR.linear() * along_row;
  view.along_column = X_WR.linear() * along_column;
  return view;
}

StereoView MakeStereoView(const StereoParams& params, messages::LookDirection direction) {
  const bool ahead = direction == messages::LookDirection::kAhead;
  const StereoMountParams& mount = ahead ? params.front : params.rear;
  const double sign = ahead ? 1.0 : -1.0;
  const auto [sine, cosine] = math::SinCos(mount.pitch_rad);
  // The directions of optical axis, image right (R's -y when looking ahead) and image down, in R.
  // The pair that looks behind is turned by 180 degrees about z.
  const Vector3 axis(sign * cosine, 0.0, -sine);
  const Vector3 right(0.0, -sign, 0.0);
  const Vector3 down(-sign * sine, 0.0, -cosine);
  StereoView view;
  view.columns = static_cast<int>(params.columns);
  view.rows = static_cast<int>(params.rows);
  view.focal_px = params.focal_columns_px();
  // The ideal sensor has both eyes in the middle.
  view.baseline_m = params.fidelity == StereoFidelity::kIdeal ? 0.0 : params.baseline_m;
  const Vector3 middle(sign * mount.ahead_m, 0.0, mount.height_m);
  view.eye = middle - 0.5 * view.baseline_m * right;
  view.right_eye = middle + 0.5 * view.baseline_m * right;
  view.along_row = right / params.focal_columns_px();
  view.along_column = down / params.focal_rows_px();
  // e(c, r) = axis + (c - (columns - 1)/2) right / f + (r - (rows - 1)/2) down / f: the principal
  // point is the middle of the image, and e . axis = 1.
  view.first =
      axis - 0.5 * (view.columns - 1) * view.along_row - 0.5 * (view.rows - 1) * view.along_column;
  return view;
}

bool IsWanted(const StereoParams& params, const math::Vector3& p_RoP_R,
              messages::LookDirection direction) {
  if (params.field_of_view == StereoFieldOfView::kFull) return true;
  const StripeWindowParams& window = params.stripe_window;
  const double ahead_m = direction == messages::LookDirection::kAhead ? p_RoP_R.x() : -p_RoP_R.x();
  return ahead_m >= window.near_m && ahead_m <= window.far_m &&
         std::abs(p_RoP_R.y()) <= window.half_width_m;
}

messages::PointCloud PointsOf(const StereoParams& params, const StereoView& view_R,
                              const DepthImage& inverse_depths, std::int64_t look_number,
                              messages::LookDirection direction) {
  messages::PointCloud cloud{.number = look_number, .direction = direction, .points_R = {}};
  const auto columns = static_cast<std::size_t>(view_R.columns);
  constexpr std::size_t kRoom = 8;  // what PlacePoints asks for
  std::array<std::vector<double>, 3> placed;
  placed.fill(std::vector<double>(columns + kRoom));
  std::vector<Vector3> points_R(static_cast<std::size_t>(inverse_depths.size()) + 1);
  std::size_t count = 0;
  for (int row = 0; row < view_R.rows; ++row) {
    const double* pixels = &inverse_depths(row, 0);
    // Pixel (c, r) at depth Z: eye + Z e(c, r), in R.
    for (const Eigen::Index i : {0, 1, 2}) {
      const RowRays rays{view_R.eye[i], view_R.first[i], view_R.along_row[i],
                         row * view_R.along_column[i]};
      PlacePoints(rays, pixels, columns, placed[static_cast<std::size_t>(i)].data());
    }
    for (std::size_t column = 0; column < columns; ++column) {
      // What is no point is overwritten by the next one: a branch would be guessed wrong often.
      points_R[count] = {placed[0][column], placed[1][column], placed[2][column]};
      count += static_cast<std::size_t>(pixels[column] > 0.0);
    }
  }
  points_R.resize(count);
  if (params.field_of_view != StereoFieldOfView::kFull) {
    std::erase_if(points_R,
                  [&](const Vector3& p_RoP_R) { return !IsWanted(params, p_RoP_R, direction); });
  }
  cloud.points_R = std::move(points_R);
  return cloud;
}

}  // namespace rockyard::sensing
