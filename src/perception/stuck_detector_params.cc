#include "perception/stuck_detector_params.h"

namespace rockyard::perception {
namespace {

using core::Assumed;

void VisitTurn(StuckDetectorParams& p, core::FieldVisitor& v) {
  v.Angle(
      "min_told_turn_deg", p.min_told_turn_rad,
      Assumed("turn that the wheels were told in a window from which the gyro's is held against it",
              "two turn increments of the behaviour controller: well above the gyro's noise and "
              "what one rock turns a rover by",
              {1.0, 3600.0}, {10.0, 60.0}));
  v.Real("min_turn_share", p.min_turn_share,
         Assumed("share of the told turn, the way it was told, below which the rover does not turn",
                 "wheels that slip on slopes and rocks lose half of a turn, not four fifths",
                 {0.0, 1.0}, {0.05, 0.5}));
}

void VisitStrain(StuckDetectorParams& p, core::FieldVisitor& v) {
  v.Real("strain_current_A", p.strain_current_A,
         Assumed("current from which a drive motor strains",
                 "0.6 N m at the wheel: half way between rolling on level sand (0.03 A) and "
                 "spinning under a sixth of the weight (0.08 A)",
                 {1e-6, 1000.0}, {0.04, 0.13}));
  v.Integer("strained_wheels", p.strained_wheels,
            Assumed("drive motors that have to strain in the same window",
                    "most of six: one or two strain whenever they climb a rock", {1, 6}, {2, 6}));
  v.Real("strain_share", p.strain_share,
         Assumed("share of the window for which each of them has to strain",
                 "nearly all of it: climbing takes a wheel's diameter, about a second", {0.01, 1.0},
                 {0.5, 1.0}));
}

}  // namespace

void StuckDetectorParams::Visit(core::FieldVisitor& v) {
  v.Real("window_s", window_s,
         Assumed("commanded motion after which the rover asks whether it gets on; looks, stops and "
                 "steering at rest do not count",
                 "half of referee.stall_window_s, so that the rover notices before an operator who "
                 "sees it calls it stuck",
                 {0.5, 3600.0}, {2.0, 20.0}));
  VisitTurn(*this, v);
  VisitStrain(*this, v);
}

}  // namespace rockyard::perception
