// Range points from the stereo cameras at the rover's front and rear.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/random.h"
#include "math/pose.h"
#include "messages/point_cloud.h"
#include "sensing/stereo_depth.h"
#include "sensing/stereo_params.h"
#include "sensing/stereo_view.h"
#include "sensing/sun_shade.h"
#include "terrain/terrain.h"

namespace rockyard::sensing {

// Turns the disparities of an image, px, into what matching makes of them: noise, rounding, wrong
// matches, the range of disparities searched, dropouts. A pixel is 0 where there is no match.
class StereoMatcher {
 public:
  explicit StereoMatcher(const StereoParams& params);

  // `seen` are the disparities of what both cameras see; jumps in depth are those of `all` that the
  // left one sees; `shaded` is the pixels outside of the sun, empty where none counts as such.
  // Draws by pixel from (key, kStereoDisparity, kStereoMismatch and kStereoDropout,
  // look).
  void Match(core::TrialKey key, std::uint32_t look, const DepthImage& all, DepthImage& seen,
             const PixelFlags& shaded = {}) const;

 private:
  void AddNoise(core::TrialKey key, std::uint32_t look, DepthImage& seen) const;
  void Mismatch(core::TrialKey key, std::uint32_t look, const DepthImage& all,
                DepthImage& seen) const;
  void MismatchEdge(std::span<const double> row_px, std::size_t column, int jump,
                    double& pixel) const;
  void DropMargins(DepthImage& seen) const;
  void DropOut(core::TrialKey key, std::uint32_t look, const DepthImage& all,
               const PixelFlags& shaded, DepthImage& seen) const;

  StereoParams params_;
  float mismatch_quantile_;       // standard normal numbers below it are wrong matches
  float edge_mismatch_quantile_;  // those from there up to it, beside a jump, of the other surface
  // The same for dropouts: [beside a jump][in shadow].
  std::array<std::array<float, 2>, 2> dropout_quantiles_;
};

// Gives one point for each pixel of the left image for which all of the following hold:
//  - its ray meets a surface within max_range_m;
//  - the right camera sees that point too: it lies inside its image, with nothing in between;
//  - disparity d = f b / Z (Goldberg 2002, section 2), with Z the depth along the optical axis,
//    changed by N(0, disparity_noise_px), rounded to disparity_step_px, or wrong altogether with
//    mismatch_probability, or that of the other surface beside a jump in depth with
//    edge_mismatch_probability, lies between min_ and max_disparity_px. The point is put on the
//    same ray at depth f b / d, so that to first order sigma_Z = Z^2 sigma_d / (f b);
//  - it did not drop out, with dropout_probability or edge_dropout_probability, in shadow with
//    shadow_dropout_probability on top, nor does it lie within margin_px of an image's edge.
// The ideal sensor stops after the first. With field_of_view stripe, points outside the window are
// dropped last.
//
// Limits: the rover's own body is not seen. By default errors are independent from pixel to pixel,
// while matching windows make those of neighbours alike (noise_window_px) and round off edges.
// Nothing depends on texture, and of light only dropouts in shadow. Surfaces beyond max_range_m
// give no point, but noise may put a point farther away.
//
// Cost: 0.2 to 0.3 ms a look of 128 x 128 in nominal and VL-2 terrain, 36 ms on rough ground.
class StereoSensor {
 public:
  explicit StereoSensor(const StereoParams& params);
  // The same in sunlight, which only shadow_dropout_probability asks for.
  StereoSensor(const StereoParams& params, const SunShade& shade);

  // Takes one look with the rover at X_WR. It is a pure function of its arguments and draws from
  // (key, kStereoDisparity, kStereoMismatch and kStereoDropout, look number), by
  // pixel: at most 2^32 looks.
  messages::PointCloud Look(const terrain::Terrain& terrain, const math::Transform& X_WR,
                            core::TrialKey key, std::int64_t look_number,
                            messages::LookDirection direction) const;

  // The measurement alone: one over the depths of a look's pixels, 1/m, 0 where there is no point.
  // Points are worked out of it (sensing::PointsOf).
  DepthImage InverseDepths(const terrain::Terrain& terrain, const math::Transform& X_WR,
                           core::TrialKey key, std::int64_t look_number,
                           messages::LookDirection direction) const;

  const StereoView& view_R(messages::LookDirection direction) const {
    return direction == messages::LookDirection::kAhead ? ahead_R_ : behind_R_;
  }

 private:
  PixelFlags Shaded(const terrain::Terrain& terrain, const math::Transform& X_WR,
                    const StereoView& view_W, const DepthImage& seen) const;

  StereoParams params_;
  StereoMatcher matcher_;
  std::optional<SunShade> shade_;  // none where light does not matter
  StereoView ahead_R_;
  StereoView behind_R_;
};

}  // namespace rockyard::sensing
