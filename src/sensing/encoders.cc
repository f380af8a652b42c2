#include "sensing/encoders.h"

#include <cmath>
#include <numeric>

#include "core/check.h"
#include "core/distributions.h"

namespace rockyard::sensing {

Encoders::Encoders(const EncoderParams& params, double wheel_radius_m, core::TrialKey key)
    : noise_variance_m2_per_m_(params.noise_variance_m2_per_m()),
      wheel_radius_m_(wheel_radius_m),
      key_(key) {
  EXPECT(noise_variance_m2_per_m_ >= 0.0 && wheel_radius_m > 0.0);
}

messages::PerWheel<double> Encoders::Measure(const messages::PerWheel<double>& true_turn_rad,
                                             std::int64_t step) const {
  EXPECT(step >= 0);
  const double mean_rad =
      std::accumulate(true_turn_rad.begin(), true_turn_rad.end(), 0.0) / messages::kWheelCount;
  const double forward_m = std::abs(mean_rad) * wheel_radius_m_;
  core::RandomStream stream(key_, core::Purpose::kEncoder, static_cast<std::uint32_t>(step));
  const double noise_rad =
      core::SampleNormal(stream, 0.0, std::sqrt(noise_variance_m2_per_m_ * forward_m)) /
      wheel_radius_m_;
  messages::PerWheel<double> measured = true_turn_rad;
  for (double& turn_rad : measured) turn_rad += noise_rad;
  return measured;
}

}  // namespace rockyard::sensing
