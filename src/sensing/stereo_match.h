// From true to matched disparities.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/random.h"
#include "sensing/stereo_depth.h"
#include "sensing/stereo_params.h"

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

}  // namespace rockyard::sensing
