#include "rendering/exposure_control.h"

#include <algorithm>
#include <functional>

namespace rockyard::rendering {

double ExposureTime(const ImagerParams& imager, std::vector<double> rates_e_s) {
  const ExposureParams& exposure = imager.exposure;
  if (rates_e_s.empty()) return exposure.longest_s;
  const auto brighter =
      static_cast<std::size_t>(exposure.brightest_share * static_cast<double>(rates_e_s.size()));
  const auto nth = rates_e_s.begin() + static_cast<std::ptrdiff_t>(brighter);
  std::nth_element(rates_e_s.begin(), nth, rates_e_s.end(), std::greater<>());
  // t = target_fill W / (R + D), with R exceeded by brightest_share of the pixels.
  const double rate_e_s = *nth + imager.detector().dark_current_e_s;
  const double target_e = exposure.target_fill * imager.detector().full_well_e;
  // Written so that darkness divides nothing by zero.
  if (target_e >= rate_e_s * exposure.longest_s) return exposure.longest_s;
  return std::max(exposure.shortest_s, target_e / rate_e_s);
}

}  // namespace rockyard::rendering
