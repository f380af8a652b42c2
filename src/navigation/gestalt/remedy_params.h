// Parameters of what GESTALT does otherwise than its papers, each switched on by itself and off by
// default: remedies for what readings of the papers do badly. Meanings, units and origins stand in
// remedy_params.cc.
#pragma once

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::navigation {

// A rover that drives splines stops and turns in place, as one that drives arcs does.
struct StopToTurnParams {
  bool enabled = false;
  double saves_m = 0.5;
  double orbit_turn_rad = math::DegToRad(360.0);

  void Visit(core::FieldVisitor& v);
};

// A rover turns in place before it drives where its way leads behind it.
struct TurnFirstParams {
  bool enabled = false;
  double bearing_rad = math::DegToRad(75.0);

  void Visit(core::FieldVisitor& v);
};

struct GestaltRemedyParams {
  StopToTurnParams stop_to_turn;
  TurnFirstParams turn_first;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::navigation
