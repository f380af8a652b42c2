#include "navigation/gestalt/choice.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "core/check.h"

namespace rockyard::navigation {
namespace {

using messages::MotionVote;

// A row whose arcs compete. Rows are listed from the most preferred one on.
using Rows = std::vector<std::span<MotionVote>>;

bool BackwardArcsCompete(const MotionVotes& votes, const GestaltParams& params) {
  // Step 7 names the highest vote of all arcs; min-fwd-threshold of table 1 suggests that forward
  // ones go first.
  switch (params.drive.backward_arcs) {
    case BackwardArcs::kBelowThreshold:
      return BestVote(votes.forward) < params.votes.min_fwd_threshold;
    case BackwardArcs::kAlways:
      return true;
    case BackwardArcs::kLastResort:
      return BestVote(votes.forward) < params.votes.min_vote_goodness;
  }
  return true;
}

Rows CompetingRows(MotionVotes& votes, const GestaltParams& params) {
  Rows rows{votes.forward};
  if (BackwardArcsCompete(votes, params)) rows.push_back(votes.backward);
  return rows;
}

// A merged vote can be high on ground that must not be driven: the hazard vote has a bound of its
// own.
bool MayBeDriven(const MotionVote& vote, const GestaltParams& params) {
  return vote.hazard > params.drive.min_drive_goodness && !vote.vetoed;
}

// Distance of an arc from the middle of its row, in arcs.
double FromStraight(std::size_t index, std::size_t count) {
  return std::abs(static_cast<double>(index) - 0.5 * static_cast<double>(count - 1));
}

// The middle of [first, end). An even set has two; arcs run from right to left, so the first is the
// right one.
std::size_t Middle(std::span<const MotionVote> row, std::size_t first, std::size_t end) {
  const std::size_t right = (first + end - 1) / 2;
  const std::size_t left = (first + end) / 2;
  const auto worth = [&row](std::size_t i) {
    return std::make_tuple(row[i].waypoint, -FromStraight(i, row.size()));
  };
  return worth(left) > worth(right) ? left : right;
}

// A set of adjacent arcs that share the highest vote.
struct Peak {
  MotionVote* middle = nullptr;
  std::size_t length = 0;
  double from_straight = 0.0;

  bool IsBetterThan(const Peak& other) const {
    if (other.middle == nullptr) return true;
    return std::make_tuple(length, middle->waypoint, middle->motion.direction, -from_straight) >
           std::make_tuple(other.length, other.middle->waypoint, other.middle->motion.direction,
                           -other.from_straight);
  }
};

// The longest set of adjacent arcs with the highest vote; an arc that may not be driven ends a set.
Peak BestPeak(std::span<MotionVote> row, double highest, const GestaltParams& params) {
  const auto shares = [&](std::size_t i) {
    return i < row.size() && row[i].merged == highest && MayBeDriven(row[i], params);
  };
  Peak best;
  for (std::size_t first = 0; first < row.size(); ++first) {
    if (!shares(first)) continue;
    std::size_t end = first + 1;
    // [first, end) is a set of adjacent arcs with the highest vote.
    while (shares(end)) ++end;
    const std::size_t middle = Middle(row, first, end);
    const Peak peak{&row[middle], end - first, FromStraight(middle, row.size())};
    if (peak.IsBetterThan(best)) best = peak;
    first = end;
  }
  return best;
}

}  // namespace

MotionVote* ChooseArc(MotionVotes& votes, const GestaltParams& params) {
  const Rows rows = CompetingRows(votes, params);
  double highest = -1.0;
  for (const auto row : rows) {
    for (const MotionVote& vote : row) {
      // Step 7: the highest merged vote of the arcs that compete and may be driven.
      if (MayBeDriven(vote, params)) highest = std::max(highest, vote.merged);
    }
  }
  Peak best;
  for (const auto row : rows) {
    const Peak peak = BestPeak(row, highest, params);
    if (peak.middle != nullptr && peak.IsBetterThan(best)) best = peak;
  }
  return best.middle;
}

// When a point turn is preferred, by the reading that the parameters choose.
bool TurnsInPlace(const MotionVote& turn, const MotionVote* arc, const GestaltParams& params) {
  switch (params.drive.point_turns) {
    case PointTurns::kNever:
      return false;
    case PointTurns::kNothingSafe:
      return arc == nullptr;
    case PointTurns::kBelowMinVote:
      return arc == nullptr || arc->merged < params.votes.min_vote_goodness;
    case PointTurns::kCandidates:
      return arc == nullptr || turn.merged > arc->merged + params.drive.point_turn_margin;
  }
  return false;
}

MotionVote* ChoosePointTurn(MotionVotes& votes, double goal_bearing_rad) {
  EXPECT(!votes.point_turns.empty());
  const int goal_side = goal_bearing_rad < 0.0 ? -1 : +1;
  const auto worth = [&](const MotionVote& turn) {
    return std::make_tuple(turn.merged, turn.motion.direction == goal_side,
                           -std::abs(turn.turn_rad));
  };
  return &*std::max_element(
      votes.point_turns.begin(), votes.point_turns.end(),
      [&](const MotionVote& a, const MotionVote& b) { return worth(a) < worth(b); });
}

MotionVote* PointTurnTo(MotionVotes& votes, int side, double amount_rad) {
  MotionVote* nearest = nullptr;
  const auto misses_by = [&](const MotionVote& turn) {
    return std::abs(side * turn.turn_rad - amount_rad);
  };
  for (MotionVote& turn : votes.point_turns) {
    if (turn.motion.direction != side) continue;
    if (nearest == nullptr || misses_by(turn) < misses_by(*nearest)) nearest = &turn;
  }
  EXPECT(nearest != nullptr);
  return nearest;
}

double BestVote(std::span<const MotionVote> row) {
  double best = 0.0;
  for (const MotionVote& vote : row) best = std::max(best, vote.merged);
  return best;
}

void MarkChoice(MotionVotes& votes, MotionVote& chosen, const GestaltParams& params) {
  Rows rows{votes.point_turns};
  const bool arc = chosen.motion.kind == messages::MotionKind::kArc;
  if (arc) rows = CompetingRows(votes, params);
  for (const auto row : rows) {
    for (MotionVote& vote : row) {
      // For the view: figure 3 of the paper underlines all candidates of the highest vote.
      vote.best = vote.merged == chosen.merged && (!arc || MayBeDriven(vote, params));
    }
  }
  chosen.chosen = true;
}

}  // namespace rockyard::navigation
