#include "terrain/soil_draw.h"

#include <algorithm>

#include "math/angles.h"
#include "math/functions.h"

namespace rockyard::terrain {

SoilParams DrawSoil(const SoilParams& soil, core::TrialKey key) {
  core::RandomStream stream(key, core::Purpose::kSoil);
  const auto normal = [&stream](double deviation) {
    return core::SampleNormal(stream, 0.0, deviation);
  };
  const SoilSpreadParams& spread = soil.spread;
  SoilParams drawn = soil;
  drawn.sinkage_exponent = std::clamp(soil.sinkage_exponent + normal(spread.exponent), 0.1, 2.0);
  const double modulus = math::Exp(normal(spread.log_modulus));
  drawn.cohesive_modulus_N_per_mn1 *= modulus;
  drawn.frictional_modulus_N_per_mn2 *= modulus;
  drawn.cohesion_Pa *= math::Exp(normal(spread.log_cohesion));
  drawn.friction_angle_rad = std::clamp(soil.friction_angle_rad + normal(spread.friction_angle_rad),
                                        0.0, math::DegToRad(60.0));
  drawn.shear_modulus_m *= math::Exp(normal(spread.log_shear_modulus));
  drawn.density_kg_m3 *= math::Exp(normal(spread.log_density));
  return drawn;
}

}  // namespace rockyard::terrain
