// What a contact resists with: spring, damper, friction, slip and motion resistance.
#pragma once

#include "rover/multibody/contact_finder.h"
#include "rover/part_shapes.h"
#include "rover/rover_params.h"
#include "rover/wheel_soil.h"

namespace rockyard::rover {

// The law of one contact in one step. Its normal force is the stiffness times the penetration
// beyond rest_depth_m, less the damping.
struct ContactLaw {
  double stiffness_N_m = 0.0;
  double rest_depth_m = 0.0;
  double friction = 0.0;                // largest friction over load
  double slip_softness_m_per_Ns = 0.0;  // slip speed over friction impulse
  double drag_ratio = 0.0;              // motion resistance over load
};

// Finds the law of a contact from the rover's parameters and the soil.
class ContactLaws {
 public:
  ContactLaws(const RoverParams& params, const terrain::SoilParams& soil);

  // Returns the law of a contact whose impulses and slip are those of the last step. spin_rad_s is
  // the rate of the wheel; it has no effect for other parts.
  ContactLaw Of(const Part& part, const Contact& contact, double spin_rad_s) const;

  // The damping of every contact.
  double damping_Ns_m() const { return params_.damping_Ns_m; }

 private:
  ContactLaw OnSoil(const Contact& contact, double spin_rad_s) const;

  const RoverContactParams params_;
  const WheelSoil soil_;
  const double wheel_radius_m_;
  const double step_s_;
};

}  // namespace rockyard::rover
