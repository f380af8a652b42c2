// What GESTALT remembers of the hazards that it felt on its way. The cycle tells it of them, and
// asks it when it votes. Records depend on where marks lie and which arcs are vetoed, not on the
// order in which they were felt.
#pragma once

#include <vector>

#include "messages/estimates.h"
#include "navigation/gestalt/map.h"
#include "navigation/gestalt/votes.h"
#include "navigation/navigator.h"

namespace rockyard::navigation {

// Places of felt hazards, and motions on which one was felt. No look would find these hazards
// again, as no camera has seen them. Invariant: places live until the next progress, whatever
// happens to the map, and are marked in it whenever it is made anew; vetoes live until a manoeuvre
// ends as it was meant to.
class FeltHazards {
 public:
  explicit FeltHazards(const GestaltParams& params)
      : rover_(params.map.rover), drive_(params.drive) {}

  // Notes the place of what the rover feels during the motion: of a contact at the front, of any
  // other hazard at the end that leads, both half a width aside if the sensor names a side; of a
  // touch behind while driving backward at the rear.
  void Feel(const NavigatorInput& input, const messages::MotionCommand& motion, GestaltMap& map);

  // Follows a jump of the estimate: the places keep their distance and bearing from the rover. They
  // are marked in the map, which must have its window around `after`.
  void Move(const messages::PoseEstimate& before, const messages::PoseEstimate& after,
            GestaltMap& map);

  // Sets the mark `vetoed` of every arc.
  void MarkVetoes(MotionVotes& votes) const;

  void ForgetPlaces() { places_O_.clear(); }
  void ForgetVetoes() { vetoed_.clear(); }

 private:
  void Mark(const math::Pose2& place_O, GestaltMap& map) const;

  GestaltRoverParams rover_;
  GestaltDriveParams drive_;
  std::vector<math::Pose2> places_O_;
  std::vector<messages::MotionCommand> vetoed_;
};

}  // namespace rockyard::navigation
