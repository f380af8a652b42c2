#include "rendering/image_blur.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rockyard::rendering {

ImageBlur::ImageBlur(double sigma_px) : weights_{1.0} {
  constexpr double kReach = 4.0;  // in units of sigma
  double sum = 1.0;
  for (int k = 1; k < kReach * sigma_px + 1.0; ++k) {
    // exp(-k^2 / 2 s^2), then normalized so that the line keeps its light.
    weights_.push_back(std::exp(-0.5 * k * k / (sigma_px * sigma_px)));
    sum += 2.0 * weights_.back();
  }
  for (double& weight : weights_) weight /= sum;
}

void ImageBlur::Apply(RenderedRow& row) const {
  if (weights_.size() == 1) return;
  const int columns = static_cast<int>(row.sun_e_s.size());
  const int reach = static_cast<int>(weights_.size()) - 1;
  const auto weight = [this](int k) { return weights_[static_cast<std::size_t>(std::abs(k))]; };

  const std::vector<double> sharp = std::move(row.sun_e_s);
  row.sun_e_s.assign(sharp.size(), 0.0);
  for (int pixel = 0; pixel < columns; ++pixel) {
    for (int k = -reach; k <= reach; ++k) {
      // Sunlight beyond the ends of the line is that at its ends.
      const auto from = static_cast<std::size_t>(std::clamp(pixel + k, 0, columns - 1));
      row.sun_e_s[static_cast<std::size_t>(pixel)] += weight(k) * sharp[from];
    }
  }
  const std::vector<RenderedRow::LampPixel> lamps = std::move(row.lamps);
  row.lamps.clear();
  // Light of lamps is spread from where it is; what leaves the line is lost.
  for (const RenderedRow::LampPixel& light : lamps) {
    for (int k = -reach; k <= reach; ++k) {
      const int pixel = light.pixel + k;
      if (pixel < 0 || pixel >= columns) continue;
      row.lamps.push_back({pixel, light.lamp, weight(k) * light.rate_e_s});
    }
  }
}

}  // namespace rockyard::rendering
