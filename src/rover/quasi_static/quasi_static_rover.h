// The rover of fidelity quasi_static, made by MakeRover: a sequence of balances of forces, some
// centimetres apart. Inertia counts where it starts and stops (progress.h). It is to move as
// RockerBogie does at a fraction of the cost: differential tests and results/studies/equivalence.md
// hold it to that.
#pragma once

#include "rover/motor_ramp.h"
#include "rover/quasi_static/balance.h"
#include "rover/quasi_static/contacts.h"
#include "rover/quasi_static/linkage.h"
#include "rover/rover.h"
#include "rover/rover_layout_params.h"

namespace rockyard::rover {

// The share of a motion's rates at which the wheels turn at the beginning and at the end of a step.
struct RimShares {
  double from = 0.0;
  double to = 0.0;
};

// The posture is interpolated between two balances, which are settle_distance_m of rim travel or
// settle_turn_rad of turning apart, on rocks rock_settle_share of that. The rover draws no random
// numbers. tests/rover/quasi_static/benchmark.cc measures its cost.
class QuasiStaticRover final : public Rover {
 public:
  QuasiStaticRover(const RoverParams& params, const terrain::Terrain& terrain);

  void Place(const math::Pose2& X_WR) override;
  // Throws std::runtime_error where no balance with finite rates exists.
  void Step(const messages::WheelCommand& command) override;
  double step_s() const override { return params_.quasi_static.step_s; }
  double ramp_s() const override { return params_.drive.ramp_s; }
  std::int64_t unconverged_balances() const override { return work_.not_converged; }
  const truth::RoverState& state() const override { return state_; }

  // Work done so far, for benchmarks.
  struct Work {
    std::int64_t balances = 0;
    std::int64_t iterations = 0;
    std::int64_t not_converged = 0;  // of the balances
  };
  const Work& work() const { return work_; }

 private:
  // The way between two balances, at constant rates. Times are those of a rover that drives at
  // these rates; a rover that starts or stops takes longer.
  struct Stretch {
    Posture from;
    Posture to;
    double duration_s = 0.0;
    double elapsed_s = 0.0;
    messages::PerWheel<double> rate_rad_s{};
    messages::PerWheel<double> steer_rad{};
  };

  // Turns the steering towards the wanted angles; returns whether it moved.
  bool Steer(const messages::PerWheel<double>& wanted_rad);
  void SteerAtRest();
  void Balance(const QuasiStaticBalance::Drive& drive);
  void Rest();
  bool SteersAsPlanned() const;
  // Lets the motion of the stretch go on for one step, while the rims turn at these shares of its
  // rates.
  void Follow(const RimShares& rims);
  // Makes one step of wheels that turn, or of a rover that has not come to rest yet: GoOn moves the
  // rover, Roll the wheels.
  void Roll(const MotorRates& rates, const messages::PerWheel<double>& commanded_rad_s);
  void GoOn(const MotorRates& rates, const messages::PerWheel<double>& commanded_rad_s);
  void RollBetween(const MotorRates& rates);
  void Stand();
  void Hold();
  double Inertia(const LinkageVector& a, const LinkageVector& b) const;
  void BeginProgress(const messages::PerWheel<double>& rate_rad_s, bool same_drive);
  void Plan(const messages::PerWheel<double>& rate_rad_s);
  LinkageVector ExpectedRates() const;
  bool StandsLevel() const;
  bool MeetsNothing(const LinkageVector& rates, double lead_s) const;
  bool IsSteady() const;
  void RollOn();
  bool Like(const messages::PerWheel<double>& rate_rad_s, double share) const;
  // Updates linkage and contacts, lead_s ahead if that can be; returns how far ahead they are, s.
  double LookAhead(double lead_s);
  double TurnRate(const messages::PerWheel<double>& rate_rad_s) const;
  double StretchTime_s(const messages::PerWheel<double>& rate_rad_s) const;
  bool IsBorneByObstacles() const;
  Posture LiftedPosture(const math::Pose2& X_WR) const;
  void Settle();
  void UpdatePosture();
  void UpdateForces();

  const RoverParams params_;
  const RoverGeometry geometry_;
  const terrain::Terrain& terrain_;
  Linkage linkage_;
  QuasiStaticContacts contacts_;
  QuasiStaticBalance balance_;
  MotorRamp motors_;
  Progress progress_;
  const double yaw_inertia_kg_m2_;
  Posture posture_;
  Stretch stretch_;
  messages::PerWheel<double> turn_share_{1.0, 1.0, 1.0, 1.0, 1.0, 1.0};  // of the stretch
  messages::PerWheel<double> met_steer_rad_{};  // at the last look for contacts
  // The way of the rover over that of its rims in the present step, in shares of the steady motion.
  double way_share_ = 1.0;
  double held_s_ = 0.0;  // as the set points say (messages/commands.h)
  LinkageVector rates_ = LinkageVector::Zero();
  LinkageVector last_rates_ = LinkageVector::Zero();     // of the stretch before the present one
  LinkageVector held_rates_ = LinkageVector::Zero();     // of the last balance at rest
  LinkageVector carried_rates_ = LinkageVector::Zero();  // of the motion that progress_ counts
  bool standing_ = true;     // whether the rover stands and is known to hold
  bool slides_ = false;      // whether it slides in the last balance at rest
  bool in_balance_ = false;  // whether the last balance met its tolerance and nothing falls
  bool steady_ = false;      // whether rates_ hold while the ground is level and the drive the same
  Work work_;
  truth::RoverState state_;
};

}  // namespace rockyard::rover
