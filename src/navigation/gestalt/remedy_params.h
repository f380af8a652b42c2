// Parameters of what GESTALT does otherwise than its papers, each switched on by itself and off by
// default: remedies for what readings of the papers do badly. Meanings, units and origins stand in
// remedy_params.cc.
#pragma once

#include <array>
#include <string_view>

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

// What is remembered of a cell that was seen more than once.
enum class SeenAgain {
  kWorst,   // its highest cost: looks from nearby lower what was a step, as they add points of the
            // ground
  kLatest,  // what the map knew last
  kWorstWhileOpen,  // the worst; where that leaves no way to the goal, its geometric mean with the
                    // latest
};

// The cost of the way from a motion's end to the goal votes for it, in place of its direction.
struct CostToGoParams {
  bool enabled = false;
  double unseen_cost = 1.2;
  double rough_cost = 3.0;
  double blocked_cost = 50.0;
  double memory_m = 20.0;
  SeenAgain seen_again = SeenAgain::kWorstWhileOpen;
  double way_m = 1.5;
  double loss_m = 3.0;

  void Visit(core::FieldVisitor& v);
};

// A rover that drifts sideways judges its motions along the way that it makes good on them, and so
// heads uphill of its goal.
struct AgainstDriftParams {
  bool enabled = false;
  double memory_m = 1.0;
  double max_angle_rad = math::DegToRad(30.0);

  void Visit(core::FieldVisitor& v);
};

struct GestaltRemedyParams {
  CostToGoParams cost_to_go;
  StopToTurnParams stop_to_turn;
  TurnFirstParams turn_first;
  AgainstDriftParams against_drift;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::navigation

template <>
struct rockyard::core::EnumNames<rockyard::navigation::SeenAgain> {
  static constexpr std::array<std::string_view, 3> kNames{"worst", "latest", "worst_while_open"};
};
