// From true to matched disparities.
#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "sensing/stereo_params.h"

namespace rockyard::sensing {

// Turns the disparities of an image, row by row, 0 where there is no point, into what matching
// makes of them: noise, rounding, the range of disparities searched, dropouts; 0 where there is no
// match. `seen` says which of them the right camera sees; jumps in depth are those of all. Draws by
// pixel from (key, kStereoDisparity and kStereoDropout, look).
class StereoMatcher {
 public:
  explicit StereoMatcher(const StereoParams& params);

  void Match(core::TrialKey key, std::uint32_t look, const std::vector<double>& all_px,
             std::vector<double>& seen_px) const;

 private:
  void AddNoise(core::TrialKey key, std::uint32_t look, std::vector<double>& seen_px) const;
  void DropOut(core::TrialKey key, std::uint32_t look, const std::vector<double>& all_px,
               std::vector<double>& seen_px) const;
  // Which columns of a row lie beside a jump in depth.
  void FindEdges(const double* row_px, std::vector<char>& beside_edge) const;

  StereoParams params_;
  int columns_;
  int rows_;
  float dropout_quantile_;       // standard normal numbers below it are dropouts
  float edge_dropout_quantile_;  // the same beside a jump
};

}  // namespace rockyard::sensing
