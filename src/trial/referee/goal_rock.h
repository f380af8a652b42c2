// Whether a rover has found the rock at its goal.
#pragma once

#include <optional>

#include "math/pose.h"
#include "rover/rover_geometry_params.h"
#include "terrain/terrain.h"
#include "trial/counters/hazard_watch.h"
#include "trial/drive_params.h"
#include "truth/rover_state.h"

namespace rockyard::trial {

// How the rock was found.
enum class RockSign {
  kNone = 0,     // it was not
  kArray = 1,    // a hazard was believed while its outline was within the array's reach
  kContact = 2,  // the rover's body, which has its contact switches, touched it
};

// Sees the truth; the drive ends by what it says, and on-board code never knows. Records hold the
// numbers of RockSign.
class GoalRock {
 public:
  // `rock` is the index of a rock of `terrain`, which outlives this; `view` is what the array
  // covers.
  GoalRock(const terrain::Terrain& terrain, int rock, const Zone& view,
           const rover::RoverGeometryParams& rover);

  // A hazard is believed that was seen from there.
  void OnBelieved(const math::Transform& X_WR);
  // Once a control tick.
  void Observe(const truth::RoverState& state);

  RockSign sign() const { return sign_; }
  bool found() const { return sign_ != RockSign::kNone; }

  // From the rover's footprint, as seen from above, to the rock's outline; 0 where they meet.
  double Distance_m(const math::Transform& X_WR) const;
  // From the middle of the rover's front to the rock's outline, which is round; 0 inside of it.
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

// The rock at the goal of a drive that has one.
std::optional<GoalRock> GoalRockOf(const DriveParams& drive, const terrain::Terrain& terrain);

}  // namespace rockyard::trial
