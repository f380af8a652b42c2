// From true to matched disparities.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

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
  // left one sees. Draws by pixel from (key, kStereoDisparity, kStereoMismatch and kStereoDropout,
  // look).
  void Match(core::TrialKey key, std::uint32_t look, const DepthImage& all, DepthImage& seen) const;

 private:
  void AddNoise(core::TrialKey key, std::uint32_t look, DepthImage& seen) const;
  void Mismatch(core::TrialKey key, std::uint32_t look, DepthImage& seen) const;
  void DropOut(core::TrialKey key, std::uint32_t look, const DepthImage& all,
               DepthImage& seen) const;
  // Marks the columns of a row that lie beside a jump in depth.
  void FindEdges(std::span<const double> row_px, std::vector<char>& beside_edge) const;

  StereoParams params_;
  float mismatch_quantile_;      // standard normal numbers below it are wrong matches
  float dropout_quantile_;       // the same for dropouts
  float edge_dropout_quantile_;  // and for dropouts beside a jump
};

}  // namespace rockyard::sensing
