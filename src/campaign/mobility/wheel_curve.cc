#include "campaign/mobility/wheel_curve.h"

#include "messages/wheels.h"
#include "rover/steady_wheel.h"

namespace rockyard::campaign {

std::vector<WheelPoint> WheelCurve(const rover::RoverParams& params,
                                   const terrain::SoilParams& soil) {
  constexpr int kIntervals = 50;
  const rover::WheelOnSoil wheel = rover::MakeWheelOnSoil(params, soil);
  const double load_N =
      params.mass.total_kg * params.physics.gravity_m_s2 / double{messages::kWheelCount};
  std::vector<WheelPoint> curve;
  for (int i = 0; i < kIntervals; ++i) {
    // Closest where the pull grows fastest.
    const double slip = (i * i) / double{kIntervals * kIntervals};
    curve.push_back(
        {slip, load_N, rover::SteadyWheel(wheel, params.geometry.wheel_radius_m, load_N, slip)});
  }
  return curve;
}

}  // namespace rockyard::campaign
