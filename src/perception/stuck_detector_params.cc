#include "perception/stuck_detector_params.h"

namespace rockyard::perception {
namespace {

using core::Origin;

void VisitTurn(StuckDetectorParams& p, core::FieldVisitor& v) {
  v.Angle("min_told_turn_deg", p.min_told_turn_rad,
          {.doc = "turn that the wheels were told in a window from which the gyro's is held "
                  "against it",
           .min = 1.0,
           .max = 3600.0,
           .origin = Origin::kAssumed,
           .source = "two turn increments of the behaviour controller: well above the gyro's noise "
                     "and what one rock turns a rover by",
           .study_low = 10.0,
           .study_high = 60.0});
  v.Real("min_turn_share", p.min_turn_share,
         {.doc = "share of the told turn, the way it was told, below which the rover does not turn",
          .min = 0.0,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "wheels that slip on slopes and rocks lose half of a turn, not four fifths",
          .study_low = 0.05,
          .study_high = 0.5});
}

void VisitStrain(StuckDetectorParams& p, core::FieldVisitor& v) {
  v.Real("strain_current_A", p.strain_current_A,
         {.doc = "current from which a drive motor strains",
          .min = 1e-6,
          .max = 1000.0,
          .origin = Origin::kAssumed,
          .source = "0.6 N m at the wheel: half way between rolling on level sand (0.03 A) and "
                    "spinning under a sixth of the weight (0.08 A)",
          .study_low = 0.04,
          .study_high = 0.13});
  v.Integer("strained_wheels", p.strained_wheels,
            {.doc = "drive motors that have to strain in the same window",
             .min = 1,
             .max = 6,
             .origin = Origin::kAssumed,
             .source = "most of six: one or two strain whenever they climb a rock",
             .study_low = 2,
             .study_high = 6});
  v.Real("strain_share", p.strain_share,
         {.doc = "share of the window for which each of them has to strain",
          .min = 0.01,
          .max = 1.0,
          .origin = Origin::kAssumed,
          .source = "nearly all of it: climbing takes a wheel's diameter, about a second",
          .study_low = 0.5,
          .study_high = 1.0});
}

}  // namespace

void StuckDetectorParams::Visit(core::FieldVisitor& v) {
  v.Real("window_s", window_s,
         {.doc = "commanded motion after which the rover asks whether it gets on; looks, stops and "
                 "steering at rest do not count",
          .min = 0.5,
          .max = 3600.0,
          .origin = Origin::kAssumed,
          .source = "half of referee.stall_window_s, so that the rover notices before an operator "
                    "who sees it calls it stuck",
          .study_low = 2.0,
          .study_high = 20.0});
  VisitTurn(*this, v);
  VisitStrain(*this, v);
}

}  // namespace rockyard::perception
