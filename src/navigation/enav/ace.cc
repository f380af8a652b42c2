#include "navigation/enav/ace.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "math/functions.h"

namespace rockyard::navigation {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double OrNone(double limit) { return limit > 0.0 ? limit : kInfinity; }

double Largest(const Interval& interval) {
  return std::max(std::abs(interval.low), std::abs(interval.high));
}

double Smallest(const Interval& interval) {
  if (interval.low <= 0.0 && interval.high >= 0.0) return 0.0;
  return std::min(std::abs(interval.low), std::abs(interval.high));
}

// Of a normal variable in [0, 1] of its bounds (Ghosh 2018 fig. 5, measured from the figure:
// +-0.003).
struct Normal {
  double mean;
  double deviation;
};
constexpr Normal kRockers[2] = {{0.462, 0.190}, {0.483, 0.171}};
constexpr Normal kBogies[2] = {{0.542, 0.196}, {0.540, 0.189}};
constexpr Normal kRoll{0.483, 0.172};
constexpr Normal kPitch{0.521, 0.133};

double Between(const Interval& bounds, double share) { return bounds.low + share * bounds.Width(); }

// The chance of a standard normal variable between a and b >= a, without cancellation in the tails.
double ChanceBetween(double a, double b) {
  if (a > 0.0) return ChanceBetween(-b, -a);
  const auto below = [](double z) { return 0.5 * math::Erfc(-z / std::numbers::sqrt2); };
  if (b <= 0.0) return below(b) - below(a);
  return 1.0 - below(a) - below(-b);
}

// The chance that a normal variable, truncated to `bounds`, lies outside of `limits`.
double ChanceOutside(const Interval& bounds, double mean, double deviation,
                     const Interval& limits) {
  if (limits.Holds(bounds.low) && limits.Holds(bounds.high)) return 0.0;
  if (bounds.high < limits.low || bounds.low > limits.high) return 1.0;
  const auto chance = [&](double low, double high) {
    return high > low ? ChanceBetween((low - mean) / deviation, (high - mean) / deviation) : 0.0;
  };
  const double outside = chance(bounds.low, std::min(limits.low, bounds.high)) +
                         chance(std::max(limits.high, bounds.low), bounds.high);
  return std::min(1.0, outside / chance(bounds.low, bounds.high));
}

double ChanceOutside(const Interval& bounds, const Normal& normal, double limit) {
  return ChanceOutside(bounds, Between(bounds, normal.mean), normal.deviation * bounds.Width(),
                       {-limit, limit});
}

// The chance of one event or another, of independent ones [30].
double Either(double p, double q) { return p + q - p * q; }

}  // namespace

Ace::Ace(const AceParams& params, const messages::RoverBelief& rover)
    : params_(params),
      rover_(rover),
      linkage_(rover),
      limits_{.clearance_m = params.min_clearance_share * rover.belly_clearance_m,
              .tilt_rad = OrNone(params.max_tilt_rad),
              .roll_rad = OrNone(params.max_roll_rad),
              .pitch_rad = OrNone(params.max_pitch_rad),
              .rocker_rad = params.stop_share * rover.max_rocker_rad,
              .bogie_rad = params.stop_share * rover.max_bogie_rad,
              .drop_m = OrNone(params.max_wheel_drop_radii * rover.drive.wheel_radius_m)},
      wheel_{params.wheel_box_diameters * rover.drive.wheel_radius_m,
             0.5 * params.wheel_box_widths * rover.wheel_width_m},
      belly_{0.5 * rover.suspension.belly_length_m, 0.5 * rover.suspension.belly_width_m} {}

AceVerdict Ace::Check(const HeightMap& map, const math::Pose2& pose) const {
  AceVerdict verdict;
  const auto fail = [&](AceFailure failure) {
    verdict.failure = failure;
    return verdict;
  };
  messages::PerWheel<Interval> ground_z_m;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    ground_z_m[i] = NoInterval();
    int cells = 0, seen = 0;
    map.VisitBox(pose, {rover_.drive.wheel_x_m[i], rover_.drive.wheel_y_m[i], 0.0}, wheel_.x_m,
                 wheel_.y_m, [&](const HeightCell* cell, double, double) {
                   ++cells;
                   if (cell == nullptr || !cell->seen()) return;
                   ++seen;
                   Include(-cell->Height_m(), ground_z_m[i]);
                 });
    if (seen == 0 || seen < params_.min_seen_share * cells) return fail(AceFailure::kUnseen);
    if (ground_z_m[i].Width() > limits_.drop_m) return fail(AceFailure::kWheelDrop);
  }
  const auto state = linkage_.Bound(ground_z_m);
  if (!state) return fail(AceFailure::kLinkage);
  verdict.state = *state;

  const Interval& roll = state->roll_rad;
  const Interval& pitch = state->pitch_rad;
  if (Largest(roll) >= 0.5 * std::numbers::pi || Largest(pitch) >= 0.5 * std::numbers::pi) {
    return fail(AceFailure::kLinkage);
  }
  const Interval tan_roll{math::Tan(roll.low), math::Tan(roll.high)};
  const Interval tan_pitch{math::Tan(pitch.low), math::Tan(pitch.high)};
  const double level_m =
      rover_.belly_clearance_m * std::sqrt(1.0 + Smallest(tan_pitch) * Smallest(tan_pitch) +
                                           Smallest(tan_roll) * Smallest(tan_roll));
  const double roll_deviation = kRoll.deviation * roll.Width();
  const double pitch_deviation = kPitch.deviation * pitch.Width();
  double clearance_risk = 0.0;
  int cells = 0, seen = 0;
  verdict.clearance_m = kInfinity;
  map.VisitBox(
      pose, {}, belly_.x_m, belly_.y_m, [&](const HeightCell* cell, double x_m, double y_m) {
        ++cells;
        if (cell == nullptr || !cell->seen()) return;
        ++seen;
        // In L, y to the right.
        const double x = linkage_.facing() * x_m;
        const double y = -y_m;
        const double above_m =
            -cell->Height_m() - state->origin_z_m.high;  // the origin over the cell
        const double lowest_m = std::max(-x * tan_pitch.low, -x * tan_pitch.high) +
                                std::max(y * tan_roll.low, y * tan_roll.high) - level_m;
        verdict.clearance_m = std::min(verdict.clearance_m, above_m - lowest_m);
        if (params_.risk == 0.0) return;
        // [32], linear in the angles: H + x pitch - y roll + c0 - z_o.
        const double mean_m = above_m + rover_.belly_clearance_m + x * Between(pitch, kPitch.mean) -
                              y * Between(roll, kRoll.mean);
        const double deviation_m = math::Hypot(x * pitch_deviation, y * roll_deviation);
        const double level_above_m = above_m + rover_.belly_clearance_m;
        const Interval bounds{level_above_m + std::min(x * pitch.low, x * pitch.high) -
                                  std::max(y * roll.low, y * roll.high),
                              level_above_m + std::max(x * pitch.low, x * pitch.high) -
                                  std::min(y * roll.low, y * roll.high)};
        clearance_risk = std::max(clearance_risk, ChanceOutside(bounds, mean_m, deviation_m,
                                                                {limits_.clearance_m, kInfinity}));
      });
  if (seen < params_.min_seen_share * cells) return fail(AceFailure::kUnseen);
  verdict.failure = Breaks(verdict);
  if (params_.risk == 0.0 || verdict.safe()) return verdict;
  verdict.risk = Either(RiskOfStates(*state), clearance_risk);
  verdict.failure = verdict.risk < params_.risk ? AceFailure::kNone : AceFailure::kRisk;
  return verdict;
}

// Returns the first limit that the bounds break.
AceFailure Ace::Breaks(const AceVerdict& verdict) const {
  const SuspensionState<Interval>& state = verdict.state;
  const double roll_rad = Largest(state.roll_rad);
  const double pitch_rad = Largest(state.pitch_rad);
  const double tilt_rad = math::Acos(math::Cos(roll_rad) * math::Cos(pitch_rad));
  if (tilt_rad > limits_.tilt_rad || roll_rad > limits_.roll_rad || pitch_rad > limits_.pitch_rad) {
    return AceFailure::kTilt;
  }
  if (Largest(state.rocker_rad) > limits_.rocker_rad) return AceFailure::kJoints;
  for (const Interval& bogie_rad : state.bogie_rad) {
    if (Largest(bogie_rad) > limits_.bogie_rad) return AceFailure::kJoints;
  }
  return verdict.clearance_m < limits_.clearance_m ? AceFailure::kClearance : AceFailure::kNone;
}

// Tilt is no state of p-ACE: roll and pitch are held to its limit, too.
double Ace::RiskOfStates(const SuspensionState<Interval>& state) const {
  const Interval right_rocker_rad{-state.rocker_rad.high, -state.rocker_rad.low};
  double risk = ChanceOutside(state.roll_rad, kRoll, std::min(limits_.roll_rad, limits_.tilt_rad));
  risk = Either(
      risk, ChanceOutside(state.pitch_rad, kPitch, std::min(limits_.pitch_rad, limits_.tilt_rad)));
  risk = Either(risk, ChanceOutside(state.rocker_rad, kRockers[0], limits_.rocker_rad));
  if (params_.both_rockers) {
    risk = Either(risk, ChanceOutside(right_rocker_rad, kRockers[1], limits_.rocker_rad));
  }
  for (std::size_t side = 0; side < 2; ++side) {
    risk = Either(risk, ChanceOutside(state.bogie_rad[side], kBogies[side], limits_.bogie_rad));
  }
  return risk;
}

}  // namespace rockyard::navigation
