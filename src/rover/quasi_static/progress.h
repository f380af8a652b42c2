// How far a rover with mass gets along its way while its wheels start and stop; QuasiStaticRover
// follows each stretch by it.
#pragma once

#include "rover/wheel_soil.h"

namespace rockyard::rover {

// Slip at which Coulomb friction has reached 0.7 of itself, in shares of the rim speed. It stands
// for a contact that holds, in balances (balance.cc) and in starts and stops alike.
inline constexpr double kRockCreep = 0.002;

// The wheels of a rover on one kind of ground as one wheel: what they do to the power of its
// motion. Speeds are those of the steady motion, in which the rover moves at the rates of a balance
// and its rims as fast as the drive asks: the same balance holds at every speed, as friction and
// soil know no time. All values but traction_N are means over the wheels, weighted by their
// traction.
struct WheelLump {
  double traction_N = 0.0;   // largest, of all wheels together
  double rim_m_s = 0.0;      // of the rims
  double along_m_s = 0.0;    // of the rover over the ground, along the wheels
  double across_m_s = 0.0;   // of the rover over the ground, across the wheels
  double shear_ratio = 0.0;  // u at a slip of 1 (wheel_soil.h); 0: Coulomb friction
};

// A steady motion: what wheels on soil and on rock pull, and how heavy the motion is. What the
// wheels pull against (weight, motion resistance, scraping parts) takes the same power per way at
// every speed.
struct SteadyDrive {
  WheelLump soil;
  WheelLump rock;
  double inertia_J = 0.0;  // twice the kinetic energy at full speed
};

// The speed of the rover along its way, q, while its rims turn at the share rho of their full
// speed:
//
//   I dq/dt = P(q, rho) - P(1, 1),   P = sum of F . v over the wheels,
//
// with the inertia I, F = T tau(u), u = (l / K) |s| / (rho r omega), along the slip velocity
// s = rho r omega - q v, and v of the steady motion. It is the balance that the multibody makes in
// every step, for the one coordinate that starts and stops; posture and loads are those of the
// steady motion. In steady motion q = rho = 1.
class Progress {
 public:
  // Lets the rover stand.
  void Stop() { speed_ = 0.0; }
  // Begins another motion, which keeps the share `kept` of the speed so far.
  void Begin(const SteadyDrive& drive, double kept);

  // Returns the way in the next `time_s`, in seconds at full speed, while the rims go from the
  // share rim_from of their full speed to the share rim_to.
  double Advance(double rim_from, double rim_to, double time_s);

  double speed() const { return speed_; }  // q

 private:
  // Power of one lump and its derivative by the speed q.
  struct Power {
    double value_W = 0.0;
    double slope_W = 0.0;
  };
  // dq/dt and its derivative by q.
  struct Rate {
    double value;
    double slope;
  };
  ShearShare ShareAt(const WheelLump& lump, double slip_m_s, double rim_m_s) const;
  Power PowerOf(const WheelLump& lump, double speed, double rim) const;
  Rate RateAt(double speed, double rim) const;
  double Step(double rim_from, double rim_to, double time_s);
  double Settle(double rim, double time_s);

  const ShareTable share_;
  SteadyDrive drive_;
  double balance_W_ = 0.0;  // P(1, 1): what the steady motion pulls against
  double decay_s_ = 0.0;    // time in which slip decays at full speed
  double speed_ = 0.0;
  // Of the last step: the change of the rims' share, and by how much more the speed changed.
  double last_rim_change_ = 0.0;
  double last_lag_ = 0.0;
};

}  // namespace rockyard::rover
