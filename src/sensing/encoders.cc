#include "sensing/encoders.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/check.h"
#include "core/distributions.h"

namespace rockyard::sensing {

Encoders::Encoders(const EncoderParams& params, double wheel_radius_m, core::TrialKey key)
    : params_(params), wheel_radius_m_(wheel_radius_m), key_(key) {
  EXPECT(params.noise_variance_m2_per_m() >= 0.0 && params.noise_stretch_m > 0.0);
  EXPECT(wheel_radius_m > 0.0);
}

double Encoders::RollOn(double distance_m) {
  // Travel within one stretch shares its scale error; a long way is divided at the ends of
  // stretches, so that the tick length does not matter.
  double noise_m = 0.0;
  while (distance_m > 0.0) {
    if (left_in_stretch_m_ <= 0.0) {
      core::RandomStream stream(key_, core::Purpose::kEncoder, stretch_++);
      // The stretch L is wrong by N(0, v L) with v in m2/m (Matthies 1995, section 5: 0.0039), that
      // is by the scale error N(0, v / L).
      scale_error_ = core::SampleNormal(
          stream, 0.0, std::sqrt(params_.noise_variance_m2_per_m() / params_.noise_stretch_m));
      left_in_stretch_m_ = params_.noise_stretch_m;
    }
    const double part_m = std::min(distance_m, left_in_stretch_m_);
    noise_m += part_m * scale_error_;
    left_in_stretch_m_ -= part_m;
    distance_m -= part_m;
  }
  return noise_m;
}

messages::PerWheel<double> Encoders::Measure(const messages::PerWheel<double>& true_turn_rad) {
  const double mean_rad =
      std::accumulate(true_turn_rad.begin(), true_turn_rad.end(), 0.0) / messages::kWheelCount;
  EXPECT(std::isfinite(mean_rad));
  const double noise_m = RollOn(std::abs(mean_rad) * wheel_radius_m_);
  // The noise lengthens or shortens the motion in its own direction; all wheels share it.
  const double noise_rad = (mean_rad < 0.0 ? -noise_m : noise_m) / wheel_radius_m_;
  messages::PerWheel<double> measured = true_turn_rad;
  for (double& turn_rad : measured) turn_rad += noise_rad;
  return measured;
}

}  // namespace rockyard::sensing
