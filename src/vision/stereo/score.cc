#include "vision/stereo/score.h"

#include <cmath>

#include "core/check.h"

namespace rockyard::vision {
namespace {

double Share(std::int64_t part, std::int64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

double StereoScore::Density() const { return Share(matched, known); }

double StereoScore::BadShare(std::size_t i) const { return Share(bad.at(i), matched); }

StereoScore ScoreAgainst(const Image<float>& known, const DisparityImage& disparities) {
  EXPECT(known.width() == disparities.width() && known.height() == disparities.height());
  StereoScore score;
  double sum_px = 0.0;
  double sum_px2 = 0.0;
  for (int y = 0; y < known.height(); ++y) {
    for (int x = 0; x < known.width(); ++x) {
      const double truth_px = static_cast<double>(known.At(x, y));
      if (!std::isfinite(truth_px)) continue;
      ++score.known;
      if (!IsValid(disparities.At(x, y))) continue;
      ++score.matched;
      const double error_px = DisparityPx(disparities.At(x, y)) - truth_px;
      sum_px += error_px;
      sum_px2 += error_px * error_px;
      for (std::size_t i = 0; i < kBadThresholds_px.size(); ++i) {
        if (std::abs(error_px) > kBadThresholds_px[i]) ++score.bad[i];
      }
    }
  }
  if (score.matched > 0) {
    score.mean_error_px = sum_px / static_cast<double>(score.matched);
    score.rms_error_px = std::sqrt(sum_px2 / static_cast<double>(score.matched));
  }
  return score;
}

}  // namespace rockyard::vision
