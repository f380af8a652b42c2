#include "sensing/image_readout.h"

#include <algorithm>
#include <cmath>

#include "core/distributions.h"

namespace rockyard::sensing {

ImageReadout::ImageReadout(const ImagerParams& imager, double speckle_contrast)
    : detector_(imager.detector()),
      repeatability_(imager.exposure.repeatability),
      speckle_contrast_(speckle_contrast),
      largest_count_((1 << detector_.adc_bits) - 1),
      black_counts_(imager.black_level * largest_count_),
      electrons_per_count_(detector_.full_well_e / (largest_count_ - black_counts_)) {}

double ImageReadout::DarkTime(double exposure_s, core::TrialKey key, const ImageName& name) const {
  core::RandomStream stream(key, core::Purpose::kImageExposure, name.substream());
  return exposure_s * std::max(0.0, 1.0 + core::SampleNormal(stream, 0.0, repeatability_));
}

void ImageReadout::Read(const RenderedRow& row, int first_column, double exposure_s,
                        core::TrialKey key, const ImageName& name, std::span<const int> group_of,
                        std::vector<std::uint16_t>& counts) const {
  std::vector<double> mean_e(row.sun_e_s.size());
  std::transform(row.sun_e_s.begin(), row.sun_e_s.end(), mean_e.begin(),
                 [exposure_s](double rate_e_s) { return rate_e_s * exposure_s; });
  if (name.lit) {
    const PixelNoise speckle(key, core::Purpose::kImageSpeckle, name.substream());
    for (const RenderedRow::LaserPixel& laser : row.lasers) {
      if (group_of[static_cast<std::size_t>(laser.laser)] != name.group) continue;
      const double z = speckle.At(row.row, first_column + laser.pixel);
      mean_e[static_cast<std::size_t>(laser.pixel)] +=
          laser.rate_e_s * exposure_s * std::max(0.0, 1.0 + speckle_contrast_ * z);
    }
  }

  const auto pattern = [&](std::uint32_t kind) {
    const auto camera = static_cast<std::uint32_t>(name.camera);
    return PixelNoise(key, core::Purpose::kPixelPattern, 2 * camera + kind);
  };
  const double dark_e = detector_.dark_current_e_s * exposure_s;
  const double read2_e2 = detector_.read_noise_e * detector_.read_noise_e;
  const int columns = static_cast<int>(mean_e.size());
  const auto at = [first_column](int column) {
    return static_cast<std::size_t>(column - first_column);
  };
  std::vector<double> electrons(mean_e.size());
  ForEachPixelNoise(PixelNoise(key, core::Purpose::kImageNoise, name.substream()), row.row,
                    first_column, columns, [&](int column, float z) {
                      const double light_e = mean_e[at(column)];
                      electrons[at(column)] =
                          light_e + dark_e + std::sqrt(light_e + dark_e + read2_e2) * z;
                    });
  ForEachPixelNoise(pattern(0), row.row, first_column, columns, [&](int column, float z) {
    electrons[at(column)] += detector_.response_nonuniformity * z * mean_e[at(column)];
  });
  ForEachPixelNoise(pattern(1), row.row, first_column, columns, [&](int column, float z) {
    electrons[at(column)] += detector_.offset_nonuniformity_e * z;
  });
  for (const double e : electrons) {
    const double count = std::min(e, detector_.full_well_e) / electrons_per_count_ + black_counts_;
    const double rounded = std::floor(count + 0.5);
    counts.push_back(
        static_cast<std::uint16_t>(std::clamp(rounded, 0.0, static_cast<double>(largest_count_))));
  }
}

}  // namespace rockyard::sensing
