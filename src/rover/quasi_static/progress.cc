#include "rover/quasi_static/progress.h"

#include <algorithm>
#include <cmath>

#include "math/functions.h"

namespace rockyard::rover {
namespace {

// Longest step of the integration, s: about the time in which traction answers to slip at 15 cm/s.
constexpr double kStep_s = 1.0 / 80.0;
// Difference of the speed q from the rims' share below which the motion is steady.
constexpr double kSteady = 1e-3;
// Difference, over the rims' share, below which slip decays as in the linear law.
constexpr double kNearlySteady = 0.03;
// A rover that gets on by less than this share of its rims' speed has no speed to gain.
constexpr double kStuck = 0.02;
// Error of the speed of a step; last change of Newton's method, which leaves an error of its
// square; most iterations.
constexpr double kExact = 1e-5;
constexpr double kLastChange = 2e-3;
constexpr int kIterations = 12;
// A rover that is drawn downhill does not run this many times faster than steadily.
constexpr double kFastest = 3.0;

// Returns at which share of a step of z decay times forces are taken; must be the theta of
// ContactLaws::StepOfSlip (multibody/contact_law.cc).
double Theta(double z) { return std::isfinite(z) ? (z + 3.0) / (z + 6.0) : 1.0; }

}  // namespace

// Returns tau at a slip speed and its derivative by that speed, s/m; must be the laws of
// QuasiStaticBalance::TractionOf.
ShearShare Progress::ShareAt(const WheelLump& lump, double slip_m_s, double rim_m_s) const {
  // A braked wheel has all its traction at any slip.
  if (rim_m_s <= 0.0) return {1.0, 0.0};
  if (lump.shear_ratio > 0.0) {
    const ShearShare share = share_.At(lump.shear_ratio * slip_m_s / rim_m_s);
    return {share.value, share.slope * lump.shear_ratio / rim_m_s};
  }
  const double creep_m_s = kRockCreep * rim_m_s;
  const double root = std::sqrt(slip_m_s * slip_m_s + creep_m_s * creep_m_s);
  return {slip_m_s / root, creep_m_s * creep_m_s / (root * root * root)};
}

Progress::Power Progress::PowerOf(const WheelLump& lump, double speed, double rim) const {
  if (lump.traction_N == 0.0) return {};
  const double along = rim * lump.rim_m_s - speed * lump.along_m_s;
  const double across = -speed * lump.across_m_s;
  const double slip_m_s = std::sqrt(along * along + across * across);
  const ShearShare share = ShareAt(lump, slip_m_s, rim * lump.rim_m_s);
  const double v2 = lump.along_m_s * lump.along_m_s + lump.across_m_s * lump.across_m_s;
  // Without slip F = T tau'(0) s.
  if (slip_m_s == 0.0) return {0.0, -lump.traction_N * share.slope * v2};
  // F . v = T tau (s . v) / |s|; by q, s changes by -v and |s| by -(s . v) / |s|.
  const double toward = along * lump.along_m_s + across * lump.across_m_s;
  const double cosine = toward / slip_m_s;
  return {lump.traction_N * share.value * cosine,
          -lump.traction_N *
              (share.slope * cosine * cosine + share.value * (v2 - cosine * cosine) / slip_m_s)};
}

void Progress::Begin(const SteadyDrive& drive, double kept) {
  drive_ = drive;
  speed_ *= kept;
  const Power soil = PowerOf(drive_.soil, 1.0, 1.0);
  const Power rock = PowerOf(drive_.rock, 1.0, 1.0);
  balance_W_ = soil.value_W + rock.value_W;
  decay_s_ = -drive_.inertia_J / (soil.slope_W + rock.slope_W);
}

Progress::Rate Progress::RateAt(double speed, double rim) const {
  const Power soil = PowerOf(drive_.soil, speed, rim);
  const Power rock = PowerOf(drive_.rock, speed, rim);
  return {(soil.value_W + rock.value_W - balance_W_) / drive_.inertia_J,
          (soil.slope_W + rock.slope_W) / drive_.inertia_J};
}

// Solves q_1 = q_0 + h dq/dt, with dq/dt at theta q_1 + (1 - theta) q_0 and the rims of that
// moment. The right side falls with q_1, so that Newton's method stays within a bracket that
// shrinks.
double Progress::Step(double rim_from, double rim_to, double time_s) {
  const double before = speed_;
  const double mean_rim = 0.5 * (rim_from + rim_to);
  // The slower the rims turn, the faster traction answers.
  const double theta = mean_rim > 0.0 ? Theta(time_s / (mean_rim * decay_s_)) : 1.0;
  const double rim = theta * rim_to + (1.0 - theta) * rim_from;
  double low = 0.0;
  double high = std::max({before, rim_from, rim_to}) * kFastest + kSteady;
  const double change = rim_to - rim_from;
  // On soil, rims that go on as before let the speed do so, too. On rock friction bends so sharply
  // that a small change of Newton's method near such a guess tells nothing.
  const bool same = std::abs(change - last_rim_change_) < kExact && drive_.rock.traction_N == 0.0;
  const double guess = before + change + (same ? last_lag_ : 0.0);
  double next = std::clamp(guess, low, high);
  for (int i = 0; i < kIterations; ++i) {
    const Rate rate = RateAt(theta * next + (1.0 - theta) * before, rim);
    const double lack = before + time_s * rate.value - next;
    (lack > 0.0 ? low : high) = next;
    const double newton = next + lack / (1.0 - theta * time_s * rate.slope);
    const bool inside = newton > low && newton < high;
    const double moved = inside ? std::abs(newton - next) : high - low;
    next = inside ? newton : 0.5 * (low + high);
    // What Newton's method leaves is the square of its last change.
    if (moved < (inside ? kLastChange : kExact)) break;
  }
  speed_ = next < kExact ? 0.0 : next;
  last_rim_change_ = change;
  last_lag_ = speed_ - before - change;
  if (speed_ > 0.0 || before == 0.0) return 0.5 * (before + speed_) * time_s;
  // The rover comes to rest within the step: its way is half of its speed times the time to rest.
  const double slowing = -RateAt(0.5 * before, rim).value;
  return 0.5 * before * (slowing * time_s > before ? before / slowing : time_s);
}

// Follows q = rho + (q_0 - rho) e^(-t/T), whose integral is the way. T goes with the speed of the
// rims.
double Progress::Settle(double rim, double time_s) {
  const double decay_s = rim * decay_s_;
  const double before = speed_ - rim;
  const double after = before * math::Exp(-time_s / decay_s);
  speed_ = rim + after;
  return rim * time_s + decay_s * (before - after);
}

double Progress::Advance(double rim_from, double rim_to, double time_s) {
  const double mean = 0.5 * (rim_from + rim_to);
  const WheelLump& soil = drive_.soil;
  const WheelLump& rock = drive_.rock;
  // Sums over both lumps of their mean speeds times their traction.
  const double along = soil.traction_N * soil.along_m_s + rock.traction_N * rock.along_m_s;
  const double rims = soil.traction_N * soil.rim_m_s + rock.traction_N * rock.rim_m_s;
  const bool stuck = std::abs(along) <= kStuck * rims;
  const bool steady = rim_from == rim_to && std::abs(speed_ - rim_to) < kSteady;
  if (stuck || steady || drive_.inertia_J <= 0.0) {
    speed_ = rim_to;
    return mean * time_s;
  }
  if (rim_from == rim_to && std::abs(speed_ - rim_to) < kNearlySteady * rim_to) {
    return Settle(rim_to, time_s);
  }
  const int steps = static_cast<int>(std::ceil(time_s / kStep_s));
  const double change = (rim_to - rim_from) / steps;
  double way_s = 0.0;
  for (int i = 0; i < steps; ++i) {
    way_s += Step(rim_from + i * change, rim_from + (i + 1) * change, time_s / steps);
  }
  return way_s;
}

}  // namespace rockyard::rover
