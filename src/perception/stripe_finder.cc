#include "perception/stripe_finder.h"

#include "perception/stripe_peaks.h"

namespace rockyard::perception {

StripeFinder::StripeFinder(const StripeFinderParams& params,
                           const messages::StripeCalibration& calibration)
    : params_(params), calibration_(calibration), searches_(calibration) {}

messages::ColumnRange StripeFinder::searched(std::size_t row, std::size_t stripe) const {
  return searches_.At(calibration_.lasers[stripe].camera, row, stripe).columns;
}

// One scanline in one exposure: average, threshold, peaks, and which peak is which laser.
void StripeFinder::FindIn(const messages::StripeExposure& exposure, std::size_t row,
                          messages::StripeScan& scan) const {
  const auto profile = AverageDifference(exposure, calibration_.scanline_px[row],
                                         static_cast<int>(params_.averaging_px));
  if (!profile) return;
  // Lasers that the other camera measures show in this one's images, too.
  std::vector<std::size_t> lit;
  std::vector<StripeSearch> searches;
  for (std::size_t stripe = 0; stripe < calibration_.lasers.size(); ++stripe) {
    if (calibration_.lasers[stripe].group != exposure.group) continue;
    lit.push_back(stripe);
    searches.push_back(searches_.At(exposure.camera, row, stripe));
  }
  // All lasers of the image take part in the association; only those that this camera measures are
  // kept.
  const std::vector<StripePeak> peaks = FindPeaks(*profile, params_);
  const auto peak_of = AssociatePeaks(searches, peaks, params_.peak);
  for (std::size_t i = 0; i < lit.size(); ++i) {
    // Peaks of the other camera's lasers are explained, and not kept.
    if (!peak_of[i] || calibration_.lasers[lit[i]].camera != exposure.camera) continue;
    scan.pixels[row][lit[i]] = {.detected = true, .column_px = peaks[*peak_of[i]].column_px};
  }
}

messages::StripeScan StripeFinder::Find(const messages::StripeImages& images) const {
  const messages::StripeArraySize size = calibration_.size();
  messages::StripeScan scan{images.number, messages::StripeArray<messages::StripePixel>(size)};
  for (const messages::StripeExposure& exposure : images.exposures) {
    for (std::size_t row = 0; row < size.rows; ++row) FindIn(exposure, row, scan);
  }
  return scan;
}

}  // namespace rockyard::perception
