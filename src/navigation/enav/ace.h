// ACE, approximate clearance evaluation (Otsu et al. 2019, arXiv:1808.00031), and p-ACE (Ghosh,
// Otsu and Ono 2018): whether a rover may stand at a pose, by the heights of a map, without letting
// it settle there. Written from p-ACE's paper, which restates ACE, and from what others report of
// ACE's; brackets are the former's equations. What neither prints is a parameter.
//
// A wheel meets the ground somewhere in its box. The highest and the lowest cell of each box bound
// attitude and joints (linkage.h), and these, with the cells under the belly, its clearance:
//   f(x, y) = -x tan(pitch) + y tan(roll) - c0 sqrt(1 + tan^2(pitch) + tan^2(roll))      [23]
//   clearance = min over the belly of H(x, y) - f(x, y) - z_o                             [24]
// with H the ground, z down. Which roll and pitch go in is not printed: here, for each cell, those
// within the bounds for which the first two terms are largest, and the smallest root.
//
// p-ACE takes each state for normal within its bounds, with the means and deviations that figure 5
// shows for Rocky 8, and truncates it there: untruncated, a risk of 1e-8 would be stricter than
// ACE, and figure 9 shows it laxer. So a pose that ACE passes has no risk.
#pragma once

#include <cstdint>

#include "messages/calibration.h"
#include "navigation/enav/ace_params.h"
#include "navigation/enav/height_map.h"
#include "navigation/enav/linkage.h"

namespace rockyard::navigation {

// Why a pose fails: the first of these that does.
enum class AceFailure { kNone, kUnseen, kWheelDrop, kLinkage, kTilt, kJoints, kClearance, kRisk };

// What ACE says of a pose.
struct AceVerdict {
  AceFailure failure = AceFailure::kNone;
  // Of the state, in the frame of linkage.h; zeros where kUnseen, kWheelDrop or kLinkage fail.
  SuspensionState<Interval> state;
  double clearance_m = 0.0;  // the least
  double risk = 0.0;         // p-ACE's chance that a limit is broken; 0 where ACE passes

  bool safe() const { return failure == AceFailure::kNone; }
};

class Ace {
 public:
  // `rover` as AceLinkage takes it.
  Ace(const AceParams& params, const messages::RoverBelief& rover);

  // Returns whether the rover may stand at the pose, in the map's frame. Cost: about the cells
  // under six boxes and the belly, some 10 us at 10 cm.
  AceVerdict Check(const HeightMap& map, const math::Pose2& pose) const;

  const AceLinkage& linkage() const { return linkage_; }

 private:
  struct Limits {
    double clearance_m, tilt_rad, roll_rad, pitch_rad, rocker_rad, bogie_rad, drop_m;
  };
  // Half sizes.
  struct Box {
    double x_m, y_m;
  };

  AceFailure Breaks(const AceVerdict& verdict) const;
  double RiskOfStates(const SuspensionState<Interval>& state) const;

  AceParams params_;
  messages::RoverBelief rover_;
  AceLinkage linkage_;
  Limits limits_;
  Box wheel_;
  Box belly_;
};

}  // namespace rockyard::navigation
