#include "navigation/gestalt/patience.h"

#include <cmath>
#include <numbers>

#include "math/angles.h"
#include "navigation/gestalt/votes.h"

namespace rockyard::navigation {
namespace {

// Angles that add up to a full turn may miss it by rounding.
constexpr double kRounding_rad = 1e-9;

}  // namespace

Progress::Cycle Progress::BeginCycle(double goal_distance_m) {
  if (goal_distance_m > best_m_ - params_.progress_m) {
    return ++fruitless_cycles_ <= params_.max_fruitless_cycles ? Cycle::kGoesOn : Cycle::kGivesUp;
  }
  const bool first = !std::isfinite(best_m_);
  best_m_ = goal_distance_m;
  fruitless_cycles_ = 0;
  turned_rad_ = 0.0;
  if (first) return Cycle::kGoesOn;
  felt_hazards_ = 0;
  return Cycle::kGains;
}

void Progress::CountTurn(double heading_rad) {
  if (heading_rad_) turned_rad_ += std::abs(math::WrapAngle(heading_rad - *heading_rad_));
  heading_rad_ = heading_rad;
}

void Progress::Rest() {
  turned_rad_ = 0.0;
  heading_rad_.reset();
}

void Progress::Restart() {
  // The next cycle is a first one then, from which fruitless ones count anew.
  best_m_ = std::numeric_limits<double>::infinity();
  felt_hazards_ = 0;
}

Search::Search(const GestaltParams& params)
    : search_turn_rad_(params.drive.search_turn_rad),
      step_rad_(params.arcs.point_turn_amount_rad) {}

messages::MotionVote& Search::NextTurn(MotionVotes& votes, double goal_bearing_rad) const {
  return side_ == 0 ? *ChoosePointTurn(votes, goal_bearing_rad)
                    : *PointTurnTo(votes, side_, step_rad_);
}

bool Search::HasTurnedAround() const { return turned_rad_ >= search_turn_rad_ - kRounding_rad; }

void Search::Count(double turned_rad) { turned_rad_ += std::abs(turned_rad); }

void Search::Feel(int side) {
  (side > 0 ? felt_left_ : felt_right_) = true;
  KeepTo(-side);
}

double Search::Round_rad(double turn_rad) const {
  const bool left = turn_rad > 0.0;
  if (!(left ? felt_left_ : felt_right_)) return turn_rad;
  if (left ? felt_right_ : felt_left_) return 0.0;
  return turn_rad - std::copysign(2.0 * std::numbers::pi, turn_rad);
}

void Search::ForgetGround() {
  turned_rad_ = 0.0;
  felt_left_ = felt_right_ = false;
}

void Search::Restart() {
  ForgetGround();
  side_ = 0;
}

}  // namespace rockyard::navigation
