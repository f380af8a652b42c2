#include "rover/quasi_static/quasi_static_rover.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "math/functions.h"
#include "rover/rover_layout_params.h"

namespace rockyard::rover {
namespace {

using math::Vector3;
using messages::kWheelCount;

// Contacts are looked for this far beyond what a wheel travels in one stretch, m.
constexpr double kReach_m = 0.005;
// Longest movement of R's origin and largest turn in one stretch, as multiples of what the wheels
// would do: a rover that falls does so in several stretches.
constexpr double kMaxMove = 2.0;
constexpr double kMaxTurn_rad = 0.1;
// A change of steering below this keeps the stretch, rad.
constexpr double kSameSteer_rad = 0.017;
// Movements below these in a stretch count as none: they change a wheel's load by less than a
// thousandth.
constexpr double kSteady_m = 2e-6;
constexpr double kSteady_rad = 1e-5;
// Rates that differ by no more than this share are the same.
constexpr double kSameRate = 1e-9;
// A rover that moves so many times faster than its rims falls.
constexpr double kFalls = 3.0;
// A rover that a balance at rest lets move faster than the share kStands of its top speed does not
// stand: ten times as fast as friction lets braked wheels creep. Beyond kSlides it does not settle
// but slides down a slope.
constexpr double kStands = 1.6e-3;
constexpr double kSlides = 0.1;
// Where a drive differs from the last one by less, the last rates still say where the rover will be
// half a stretch ahead.
constexpr double kSimilar = 0.25;
// A stretch of set points that others are known to follow outlasts them by this share: a stretch
// that ended with them would begin another that nobody needs.
constexpr double kOutlasts = 1e-6;
// Rates that change by less than this share of the top speed from one stretch to the next do so
// smoothly.
constexpr double kSmooth = 0.15;
// A rock deeper than this in the rover, half a step ahead, is met where the rover stands:
// directions of deep contacts mean nothing.
constexpr double kDeepest_m = 0.003;
// Settling: most steps, longest movement in one, and the movement that ends it, m.
constexpr int kSettleSteps = 100;
constexpr double kSettleMove_m = 0.02;
constexpr double kSettled_m = 1e-6;

// Scales rates so that nothing moves further than allowed within the time.
void Limit(double time_s, double max_m, double max_rad, LinkageVector& rates) {
  const double move_m = time_s * rates.head<3>().norm();
  const double turn_rad = time_s * rates.tail<6>().cwiseAbs().maxCoeff();
  const double scale = std::max({1.0, move_m / max_m, turn_rad / max_rad});
  rates /= scale;
}

// Returns the share of `shape` that `rate_rad_s` is, at least 0; nothing where the ratios of the
// wheels differ.
std::optional<double> ShareOf(const messages::PerWheel<double>& rate_rad_s,
                              const messages::PerWheel<double>& shape) {
  std::size_t fastest = 0;
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    if (std::abs(shape[i]) > std::abs(shape[fastest])) fastest = i;
  }
  if (shape[fastest] == 0.0) return std::nullopt;
  const double share = rate_rad_s[fastest] / shape[fastest];
  if (share < -kSameRate) return std::nullopt;
  const double most_rad_s = kSameRate * std::abs(shape[fastest]);
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    if (std::abs(rate_rad_s[i] - share * shape[i]) > most_rad_s) return std::nullopt;
  }
  return std::max(0.0, share);
}

std::optional<RimShares> Shares(const MotorRates& rates, const messages::PerWheel<double>& shape) {
  const auto from = ShareOf(rates.from, shape);
  const auto to = rates.to == rates.from ? from : ShareOf(rates.to, shape);
  if (!from || !to) return std::nullopt;
  return RimShares{*from, *to};
}

// Returns the rover's moment of inertia about R's z axis.
double YawInertia(const RoverParams& params) {
  const RoverGeometry geometry = MakeRoverGeometry(params.geometry);
  const RoverMasses masses = MakeRoverMasses(params);
  const auto of = [](const BodyMass& body, const Vector3& p_R) {
    return body.inertia_kg_m2.z() + body.mass_kg * p_R.head<2>().squaredNorm();
  };
  double sum = of(masses.chassis, masses.chassis.com_B);
  for (const Vector3& pivot_R : geometry.rocker_pivot_R) sum += of(masses.rocker, pivot_R);
  for (const Vector3& pivot_R : geometry.bogie_pivot_R) sum += of(masses.bogie, pivot_R);
  for (const Vector3& wheel_R : geometry.wheel_R) sum += of(masses.wheel, wheel_R);
  return sum;
}

}  // namespace

QuasiStaticRover::QuasiStaticRover(const RoverParams& params, const terrain::Terrain& terrain)
    : params_(params),
      geometry_(MakeRoverGeometry(params.geometry)),
      terrain_(terrain),
      linkage_(params),
      contacts_(params.geometry, terrain),
      balance_(params, terrain.ground().soil()),
      motors_(params),
      yaw_inertia_kg_m2_(YawInertia(params)) {}

// The posture is above every rock beneath, so that settling only lowers the rover onto rocks.
Posture QuasiStaticRover::LiftedPosture(const math::Pose2& X_WR) const {
  const terrain::Ground& ground = terrain_.ground();
  const Vector3 up = ground.Normal(X_WR.x_m, X_WR.y_m);
  const Vector3 heading(math::Cos(X_WR.heading_rad), math::Sin(X_WR.heading_rad), 0.0);
  // The x axis lies in the ground's tangent plane and keeps its heading as seen from above.
  const Vector3 forward = (heading - heading.dot(up) / up.z() * Vector3::UnitZ()).normalized();
  Eigen::Matrix3d R;
  R << forward, up.cross(forward), up;
  double rise_m = 0.0;
  std::vector<int> rocks;
  const RoverGeometryParams& size = params_.geometry;
  terrain_.RocksNear(X_WR.x_m, X_WR.y_m, math::Hypot(0.5 * size.length_m, 0.5 * size.width_m),
                     rocks);
  for (const int index : rocks) {
    const terrain::Rock& rock = terrain_.rocks()[static_cast<std::size_t>(index)];
    const double ground_m = ground.Height(rock.center_W.x(), rock.center_W.y());
    rise_m = std::max(rise_m, rock.center_W.z() + rock.semi_axes_m.z() - ground_m);
  }
  Posture posture;
  posture.p_WR = Vector3(X_WR.x_m, X_WR.y_m, ground.Height(X_WR.x_m, X_WR.y_m)) + rise_m * up;
  posture.q_WR = Eigen::Quaterniond(R);
  return posture;
}

void QuasiStaticRover::Place(const math::Pose2& X_WR) {
  state_.steer_rad.fill(0.0);
  posture_ = LiftedPosture(X_WR);
  contacts_.Clear();
  balance_.ForgetHoles();
  Settle();
  // A rover that was lifted begins a new stretch.
  stretch_ = {};
  met_steer_rad_ = state_.steer_rad;
  steady_ = false;
  held_rates_.setZero();
  motors_.Reset();
  progress_.Stop();
  UpdatePosture();
  Stand();
}

void QuasiStaticRover::Settle() {
  rates_.setZero();
  // Wheels stand still: this time only turns rates into movements.
  const double time_s = params_.quasi_static.settle_distance_m / params_.drive.speed_m_s;
  for (int i = 0; i < kSettleSteps; ++i) {
    linkage_.Update(posture_, state_.steer_rad);
    contacts_.Update(linkage_, kReach_m + kSettleMove_m);
    // Contacts open and close while the rover sinks: balances are repeated until nothing moves.
    balance_.Solve(linkage_, posture_, {{}, time_s, 0.0, Freedom::kSettling}, contacts_.contacts(),
                   rates_);
    Limit(time_s, kSettleMove_m, kMaxTurn_rad, rates_);
    posture_ = Moved(posture_, rates_, time_s);
    if (time_s * rates_.cwiseAbs().maxCoeff() < kSettled_m) break;
  }
  rates_.setZero();
}

bool QuasiStaticRover::Steer(const messages::PerWheel<double>& wanted_rad) {
  bool changed = false;
  const double max_rad = params_.drive.steer_rate_rad_s * step_s();
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    const double limit = geometry_.steered[i] ? params_.drive.max_steer_rad : 0.0;
    const double wanted = std::clamp(wanted_rad[i], -limit, limit);
    const double change = std::clamp(wanted - state_.steer_rad[i], -max_rad, max_rad);
    state_.steer_rad[i] += change;
    changed |= change != 0.0;
  }
  return changed;
}

// Steers the wheels of a rover at rest: a wheel that swings into a rock pushes the rover away,
// against its braked wheels.
void QuasiStaticRover::SteerAtRest() {
  double swing_rad = 0.0;
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    swing_rad = std::max(swing_rad, std::abs(state_.steer_rad[i] - met_steer_rad_[i]));
  }
  // The rim, a wheel's radius from the steering axis, has swung by this much since the last look.
  const double swing_m = swing_rad * params_.geometry.wheel_radius_m;
  if (swing_m < 0.5 * params_.quasi_static.settle_distance_m) return;
  met_steer_rad_ = state_.steer_rad;
  if (!contacts_.MayMeetObstacle(posture_.p_WR, kReach_m)) return;
  linkage_.Update(posture_, state_.steer_rad);
  if (!contacts_.WheelMayMeetObstacle(linkage_, kReach_m)) return;
  contacts_.Update(linkage_, kReach_m);
  const std::vector<RestingContact>& contacts = contacts_.contacts();
  if (std::none_of(contacts.begin(), contacts.end(), [](const RestingContact& contact) {
        return contact.gap_m < 0.0 && !contact.IsSoil();
      })) {
    return;
  }
  Hold();
}

void QuasiStaticRover::Balance(const QuasiStaticBalance::Drive& drive) {
  const int iterations = balance_.Solve(linkage_, posture_, drive, contacts_.contacts(), rates_);
  ++work_.balances;
  work_.iterations += iterations;
  in_balance_ = iterations < QuasiStaticBalance::kMaxIterations;
  if (!in_balance_) ++work_.not_converged;
  if (!rates_.allFinite()) throw std::runtime_error("no balance of forces with finite rates");
}

void QuasiStaticRover::Rest() {
  state_.v_WR_m_s.setZero();
  state_.w_WR_rad_s.setZero();
  for (truth::BodyContact& contact : state_.contacts) contact.sliding_speed_m_s = 0.0;
}

bool QuasiStaticRover::SteersAsPlanned() const {
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    if (std::abs(state_.steer_rad[i] - stretch_.steer_rad[i]) > kSameSteer_rad) return false;
  }
  return true;
}

// Returns whether rates and steering are those of the last stretch, rates within `share` of the
// fastest rate, steering within `share` rad.
bool QuasiStaticRover::Like(const messages::PerWheel<double>& rate_rad_s, double share) const {
  double fastest = 0.0;
  double change = 0.0;
  double turn = 0.0;
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    fastest = std::max(fastest, std::abs(rate_rad_s[i]));
    change = std::max(change, std::abs(rate_rad_s[i] - stretch_.rate_rad_s[i]));
    turn = std::max(turn, std::abs(state_.steer_rad[i] - stretch_.steer_rad[i]));
  }
  return change <= share * fastest && turn <= share;
}

// Finds the contacts lead_s ahead, or the present contacts where the way there leads into a rock.
double QuasiStaticRover::LookAhead(double lead_s) {
  const double way_m = params_.quasi_static.settle_distance_m;
  linkage_.Update(Moved(posture_, rates_, lead_s), state_.steer_rad);
  contacts_.Update(linkage_, kReach_m + (lead_s > 0.0 ? 0.5 : 1.0) * way_m);
  const std::vector<RestingContact>& contacts = contacts_.contacts();
  if (lead_s == 0.0 ||
      std::none_of(contacts.begin(), contacts.end(), [](const RestingContact& contact) {
        return !contact.IsSoil() && contact.gap_m < -kDeepest_m;
      })) {
    return lead_s;
  }
  linkage_.Update(posture_, state_.steer_rad);
  contacts_.Update(linkage_, kReach_m + way_m);
  return 0.0;
}

// Returns the turn rate, rad/s, of the rigid motion nearest to what the rims do, for wheels evenly
// about R's origin, by least squares of v_i = Omega x r_i over the wheels:
//   Omega = sum (r_i x v_i)_z / sum r_i^2,   v_i = omega_i r (cos delta_i, sin delta_i) in R.
double QuasiStaticRover::TurnRate(const messages::PerWheel<double>& rate_rad_s) const {
  double moment = 0.0;
  double inertia = 0.0;
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    const Vector3& wheel_R = geometry_.wheel_R[i];
    const double rim_m_s = rate_rad_s[i] * params_.geometry.wheel_radius_m;
    const Eigen::Vector2d& steer = linkage_.steer(i);
    moment += rim_m_s * (wheel_R.x() * steer.y() - wheel_R.y() * steer.x());
    inertia += wheel_R.head<2>().squaredNorm();
  }
  return moment / inertia;
}

double QuasiStaticRover::StretchTime_s(const messages::PerWheel<double>& rate_rad_s) const {
  double rate = 0.0;
  for (const double wheel_rate : rate_rad_s) rate = std::max(rate, std::abs(wheel_rate));
  const double radius_m = params_.geometry.wheel_radius_m;
  // The stretch ends at the rim travel or at the turn that the parameters allow, whichever is
  // first.
  const double turn_rad_s = std::abs(TurnRate(rate_rad_s));
  const double way_s = params_.quasi_static.settle_distance_m / (rate * radius_m);
  const double max_rad = params_.quasi_static.settle_turn_rad;
  const double time_s = turn_rad_s * way_s > max_rad ? max_rad / turn_rad_s : way_s;
  // Where the wheels are steered on from tick to tick, a stretch ends with its set points: half of
  // a longer stretch ahead the heading would not be that of the way driven by them.
  // Soil that takes more way to be dug into than a stretch changes within it.
  const bool changes = IsBorneByObstacles() || balance_.lags();
  return std::min(changes ? params_.quasi_static.rock_settle_share * time_s : time_s,
                  (1.0 + kOutlasts) * held_s_);
}

// On rocks the direction of the contacts, and with it the motion, changes within centimetres: long
// stretches lose a share of the way to wheels that leave a rock in the middle of a stretch.
bool QuasiStaticRover::IsBorneByObstacles() const {
  const std::vector<RestingContact>& contacts = contacts_.contacts();
  return std::any_of(contacts.begin(), contacts.end(), [](const RestingContact& contact) {
    return !contact.IsSoil() && contact.load_N > 0.0;
  });
}

// Plans one stretch: contacts half a stretch ahead at the expected rates, one balance there, and
// the rates of that balance for the whole stretch (a midpoint rule).
void QuasiStaticRover::Plan(const messages::PerWheel<double>& rate_rad_s) {
  const bool same_drive = Like(rate_rad_s, 0.0);
  const bool similar_drive = Like(rate_rad_s, kSimilar);
  stretch_.from = posture_;
  linkage_.Steer(state_.steer_rad);
  stretch_.duration_s = StretchTime_s(rate_rad_s);
  stretch_.elapsed_s = 0.0;
  stretch_.rate_rad_s = rate_rad_s;
  stretch_.steer_rad = state_.steer_rad;
  met_steer_rad_ = state_.steer_rad;
  const double reach_m = kReach_m + params_.quasi_static.settle_distance_m;
  const bool goes_on = same_drive && steady_ && balance_.HasDugIn();
  if (goes_on && !contacts_.MayMeetObstacle(posture_.p_WR, reach_m)) return RollOn();
  const LinkageVector last_rates = rates_;
  if (same_drive) rates_ = ExpectedRates();
  last_rates_ = last_rates;
  const double lead_s = LookAhead(similar_drive ? 0.5 * stretch_.duration_s : 0.0);
  const bool stands_level = StandsLevel();
  if (goes_on && stands_level && MeetsNothing(last_rates, lead_s)) {
    rates_ = last_rates;
    return RollOn();
  }
  Balance({rate_rad_s, stretch_.duration_s, lead_s, Freedom::kAll});
  turn_share_ = balance_.TurnShares();
  // From here on RollOn may repeat this balance in the rover's frame: only on a level plane, where
  // a turn of the rover changes nothing.
  steady_ = stands_level && MeetsNothing(rates_, lead_s) && IsSteady() && balance_.HasDugIn();
  Limit(stretch_.duration_s, kMaxMove * params_.quasi_static.settle_distance_m, kMaxTurn_rad,
        rates_);
  // A fall may be longer than a stretch allows: Limit lets the rover fall in several.
  stretch_.to = Moved(posture_, rates_, stretch_.duration_s);
  UpdateForces();
  BeginProgress(rate_rad_s, same_drive);
}

// Returns twice the kinetic energy of the rates a where b = a, and else what a and b have in
// common.
double QuasiStaticRover::Inertia(const LinkageVector& a, const LinkageVector& b) const {
  return params_.mass.total_kg * a.head<3>().dot(b.head<3>()) + yaw_inertia_kg_m2_ * a[5] * b[5];
}

void QuasiStaticRover::BeginProgress(const messages::PerWheel<double>& rate_rad_s,
                                     bool same_drive) {
  SteadyDrive drive = balance_.Steady(rates_);
  double rim_m_s = 0.0;
  for (const double rate : rate_rad_s) {
    rim_m_s = std::max(rim_m_s, std::abs(rate) * params_.geometry.wheel_radius_m);
  }
  // A fall is no motion that wheels start or stop: only the damping bears what nothing holds.
  const bool falls = rates_.head<3>().norm() > kFalls * rim_m_s;
  in_balance_ = in_balance_ && !falls;
  if (!falls) drive.inertia_J = Inertia(rates_, rates_);
  // Another motion keeps what the old motion has in common with it; the same drive goes on as it
  // was.
  double kept = 1.0;
  if (!same_drive) {
    kept = drive.inertia_J > 0.0 ? std::max(0.0, Inertia(carried_rates_, rates_) / drive.inertia_J)
                                 : 0.0;
  }
  progress_.Begin(drive, kept);
  carried_rates_ = rates_;
}

// Rates that change little from one stretch to the next go on changing: a wheel that climbs over a
// rock turns its way by the same angle in each.
LinkageVector QuasiStaticRover::ExpectedRates() const {
  const LinkageVector change = rates_ - last_rates_;
  const double most_m_s = kSmooth * params_.drive.speed_m_s;
  const bool smooth =
      change.head<3>().norm() < most_m_s &&
      change.tail<6>().cwiseAbs().maxCoeff() * params_.geometry.wheel_radius_m < most_m_s;
  return smooth ? LinkageVector(rates_ + change) : rates_;
}

// Returns whether all six wheels are on a level plane.
bool QuasiStaticRover::StandsLevel() const {
  const std::vector<RestingContact>& contacts = contacts_.contacts();
  if (!terrain_.ground().IsPlane()) return false;
  return std::count_if(contacts.begin(), contacts.end(), [](const RestingContact& contact) {
           return contact.IsSoil() && contact.n_W.z() == 1.0;
         }) == static_cast<std::ptrdiff_t>(kWheelCount);
}

// Returns whether a rover that moves like a rigid body at these rates touches nothing but soil
// until the stretch ends; its contacts were found lead_s after the beginning.
bool QuasiStaticRover::MeetsNothing(const LinkageVector& rates, double lead_s) const {
  const std::vector<RestingContact>& contacts = contacts_.contacts();
  const double rest_s = stretch_.duration_s - lead_s;
  return std::all_of(contacts.begin(), contacts.end(), [&](const RestingContact& contact) {
    if (contact.IsSoil()) return true;
    const Vector3 v_m_s =
        rates.head<3>() + rates.segment<3>(3).cross(contact.p_W - linkage_.chassis().p_WB);
    return contact.gap_m + rest_s * contact.n_W.dot(v_m_s) > 0.0;
  });
}

// Returns whether all coordinates but the three in the plane are at rest.
bool QuasiStaticRover::IsSteady() const {
  return stretch_.duration_s * std::abs(rates_[2]) < kSteady_m &&
         stretch_.duration_s * rates_.segment<2>(3).cwiseAbs().maxCoeff() < kSteady_rad &&
         stretch_.duration_s * rates_.tail<3>().cwiseAbs().maxCoeff() < kSteady_rad;
}

// Goes on by the last balance, turned with the rover: on level ground nothing has changed but the
// heading.
void QuasiStaticRover::RollOn() {
  last_rates_ = rates_;
  const double turn_rad = stretch_.duration_s * rates_[5];
  const auto [s, c] = math::SinCos(turn_rad);
  rates_.head<2>() = Eigen::Vector2d(c * rates_[0] - s * rates_[1], s * rates_[0] + c * rates_[1]);
  rates_.segment<3>(2).setZero();
  rates_.tail<3>().setZero();
  stretch_.to = Moved(posture_, rates_, stretch_.duration_s);
}

void QuasiStaticRover::Step(const messages::WheelCommand& command) {
  held_s_ = command.held_s;
  const bool steered = Steer(command.steer_rad);
  const MotorRates rates = motors_.Advance(command.rate_rad_s, step_s());
  const auto turns = [](double rate) { return rate != 0.0; };
  const bool rolls = std::any_of(rates.from.begin(), rates.from.end(), turns) ||
                     std::any_of(rates.to.begin(), rates.to.end(), turns);
  if (rolls || progress_.speed() != 0.0) return Roll(rates, command.rate_rad_s);
  // The forces of a drive in balance, each within its friction, hold the rover as well when it
  // brakes. While wheels are steered, a balance may wait for SteerAtRest, unless the rover slides.
  if (!standing_ && !in_balance_ && (!steered || slides_)) Stand();
  standing_ = standing_ || in_balance_;
  if (steered) SteerAtRest();
  Rest();
}

void QuasiStaticRover::Roll(const MotorRates& rates,
                            const messages::PerWheel<double>& commanded_rad_s) {
  standing_ = false;
  way_share_ = 1.0;
  GoOn(rates, commanded_rad_s);
  messages::PerWheel<double> rim_way_m{};
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    // Motors hold the rates that the balance takes as given, but for motors that stall.
    const double turn_rad = 0.5 * step_s() * (rates.from[i] + rates.to[i]) * turn_share_[i];
    state_.wheel_angle_rad[i] += turn_rad;
    rim_way_m[i] = std::abs(turn_rad) * params_.geometry.wheel_radius_m;
  }
  // Where the rover starts and stops its way falls behind that of its rims, or runs ahead of it.
  balance_.Dig(rim_way_m, way_share_);
}

void QuasiStaticRover::GoOn(const MotorRates& rates,
                            const messages::PerWheel<double>& commanded_rad_s) {
  const auto shares = Shares(rates, stretch_.rate_rad_s);
  if (stretch_.duration_s > 0.0 && shares && SteersAsPlanned()) return Follow(*shares);
  // Another motion begins, or the wheels have been steered.
  if (shares) {
    Plan(messages::PerWheel<double>(stretch_.rate_rad_s));
    return Follow(*shares);
  }
  // From rest a ramp keeps the ratio of the commanded rates.
  if (const auto of_command = Shares(rates, commanded_rad_s)) {
    Plan(commanded_rad_s);
    return Follow(*of_command);
  }
  RollBetween(rates);
}

// On the way from one motion to another the mean rates of each step are a motion of their own.
void QuasiStaticRover::RollBetween(const MotorRates& rates) {
  messages::PerWheel<double> mean_rad_s{};
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    mean_rad_s[i] = 0.5 * (rates.from[i] + rates.to[i]);
  }
  const double least_rad_s = kSameRate * params_.drive.speed_m_s / params_.geometry.wheel_radius_m;
  if (std::none_of(mean_rad_s.begin(), mean_rad_s.end(),
                   [&](double rate) { return std::abs(rate) > least_rad_s; })) {
    // The rover goes through rest from one direction to the other.
    progress_.Stop();
    return Rest();
  }
  Plan(mean_rad_s);
  Follow({1.0, 1.0});
}

void QuasiStaticRover::Follow(const RimShares& rims) {
  double way_s = progress_.Advance(rims.from, rims.to, step_s());
  const double rims_s = 0.5 * step_s() * (rims.from + rims.to);
  way_share_ = rims_s > 0.0 ? way_s / rims_s : 1.0;
  // A step may end this stretch and use up others; what is left of its way lies within the last
  // stretch.
  while (stretch_.elapsed_s + way_s >= stretch_.duration_s) {
    way_s -= stretch_.duration_s - stretch_.elapsed_s;
    posture_ = stretch_.to;
    Plan(messages::PerWheel<double>(stretch_.rate_rad_s));
  }
  stretch_.elapsed_s += way_s;
  // State between two balances: linear in position, the shorter arc in attitude.
  posture_ = Between(stretch_.from, stretch_.to, stretch_.elapsed_s / stretch_.duration_s);
  state_.v_WR_m_s = progress_.speed() * rates_.head<3>();
  state_.w_WR_rad_s = progress_.speed() * rates_.segment<3>(3);
  UpdatePosture();
}

void QuasiStaticRover::Stand() {
  linkage_.Update(posture_, state_.steer_rad);
  contacts_.Update(linkage_, kReach_m);
  Hold();
  Rest();
}

// Balances a rover whose wheels do not turn: the balance gives the loads at rest, and says whether
// the rover slides. A rover that falls or slides moves on by what the balance lets it in one step.
void QuasiStaticRover::Hold() {
  // The rates of the drive start its next balance, and the rates of the last balance at rest start
  // this one.
  std::swap(rates_, held_rates_);
  Balance({{}, step_s(), 0.0, Freedom::kAll});
  const double speed_m_s = rates_.head<3>().norm();
  standing_ = speed_m_s < kStands * params_.drive.speed_m_s;
  slides_ = speed_m_s > kSlides * params_.drive.speed_m_s;
  in_balance_ = in_balance_ && standing_;
  if (!standing_) {
    Limit(step_s(), params_.quasi_static.settle_distance_m, kMaxTurn_rad, rates_);
    posture_ = Moved(posture_, rates_, step_s());
    stretch_.duration_s = 0.0;
    steady_ = false;
    UpdatePosture();
  }
  UpdateForces();
  std::swap(rates_, held_rates_);
}

void QuasiStaticRover::UpdatePosture() {
  state_.X_WR.linear() = posture_.q_WR.toRotationMatrix();
  state_.X_WR.translation() = posture_.p_WR;
  state_.left_rocker_rad = posture_.rocker_rad;
  state_.right_rocker_rad = -posture_.rocker_rad;
  state_.left_bogie_rad = posture_.bogie_rad[0];
  state_.right_bogie_rad = posture_.bogie_rad[1];
}

void QuasiStaticRover::UpdateForces() {
  state_.contacts.clear();
  state_.wheel_load_N.fill(0.0);
  state_.wheel_sinkage_m.fill(0.0);
  const Linkage::Frame& chassis = linkage_.chassis();  // where the contacts were found
  for (const RestingContact& contact : contacts_.contacts()) {
    if (contact.load_N <= 0.0) continue;
    if (contact.IsWheel()) {
      const auto wheel = static_cast<std::size_t>(contact.part);
      state_.wheel_load_N[wheel] += contact.load_N;
      // The soil's share of the penetration; the rest is that of the contact's spring.
      const double spring_m = contact.load_N / params_.contact.stiffness_N_m;
      if (contact.IsSoil()) {
        state_.wheel_sinkage_m[wheel] = std::max(0.0, contact.depth_m - spring_m);
      }
    } else {
      state_.contacts.push_back({contact.kind, std::max(contact.other, -1), contact.load_N,
                                 contact.sliding_speed_m_s, contact.n_W.z(),
                                 chassis.R_WB.transpose() * (contact.p_W - chassis.p_WB)});
    }
  }
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    state_.motor_torque_Nm[i] = balance_.MotorTorque_Nm(i);
  }
}

}  // namespace rockyard::rover
