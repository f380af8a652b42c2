#include "sensing/motion_sensors.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/check.h"
#include "core/random.h"

namespace rockyard::sensing {
namespace {

// Substream of the bias: no tick has this number. Records depend on it.
constexpr std::uint32_t kBiasSubstream = 0xFFFFFFFFu;

}  // namespace

Gyro::Gyro(const GyroParams& params, core::TrialKey key) : params_(params), key_(key) {
  core::RandomStream stream(key, core::Purpose::kGyro, kBiasSubstream);
  bias_rad_s_ = core::SampleNormal(stream, 0.0, params.bias_sd_rad_s);
}

double Gyro::Measure(double true_turn_rad, double duration_s, bool moving,
                     std::int64_t step) const {
  EXPECT(duration_s >= 0.0 && step >= 0);
  const double turn_rad = params_.scale * true_turn_rad;
  if (!moving && !params_.accumulates_at_rest) return turn_rad;
  core::RandomStream stream(key_, core::Purpose::kGyro, static_cast<std::uint32_t>(step));
  // Wiener process of the heading: variance q dt, so that the sum over ticks does not depend on
  // their length.
  const double deviation = std::sqrt(params_.heading_variance_rad2_per_s() * duration_s);
  return turn_rad + bias_rad_s_ * duration_s + core::SampleNormal(stream, 0.0, deviation);
}

double TurnAboutOwnAxis(const math::Transform& X_WR_before, const math::Transform& X_WR_after) {
  // R_WR(before)^-1 R_WR(after) is the rotation in the rover's own frame. The z component of its
  // rotation vector is, for a short tick, the integral of the rate about the rover's own z axis.
  return math::TurnOf(X_WR_before.linear().transpose() * X_WR_after.linear()).Vector_rad().z();
}

Encoders::Encoders(const EncoderParams& params, double wheel_radius_m, core::TrialKey key)
    : params_(params), wheel_radius_m_(wheel_radius_m), key_(key) {
  EXPECT(params.noise_variance_m2_per_m() >= 0.0 && params.noise_stretch_m > 0.0);
  EXPECT(wheel_radius_m > 0.0);
}

double Encoders::RollOn(double distance_m) {
  // Travel within one stretch shares its scale error; a long way is divided at the ends of
  // stretches, so that the tick length does not matter.
  double noise_m = 0.0;
  while (distance_m > 0.0) {
    if (left_in_stretch_m_ <= 0.0) {
      core::RandomStream stream(key_, core::Purpose::kEncoder, stretch_++);
      // The stretch L is wrong by N(0, v L) with v in m2/m (Matthies 1995, section 5: 0.0039), that
      // is by the scale error N(0, v / L).
      scale_error_ = core::SampleNormal(
          stream, 0.0, std::sqrt(params_.noise_variance_m2_per_m() / params_.noise_stretch_m));
      left_in_stretch_m_ = params_.noise_stretch_m;
    }
    const double part_m = std::min(distance_m, left_in_stretch_m_);
    noise_m += part_m * scale_error_;
    left_in_stretch_m_ -= part_m;
    distance_m -= part_m;
  }
  return noise_m;
}

messages::PerWheel<double> Encoders::Measure(const messages::PerWheel<double>& true_turn_rad) {
  const double mean_rad =
      std::accumulate(true_turn_rad.begin(), true_turn_rad.end(), 0.0) / messages::kWheelCount;
  EXPECT(std::isfinite(mean_rad));
  const double noise_m = RollOn(std::abs(mean_rad) * wheel_radius_m_);
  // The noise lengthens or shortens the motion in its own direction; all wheels share it.
  const double noise_rad = (mean_rad < 0.0 ? -noise_m : noise_m) / wheel_radius_m_;
  messages::PerWheel<double> measured = true_turn_rad;
  for (double& turn_rad : measured) turn_rad += noise_rad;
  return measured;
}

bool ScrapeDetector::IsScrape(const truth::BodyContact& contact) const {
  return contact.rock >= 0 && contact.part != truth::BodyPart::kWheel &&
         contact.normal_force_N >= params_.min_force_N &&
         contact.sliding_speed_m_s >= params_.min_sliding_speed_m_s;
}

bool ScrapeDetector::BeginsEpisode(int rock, double time_s, const math::Vector3& position_W) {
  for (Episode& episode : known_) {
    if (episode.rock != rock) continue;
    // An episode ends by a pause and a way together: rocking on one rock is one episode.
    const bool over = time_s - episode.last_time_s >= params_.episode_gap_s &&
                      (position_W - episode.last_position_W).norm() >= params_.episode_gap_m;
    episode.last_time_s = time_s;
    episode.last_position_W = position_W;
    return over;
  }
  known_.push_back({rock, time_s, position_W});
  return true;
}

double ScrapeDetector::Jump() const {
  core::RandomStream stream(key_, core::Purpose::kScrapeJump,
                            static_cast<std::uint32_t>(episodes_));
  // Both numbers are drawn for every sign, so that the choice of sign shifts no size.
  const bool left = core::SampleBernoulli(stream, 0.5);
  const double size = core::SampleNormal(stream, params_.jump_rad, params_.jump_spread_rad);
  switch (params_.sign) {
    case ScrapeSign::kLeft:
      return size;
    case ScrapeSign::kRight:
      return -size;
    case ScrapeSign::kRandom:
      break;
  }
  return left ? size : -size;
}

double ScrapeDetector::Observe(const truth::RoverState& state, double time_s) {
  double jump_rad = 0.0;
  for (const truth::BodyContact& contact : state.contacts) {
    if (!IsScrape(contact)) continue;
    if (!BeginsEpisode(contact.rock, time_s, state.X_WR.translation())) continue;
    // Episodes are counted also where nothing jumps. Jump() draws by the number of the episode,
    // before it is counted.
    if (params_.enabled) jump_rad += Jump();
    ++episodes_;
  }
  total_jump_rad_ += jump_rad;
  return jump_rad;
}

MotionSensors::MotionSensors(const GyroParams& gyro, const EncoderParams& encoders,
                             double wheel_radius_m, core::TrialKey key,
                             const truth::RoverState& state)
    : gyro_(gyro, key),
      encoders_(encoders, wheel_radius_m, key),
      scrapes_(gyro.scrape, key),
      X_WR_(state.X_WR),
      wheel_angle_rad_(state.wheel_angle_rad) {}

void MotionSensors::Observe(const truth::RoverState& state, double time_s) {
  // Scrapes happen between ticks; the gyro reports them with the next one.
  pending_jump_rad_ += scrapes_.Observe(state, time_s);
}

messages::MotionMeasurement MotionSensors::Measure(const truth::RoverState& state,
                                                   double duration_s, bool moving) {
  messages::PerWheel<double> wheel_turn_rad{};
  for (std::size_t wheel = 0; wheel < messages::kWheelCount; ++wheel) {
    wheel_turn_rad[wheel] = state.wheel_angle_rad[wheel] - wheel_angle_rad_[wheel];
  }
  messages::MotionMeasurement motion;
  motion.duration_s = duration_s;
  motion.wheel_turn_rad = encoders_.Measure(wheel_turn_rad);
  motion.steer_rad = state.steer_rad;
  // Scrapes since the last tick add their jumps once.
  motion.turn_rad = gyro_.Measure(TurnAboutOwnAxis(X_WR_, state.X_WR), duration_s, moving, tick_) +
                    std::exchange(pending_jump_rad_, 0.0);
  ++tick_;
  Restart(state);
  return motion;
}

void MotionSensors::Restart(const truth::RoverState& state) {
  X_WR_ = state.X_WR;
  wheel_angle_rad_ = state.wheel_angle_rad;
}

}  // namespace rockyard::sensing
