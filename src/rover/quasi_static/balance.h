// Balance of forces of a rover that moves without inertia; QuasiStaticRover solves one for each
// stretch of its way, and while it settles and stands. Records depend on the rates and loads that a
// solution starts from, as iterations end within a tolerance: a better start is a change of
// results, too.
#pragma once

#include <array>
#include <vector>

#include "messages/wheels.h"
#include "rover/quasi_static/contacts.h"
#include "rover/quasi_static/linkage.h"
#include "rover/quasi_static/progress.h"
#include "rover/rover_params.h"
#include "rover/wheel_soil.h"

namespace rockyard::rover {

// Which coordinates move. kSettling: only those that settle a rover which is held by hand at its
// place, on wheels without traction.
enum class Freedom { kAll, kSettling };

// Finds the rates w of the linkage at which all generalized forces balance at the end of a step h:
//
//   0 = Q_gravity + sum_c J_c' (N_c n_c + F_c) + stops - D w,
//   N_c = max(0, k_c (-gap_c - h n_c . J_c w - rest_c)),
//   F_c = T_c(N_c) share(|s_c| / |omega r|) s_c / |s_c|,   s_c = omega r a_c - (J_c w)_tangential.
//
// So every contact c is a spring along its normal n_c at its place at the end of the step (for a
// wheel on soil the spring is the tangent of the sinkage curve) and a traction along its slip
// velocity s_c, across the normal: Janosi and Hanamoto's share on soil (wheel_soil.h), and on rock
// Coulomb's law, smooth over slips of about kRockCreep (progress.h). All that lets a rover climb,
// slip, slide sideways, get blocked, lift on its belly or jam follows from this one balance; no
// rule tests for it. With T_c fixed, w minimizes a convex function (power of gravity, springs and
// dissipation; compare Pang and Tedrake 2021), which Newton's method with cuts of the step finds;
// T_c follows N_c from iteration to iteration.
//
// Where a motor's stall force S is less than F_c . a_c, the rate omega of its wheel falls until
// F_c . a_c = S; what S leaves of T_c acts across the wheel.
//
// D is 0.03 % of the rover's weight over its full speed: it says how fast a rover falls that
// nothing holds.
class QuasiStaticBalance {
 public:
  // `soil` is under all wheels; the table of its answers is made here, up to the rover's weight.
  QuasiStaticBalance(const RoverParams& params, const terrain::SoilParams& soil);

  // What is asked of the rover in one step.
  struct Drive {
    messages::PerWheel<double> rate_rad_s{};
    double step_s = 0.0;
    // Linkage and contacts are given as they are this long after the beginning of the step, at the
    // rates that the solution starts from: half a step, so that directions are those midway, or 0.
    double lead_s = 0.0;
    Freedom freedom = Freedom::kAll;
  };

  // Starts from `rates`, for example those of the last step, and leaves the solution there; it
  // leaves loads and sliding speeds in the contacts, and motor torques for MotorTorque_Nm. Returns
  // the number of iterations; kMaxIterations means that the tolerance was not met.
  int Solve(const Linkage& linkage, const Posture& posture, const Drive& drive,
            std::vector<RestingContact>& contacts, LinkageVector& rates);

  static constexpr int kMaxIterations = 20;

  // Returns what the wheels do in the last solution, whose rates are given. The caller sets the
  // inertia.
  SteadyDrive Steady(const LinkageVector& rates) const;

  // Returns the share of its commanded rate at which each wheel turns in the last solution: 1 but
  // for a motor that gives way because the ground holds more than its stall torque. Such a rim
  // falls back, no further than to rest.
  messages::PerWheel<double> TurnShares() const;

  // Lets the wheels turn by these ways of their rims while the rover makes `way` times the way that
  // it makes in the last solution: wheels on soil dig in, or come out again (SlipSinkage), which
  // the next solution sees. Where that takes less way than lies between two balances, wheels have
  // dug in for the slips of the last solution instead.
  void Dig(const messages::PerWheel<double>& rim_way_m, double way);
  // Returns whether digging in takes more way than lies between two balances.
  bool lags() const { return lags_; }
  // Returns whether the wheels have dug in for the slips of the last solution, as always without
  // slip sinkage: the next solution of the same drive on the same ground is then the same.
  bool HasDugIn() const;
  // Puts all wheels on fresh soil, for a rover that stands elsewhere.
  void ForgetHoles() { sinkage_.Clear(); }

  // Returns a motor's torque about the axle in the last solution, positive where it drives forward.
  double MotorTorque_Nm(std::size_t wheel) const;

 private:
  // Velocities of a contact's point along the directions of its row, m/s: normal, along the wheel,
  // across it, and for a wheel on soil along it at the axle, where the motion resistance acts.
  using Speeds = Eigen::Vector4d;
  static constexpr int kNormal = 0, kAlong = 1, kAcross = 2, kAxle = 3;
  // Force across the normal, and minus its derivative by the velocity of the contact's point.
  struct Tangential {
    double along_N = 0.0, across_N = 0.0;
    double k_aa = 0.0, k_ab = 0.0, k_bb = 0.0;
  };
  // A contact as the iterations see it: directions in the space of the rates.
  struct Row {
    SideVectors directions;
    Speeds speed;   // at the rates at hand
    Speeds change;  // by the last step of Newton's method, whole
    std::size_t side = 0;
    std::size_t wheel = 0;  // where the contact is a wheel's
    bool loaded = false;    // whether the contact bore load in the last balance
    bool soil = false;      // a wheel on soil
    double stiffness_N_m = 0.0;
    double gap_m = 0.0;          // at the beginning of the step
    double rest_m = 0.0;         // penetration without load
    double rim_m_s = 0.0;        // of the wheel against its axle, along
    double arm_m = 0.0;          // motor torque over force along
    double stall_N = 0.0;        // force along at the stall torque
    double reference_m_s = 0.0;  // slip is measured in shares of this
    // These are at the load that the traction is taken from.
    double max_N = 0.0;            // largest traction T_c
    bool motor_bound = false;      // the ground can hold more than the motor
    double shear_ratio = 0.0;      // 0: Coulomb
    double u_per_speed_s_m = 0.0;  // of the slip speed, where the shear ratio is not 0
    double creep_m_s = 0.0;        // slip speed at 0.7 of Coulomb's friction
    double resistance_N = 0.0;
    double side_N = 0.0;  // largest force on the side face
    // These are of the last evaluation: slip, what the rim is slower than told, forces, and the
    // stiffness across the normal and of the motion resistance, N s/m.
    bool acts = false;
    double slip_m_s = 0.0;
    double yield_m_s = 0.0;
    Tangential traction;
    double axle_N = 0.0, k_axle = 0.0;  // motion resistance
    double face_N = 0.0, k_face = 0.0;  // on the side face, across
    Tangential before;                  // `traction` where the last step of Newton's method began
    // The traction that this step foretold.
    double foretold_along_N = 0.0, foretold_across_N = 0.0;
  };
  // A force and minus its derivative by the speed.
  struct Bounded {
    double force_N;
    double stiffness;
  };
  // Traction of a row at a slip speed.
  struct Traction {
    double per_speed;  // force over slip speed
    double slope;      // derivative of force by slip speed
  };

  messages::PerWheel<double> SoilSlips() const;  // of the last solution, in [0, 1]
  void MakeRow(const Linkage& linkage, const Drive& drive, const LinkageVector& rates,
               RestingContact& contact, Row& row) const;
  void MakeWheelRow(const Drive& drive, RestingContact& contact, double arm_m, Row& row) const;
  // Take the traction from the contact's load, on soil from the answer to it.
  void SetTraction(const RestingContact& contact, Row& row) const;
  void SetSoilTraction(const SoilAnswer& soil, Row& row) const;
  Traction TractionOf(const Row& row, double speed_m_s) const;

  // Takes the traction that a share of the last step foretold, within what the ground can hold.
  static void Foretell(double share, Row& row);
  // Evaluates the forces of a contact, and their derivatives, at its speeds.
  void SetForces(const Speeds& speed, RestingContact& contact, Row& row);
  // Set slip, forces and stiffness of a row whose rim slips at that velocity: with the rim as fast
  // as told (AcrossTheNormal), and where the motor cannot hold that rate (GiveWay).
  void AcrossTheNormal(double along_m_s, double across_m_s, Row& row) const;
  void GiveWay(double along_m_s, double across_m_s, Row& row) const;
  static Eigen::Vector4d Forces(const RestingContact& contact, const Row& row);
  // Returns a force of at most force_N against a motion.
  static Bounded Against(double speed_m_s, double force_N, const Row& row);
  void FollowLoad(RestingContact& contact, Row& row);
  // Sums what acts at the rates at hand into the equations.
  void Assemble(const LinkageVector& rates, const std::vector<RestingContact>& contacts);
  // Returns the torque of a stop at the rate of one of the last three coordinates.
  double StopTorque_Nm(int dof, double rate) const;
  // Evaluates all contacts at this share of the change; returns the slope F . change there.
  double EvaluateAlong(const LinkageVector& rates, const LinkageVector& change, double share,
                       std::vector<RestingContact>& contacts);
  // Returns the share of the change where the forces balance along it, near enough, with all
  // contacts evaluated there. `drop` is F . change at its beginning.
  double Search(const LinkageVector& rates, const LinkageVector& change, double drop,
                std::vector<RestingContact>& contacts);
  void Finish(std::vector<RestingContact>& contacts);
  bool IsDugIn(const messages::PerWheel<double>& slip) const;
  void FollowSlips();
  bool IsSmall(const LinkageVector& change, double speed_m_s) const;
  bool IsBalanced() const;

  const RoverContactParams contact_params_;
  const WheelSoilTable soil_;
  SlipSinkage sinkage_;
  const bool lags_;     // digging in takes more way than lies between two balances
  bool dug_in_ = true;  // whether the last solution took the slips that it found
  const ShareTable share_;
  const double wheel_radius_m_;
  const double stall_torque_Nm_;
  const std::array<double, 3> stop_rad_;  // rocker, bogies
  const double speed_m_s_;
  const double mean_load_N_;
  const double stop_stiffness_Nm_;
  LinkageVector free_damping_;

  // These are of the balance at hand.
  Posture posture_;
  double step_s_ = 0.0;
  double rim_speed_m_s_ = 0.0;  // of the fastest rim
  bool rims_turn_ = false;
  LinkageVector gravity_;
  LinkageVector damping_;
  std::vector<Row> rows_;
  bool first_ = false;  // in the first evaluation: contacts that bore load before count as closed
  bool near_ = false;   // whether the last change of the rates was small
  bool traction_lags_ = false;  // whether a traction still lags behind its load
  LinkageEquations equations_;
};

}  // namespace rockyard::rover
