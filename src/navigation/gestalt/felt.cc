#include "navigation/gestalt/felt.h"

#include <algorithm>

#include "navigation/gestalt/curvature_law.h"

namespace rockyard::navigation {
namespace {

using messages::HazardSide;
using messages::MotionCommand;
using messages::PoseEstimate;

// Returns the side that a hazard lies on: +1 left, -1 right, 0 ahead.
double Aside(const messages::VehicleHazard& hazard) {
  if (hazard.side == HazardSide::kLeft) return 1.0;
  return hazard.side == HazardSide::kRight ? -1.0 : 0.0;
}

}  // namespace

void FeltHazards::Feel(const NavigatorInput& input, const MotionCommand& motion, GestaltMap& map) {
  if (drive_.veto_felt) vetoed_.push_back(motion);
  const auto add = [&](int end, double aside) {
    // In R: half a vehicle to the end that leads, half a width aside.
    const math::Pose2 place_R{0.5 * end * rover_.length_m, 0.5 * aside * rover_.width_m, 0.0};
    places_O_.push_back(Planar(input.estimate) * place_R);
    Mark(places_O_.back(), map);
  };
  if (input.vehicle_hazard != nullptr) {
    const bool contact = input.vehicle_hazard->kind == messages::VehicleHazardKind::kContact;
    add(contact ? 1 : motion.direction, Aside(*input.vehicle_hazard));
  }
  if (motion.direction < 0 && input.touches_behind) add(-1, 0.0);
}

void FeltHazards::Move(const PoseEstimate& before, const PoseEstimate& after, GestaltMap& map) {
  for (math::Pose2& place_O : places_O_) {
    place_O = math::Carried(Planar(after), Planar(before), place_O);
    Mark(place_O, map);
  }
}

void FeltHazards::MarkVetoes(MotionVotes& votes) const {
  for (auto* row : {&votes.forward, &votes.backward}) {
    for (messages::MotionVote& vote : *row) {
      // Compares bits: an arc that is driven is a copy of its candidate, which is made once.
      vote.vetoed = std::any_of(vetoed_.begin(), vetoed_.end(), [&](const MotionCommand& felt_on) {
        return felt_on.direction == vote.motion.direction &&
               felt_on.curvature_per_m == vote.motion.curvature_per_m;
      });
    }
  }
}

void FeltHazards::Mark(const math::Pose2& place_O, GestaltMap& map) const {
  map.MarkObstacle(place_O.x_m, place_O.y_m, drive_.felt_radius_m);
}

}  // namespace rockyard::navigation
