// Whether a rover has found the rock at its goal: the observer of a drive asks it for the referee
// and the record, the world for what the tracker recognizes.
#pragma once

#include <optional>

#include "math/pose.h"
#include "rover/rover_geometry_params.h"
#include "terrain/terrain.h"
#include "trial/counters/hazard_watch.h"
#include "trial/drive_params.h"
#include "truth/rover_state.h"

namespace rockyard::trial {

// How the rock was found. Must stay: records hold these numbers (goal_rock_sign).
enum class RockSign {
  kNone = 0,     // it was not
  kArray = 1,    // a hazard was believed while its outline was within the array's reach
  kContact = 2,  // the rover's body, which has its contact switches, touched it
};

// The goal's rock, as those see it who may see the truth: the drive ends when it is found, and
// on-board code never knows.
class GoalRock {
 public:
  // `rock` is the index of a rock of `terrain`, which outlives this; `view` is what the array
  // covers.
  GoalRock(const terrain::Terrain& terrain, int rock, const Zone& view,
           const rover::RoverGeometryParams& rover);

  // Takes that a hazard is believed which was seen from X_WR.
  void OnBelieved(const math::Transform& X_WR);
  // Takes the state after a control tick.
  void Observe(const truth::RoverState& state);

  RockSign sign() const { return sign_; }
  bool found() const { return sign_ != RockSign::kNone; }

  // Returns the distance of the rover's footprint from the rock's outline, both as seen from above;
  // 0 where they meet.
  double Distance_m(const math::Transform& X_WR) const;
  // Returns the distance of the middle of the rover's front from the rock's outline; 0 inside of
  // it.
  double FrontDistance_m(const math::Transform& X_WR) const;

  math::Vector3 center_W() const { return rock().center_W; }

 private:
  const terrain::Rock& rock() const { return terrain_.rocks()[static_cast<std::size_t>(index_)]; }

  const terrain::Terrain& terrain_;
  int index_;
  Zone view_;
  Zone footprint_;
  RockSign sign_ = RockSign::kNone;
};

// Returns the rock at the goal of a drive, where there is one.
std::optional<GoalRock> GoalRockOf(const DriveParams& drive, const terrain::Terrain& terrain);

}  // namespace rockyard::trial
