// Which of the voted motions is driven (Goldberg 2002, section 4, step 7).
#pragma once

#include <span>

#include "messages/navigation_view.h"
#include "navigation/gestalt/gestalt_params.h"
#include "navigation/gestalt/votes.h"

namespace rockyard::navigation {

// Returns, of the arcs that may be driven, the one with the highest merged vote; "in case of
// multiple peaks, the middle arc of the longest adjacent set". Null if none may be driven.
//
// An arc may be driven if its hazard vote is above min_drive_goodness and it is not vetoed, and
// backward arcs only as BackwardArcs says. What the paper leaves open: of the two middles of an
// even set, and of equally long sets, the one with the higher waypoint vote is taken, then forward
// before backward, then the one nearer to straight, then the right one. Mirrored votes so give the
// mirrored choice unless they are their own mirror image.
//
// The pointer is into `votes`. Cost: linear in the number of arcs.
messages::MotionVote* ChooseArc(MotionVotes& votes, const GestaltParams& params);

// Returns whether `turn` is to be made instead of driving `arc` (null: none), as PointTurns says.
bool TurnsInPlace(const messages::MotionVote& turn, const messages::MotionVote* arc,
                  const GestaltParams& params);

// Returns the best of the point turns; of equals one towards the goal, left for a goal straight
// ahead or behind, and of these the smallest.
messages::MotionVote* ChoosePointTurn(MotionVotes& votes, double goal_bearing_rad);

// Returns the point turn to that side (+1 left, -1 right) whose angle is nearest to `amount_rad`.
messages::MotionVote* PointTurnTo(MotionVotes& votes, int side, double amount_rad);

// Returns the highest merged vote of a row; 0 for an empty one.
double BestVote(std::span<const messages::MotionVote> row);

// Sets the marks of the view: `chosen`, and `best` on it and on all motions of its kind that could
// have been chosen and share its merged vote.
void MarkChoice(MotionVotes& votes, messages::MotionVote& chosen, const GestaltParams& params);

}  // namespace rockyard::navigation
