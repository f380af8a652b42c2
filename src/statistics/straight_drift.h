// How far dead reckoning along a straight line goes wrong, in closed forms.
//
// The state equations of Matthies 1995, section 5: steps of length s, each wrong by N(0, r s), and
// after each a turn wrong by N(0, q s), with the variances r of the distance and q of the heading a
// metre. Beside them a scale error N(0, c^2) that a run keeps. All are independent.
#pragma once

namespace rockyard::statistics {

struct StraightDrift {
  double step_m = 0.0;      // of the exact moments; a continuous walk has none
  double distance_m = 0.0;  // of the exact moments whole steps: the nearest number of them
  double distance_variance_m2_per_m = 0.0;
  double heading_variance_deg2_per_m = 0.0;
  double scale_deviation = 0.0;
};

// Of the end of a drive, believed less true; the means of the two that are missing are 0.
struct DriftMoments {
  double along_bias_m = 0.0;
  double along_m = 0.0;  // standard deviations
  double across_m = 0.0;
  double heading_deg = 0.0;
};

// Returns the exact moments of the walk in steps, to every order in the heading: it may turn right
// round. heading_deg is that of the sum of all turns, which does not wrap. Cost: the number of
// steps. Needs step_m > 0 and at least one step.
DriftMoments ExactMoments(const StraightDrift& drift);

// Returns the moments of a walk without steps, to second order in the heading's error: good to some
// per cent while q L is below 0.1 rad2 (330 deg2).
DriftMoments SecondOrderMoments(const StraightDrift& drift);

}  // namespace rockyard::statistics
