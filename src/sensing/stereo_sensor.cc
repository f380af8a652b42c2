#include "sensing/stereo_sensor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "core/random.h"
#include "rendering/image_readout.h"
#include "sensing/stereo_depth.h"
#include "sensing/stereo_view.h"

namespace rockyard::sensing {
namespace {

using math::Vector3;
using messages::LookDirection;

// Returns the number below which a standard normal number lies with the given probability.
// PixelNoise has 2^16 numbers: chances are met to 1/65536, and chances of less than half of that
// never happen.
float Quantile(double probability) {
  if (probability <= 0.0) return -std::numeric_limits<float>::infinity();
  return static_cast<float>(core::NormalQuantile(probability));
}

// Returns the quantiles of a chance p in the sun, and in shadow, where an independent chance q is
// added: 1 - (1 - p)(1 - q). It must stay written so that q = 0 leaves the bits of p.
std::array<float, 2> ByLight(double lit, double in_shadow) {
  return {Quantile(lit), Quantile(lit + in_shadow * (1.0 - lit))};
}

// Returns sums over windows of w x w independent numbers of variance 1, divided by w: they have
// variance 1 again. Pixels (i, j) apart share (w - i)(w - j) of the numbers, so they correlate by
// (1 - i/w)(1 - j/w).
DepthImage MeanOfWindows(const DepthImage& numbers, Eigen::Index window) {
  const Eigen::Index rows = numbers.rows() - window + 1;
  const Eigen::Index columns = numbers.cols() - window + 1;
  DepthImage along_rows = numbers.leftCols(columns);
  for (Eigen::Index i = 1; i < window; ++i) along_rows += numbers.middleCols(i, columns);
  DepthImage sums = along_rows.topRows(rows);
  for (Eigen::Index i = 1; i < window; ++i) sums += along_rows.middleRows(i, rows);
  return sums / static_cast<double>(window);
}

}  // namespace

StereoMatcher::StereoMatcher(const StereoParams& params)
    : params_(params),
      mismatch_quantile_(Quantile(params.mismatch_probability)),
      edge_mismatch_quantile_(
          Quantile(params.mismatch_probability +
                   params.edge_mismatch_probability * (1.0 - params.mismatch_probability))),
      dropout_quantiles_{
          {ByLight(params.dropout_probability, params.shadow_dropout_probability),
           ByLight(params.edge_dropout_probability, params.shadow_dropout_probability)}} {}

// The order of steps decides records: noise, rounding, wrong matches, the searched range, margins,
// dropouts. A pixel of 0 stays 0. Each step draws from a stream of its own, by pixel, so that a
// step that is off shifts the numbers of no other.
void StereoMatcher::Match(core::TrialKey key, std::uint32_t look, const DepthImage& all,
                          DepthImage& seen, const PixelFlags& shaded) const {
  AddNoise(key, look, seen);
  const double step_px = params_.disparity_step_px;
  if (step_px > 0.0) seen = step_px * (seen / step_px).round();
  if (params_.mismatch_probability > 0.0 || params_.edge_mismatch_probability > 0.0) {
    Mismatch(key, look, all, seen);
  }
  seen = (seen >= params_.min_disparity_px && seen <= params_.max_disparity_px).select(seen, 0.0);
  if (params_.margin_px > 0) DropMargins(seen);
  if (params_.dropout_probability > 0.0 || params_.edge_dropout_probability > 0.0 ||
      shaded.size() > 0) {
    DropOut(key, look, all, shaded, seen);
  }
}

// Column c of the left image with disparity d is column c - d of the right one, in which margins
// end half a column before the first pixel beside them.
void StereoMatcher::DropMargins(DepthImage& seen) const {
  const auto margin = static_cast<Eigen::Index>(params_.margin_px);
  constexpr double kHalf_px = 0.5;
  for (Eigen::Index row = 0; row < seen.rows(); ++row) {
    const bool edge_row = row < margin || row >= seen.rows() - margin;
    for (Eigen::Index column = 0; column < seen.cols(); ++column) {
      const double right_px = static_cast<double>(column) - seen(row, column);
      if (edge_row || column >= seen.cols() - margin ||
          right_px < static_cast<double>(margin) - kHalf_px) {
        seen(row, column) = 0.0;
      }
    }
  }
}

void StereoMatcher::AddNoise(core::TrialKey key, std::uint32_t look, DepthImage& seen) const {
  if (params_.disparity_noise_px <= 0.0) return;
  const rendering::PixelNoise noise(key, core::Purpose::kStereoDisparity, look);
  const auto beyond = static_cast<int>(params_.noise_window_px) - 1;
  // w - 1 more numbers on each axis, so that every pixel has a full window.
  DepthImage numbers(seen.rows() + beyond, seen.cols() + beyond);
  for (int row = 0; row < numbers.rows(); ++row) {
    rendering::ForEachPixelNoise(noise, row, 0, static_cast<int>(numbers.cols()),
                                 [&](int column, float number) { numbers(row, column) = number; });
  }
  if (beyond > 0) numbers = MeanOfWindows(numbers, beyond + 1);
  seen = (seen > 0.0).select(seen + params_.disparity_noise_px * numbers, 0.0);
}

// One normal number z a pixel decides. Where Phi(z) < p the pixel is a mismatch: Phi(z) / p is then
// uniform in [0, 1), and says where in the searched range the match lies. Beside a jump the pixel
// matches the other surface where Phi(z) lies from p to p + q (1 - p).
void StereoMatcher::Mismatch(core::TrialKey key, std::uint32_t look, const DepthImage& all,
                             DepthImage& seen) const {
  const rendering::PixelNoise noise(key, core::Purpose::kStereoMismatch, look);
  const double searched_px = params_.max_disparity_px - params_.min_disparity_px;
  const auto columns = static_cast<std::size_t>(seen.cols());
  const bool grows = params_.edge_mismatch_probability > 0.0;
  std::vector<int> jumps(columns, kNoJump);
  for (int row = 0; row < seen.rows(); ++row) {
    const std::span<const double> row_px(&all(row, 0), columns);
    if (grows) JumpDistances(row_px, params_.edge_disparity_px, jumps);
    rendering::ForEachPixelNoise(
        noise, row, 0, static_cast<int>(columns), [&](int column, float number) {
          double& pixel = seen(row, column);
          if (number >= edge_mismatch_quantile_ || pixel == 0.0) return;
          const auto at = static_cast<std::size_t>(column);
          if (number >= mismatch_quantile_) {
            MismatchEdge(row_px, at, jumps[at], pixel);
            return;
          }
          const double share =
              0.5 * std::erfc(-number / std::numbers::sqrt2) / params_.mismatch_probability;
          pixel = params_.min_disparity_px + std::min(share, 1.0) * searched_px;
        });
  }
}

// The window around the pixel holds both surfaces, and may match by the contrast of either. The
// pixel keeps its noise; where nothing is seen across the jump it keeps its disparity.
void StereoMatcher::MismatchEdge(std::span<const double> row_px, std::size_t column, int jump,
                                 double& pixel) const {
  if (jump > params_.edge_reach_px) return;
  const double across_px = row_px[AcrossJump(row_px, params_.edge_disparity_px, column, jump)];
  if (across_px > 0.0) pixel += across_px - row_px[column];
}

// Jumps are taken from what the left camera sees (`all`), whether the right one sees it or not: the
// window that is matched is cut out of the left image.
void StereoMatcher::DropOut(core::TrialKey key, std::uint32_t look, const DepthImage& all,
                            const PixelFlags& shaded, DepthImage& seen) const {
  const rendering::PixelNoise noise(key, core::Purpose::kStereoDropout, look);
  const auto columns = static_cast<std::size_t>(seen.cols());
  std::vector<int> jumps(columns);
  for (int row = 0; row < seen.rows(); ++row) {
    if ((seen.row(row) == 0.0).all()) continue;
    JumpDistances({&all(row, 0), columns}, params_.edge_disparity_px, jumps);
    rendering::ForEachPixelNoise(
        noise, row, 0, static_cast<int>(columns), [&](int column, float number) {
          const bool edge = jumps[static_cast<std::size_t>(column)] <= params_.edge_reach_px;
          const bool dark = shaded.size() > 0 && shaded(row, column);
          if (number < dropout_quantiles_[edge ? 1 : 0][dark ? 1 : 0]) seen(row, column) = 0.0;
        });
  }
}

StereoSensor::StereoSensor(const StereoParams& params)
    : params_(params),
      matcher_(params),
      ahead_R_(MakeStereoView(params, LookDirection::kAhead)),
      behind_R_(MakeStereoView(params, LookDirection::kBehind)) {}

StereoSensor::StereoSensor(const StereoParams& params, const SunShade& shade)
    : StereoSensor(params) {
  if (params.shadow_dropout_probability > 0.0) shade_ = shade;
}

PixelFlags StereoSensor::Shaded(const terrain::Terrain& terrain, const math::Transform& X_WR,
                                const StereoView& view_W, const DepthImage& seen) const {
  PixelFlags shaded = PixelFlags::Constant(seen.rows(), seen.cols(), false);
  for (int row = 0; row < view_W.rows; ++row) {
    for (int column = 0; column < view_W.columns; ++column) {
      if (seen(row, column) <= 0.0) continue;
      const Vector3 ray_W = view_W.Ray(column, row).normalized();
      const auto hit = terrain.CastRay(view_W.eye, ray_W, params_.max_range_m);
      shaded(row, column) = hit && shade_->IsShaded(terrain, X_WR, *hit);
    }
  }
  return shaded;
}

DepthImage StereoSensor::InverseDepths(const terrain::Terrain& terrain, const math::Transform& X_WR,
                                       core::TrialKey key, std::int64_t look_number,
                                       LookDirection direction) const {
  const StereoView view_W = view_R(direction).From(X_WR);
  const StereoScene scene(terrain, view_W, params_.max_range_m);
  DepthImage all = scene.InverseDepths();
  // The ideal sensor stops here: one eye, no matching.
  if (params_.fidelity == StereoFidelity::kIdeal) return all;
  DepthImage seen = all;
  scene.HideFromRightEye(seen);
  const double scale_px_m = params_.focal_columns_px() * params_.baseline_m;
  // Goldberg 2002, section 2: d = f b / Z. Noise acts on the disparity; back to depth on the same
  // ray.
  all *= scale_px_m;
  seen *= scale_px_m;
  const PixelFlags shaded = shade_ ? Shaded(terrain, X_WR, view_W, seen) : PixelFlags();
  matcher_.Match(key, static_cast<std::uint32_t>(look_number), all, seen, shaded);
  seen /= scale_px_m;
  return seen;
}

messages::PointCloud StereoSensor::Look(const terrain::Terrain& terrain,
                                        const math::Transform& X_WR, core::TrialKey key,
                                        std::int64_t look_number, LookDirection direction) const {
  return PointsOf(params_, view_R(direction),
                  InverseDepths(terrain, X_WR, key, look_number, direction), look_number,
                  direction);
}

}  // namespace rockyard::sensing
