// Parameters of ACE, the check of single poses (ace.h). No limit of the flight software is
// published: what is printed, and for which rover, stands in ace_params.cc. Lengths are told in
// sizes of the rover, so that one set serves rovers of any size. A default decides the records of
// scenarios that leave it out; a bound only refuses files.
#pragma once

#include <cstdint>

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::navigation {

struct AceParams {
  double min_clearance_share = 0.5;
  double max_tilt_rad = math::DegToRad(16.0);
  double max_roll_rad = 0.0;
  double max_pitch_rad = 0.0;
  double stop_share = 0.9;
  double max_wheel_drop_radii = 1.33;
  double wheel_box_diameters = 1.0;
  double wheel_box_widths = 1.2;
  double min_seen_share = 0.5;
  double risk = 0.0;
  bool both_rockers = true;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::navigation
