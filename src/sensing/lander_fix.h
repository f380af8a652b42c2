// The rover's pose as the lander's cameras find it (Matthies 1995, section 5 and appendix A).
#pragma once

#include <cstdint>
#include <optional>

#include "core/random.h"
#include "messages/aids.h"
#include "sensing/aid_params.h"
#include "sensing/cylinder_law.h"
#include "terrain/terrain.h"

namespace rockyard::sensing {

// Where the lander's cameras stand, in W, and by how much their pan axis is wrong, positive left.
struct LanderPlace {
  double x_m = 0.0;
  double y_m = 0.0;
  double pan_error_rad = 0.0;
};

// Of law `constant`: a fix is a place in polar coordinates about the cameras and a heading: range
// (1 + f n1), bearing
// + b n2, heading + h n3 with the deviations f, b, h of the parameters and standard normal n; pan
// error added to both angles. The covariance that comes with it knows the deviations and neither
// what they have in common from fix to fix nor the pan error. Limits: any colour, light and stance
// of the rover is seen as well as any other; deviations do not go with the angle of view.
//
// Of law `cylinder` (sensing/cylinder_law.h) the deviations go with the stance of the rover, there
// are biases, a fix may be missed, and one may be wrong: its heading off by anything up to
// wrong_turn, its range times exp(wrong_range n). The covariance is that of a right fix: the lander
// does not know.
class LanderFix {
 public:
  LanderFix(const LanderFixParams& params, const LanderPlace& lander, core::TrialKey key);

  // The fix of the rover at X_WR; nothing beyond the range, or where something hides the rover's
  // top from the mast. `number` counts measurements from 0: stream kLanderFix, substream number +
  // 1; 0 is what the fixes of a trial have in common; kChances + number is what becomes of one by
  // the law of the cylinder. Where no sun is given, it stands at that law's `sun_elevation`.
  std::optional<messages::PoseFix> Observe(
      const math::Transform& X_WR, const terrain::Terrain& terrain, std::int64_t number,
      std::optional<double> sun_elevation_rad = std::nullopt) const;

 private:
  struct Draws {
    double range = 0.0;  // standard normal, as the next
    double bearing = 0.0;
    double heading = 0.0;
  };

  // How a fix comes out: its deviations, known to the lander, and its errors, which are not.
  struct Outcome {
    CylinderDeviations sd;
    double heading_rad = 0.0;
    double range_factor = 1.0;
    double bearing_rad = 0.0;
  };

  Draws Draw(std::uint32_t substream) const;
  // What is drawn anew and what all fixes share, with variances that add up to 1.
  Draws DrawFix(std::int64_t number) const;
  Outcome ByConstantLaw(const Draws& draws) const;
  // Nothing where the cylinder is not found.
  std::optional<Outcome> ByCylinderLaw(const CylinderStance& stance, const Draws& draws,
                                       std::int64_t number) const;

  LanderFixParams params_;
  LanderPlace lander_;
  core::TrialKey key_;
};

}  // namespace rockyard::sensing
