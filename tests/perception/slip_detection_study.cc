// How soon, and how often in vain, a check of slip stops a rover: one estimate of visual odometry a
// step of 75 cm against five a second. `slip_detection_study detection` and `... position` write
// the tables of results/studies/slip_*.csv.
//
// The truth is the quasi-static rover on landscaping sand whose wheels dig in (slip_sinkage at its
// defaults): 2 to 2.75 m on the level, then a slope. The two drives are joined; how six wheels pass
// from one to the other is left out. What is seen is the true way with a Gaussian error of the
// standard deviation that the check is told; half of its variance belongs to the keyframe.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "core/distributions.h"
#include "core/random.h"
#include "math/angles.h"
#include "perception/slip_check.h"
#include "rover/rover_drive.h"

namespace rockyard::perception {
namespace {

constexpr double kSpeed_m_s = 0.15;
constexpr double kStep_s = 0.05;  // of the rover
constexpr double kRolledATick_m = kSpeed_m_s * kStep_s;
constexpr double kDrive_m = 12.0;  // rolled on the slope
constexpr double kOnset_m = 0.05;  // rolled, over which the true slip counts
constexpr int kDrives = 200;
constexpr std::uint64_t kSeed = 25;

// One control tick's true way along the slope, and the mean depth of the wheels after it.
struct Tick {
  double way_m = 0.0;
  double depth_m = 0.0;
};

std::vector<Tick> DriveUp(double slope_deg, bool digs, double rolled_m) {
  rover::RoverParams params;
  params.fidelity = rover::Fidelity::kQuasiStatic;
  params.quasi_static.step_s = kStep_s;
  terrain::SoilParams soil;
  soil.slip_sinkage.enabled = digs;
  const terrain::Terrain terrain = rover::SlopeTerrain(math::DegToRad(slope_deg), 0.0, soil);
  const auto rover = rover::MakeRover(params, terrain);
  rover->Place({});
  const messages::WheelCommand command = rover::Drive(params, kSpeed_m_s, 0.0);
  RunFor(*rover, command, 0.5);  // motors are at their speed
  std::vector<Tick> ticks;
  math::Vector3 last = rover->state().X_WR.translation();
  for (int i = 0; i < static_cast<int>(rolled_m / kRolledATick_m); ++i) {
    rover->Step(command);
    const math::Vector3 now = rover->state().X_WR.translation();
    Tick tick{.way_m = std::copysign((now - last).norm(), now.x() - last.x())};
    for (const double depth_m : rover->state().wheel_sinkage_m) tick.depth_m += depth_m / 6.0;
    ticks.push_back(tick);
    last = now;
  }
  return ticks;
}

// How visual odometry looks, and how well.
struct Eyes {
  std::string name;
  double every_rolled_m;  // between looks
  double keyframe_m;      // rolled, at which the newest pair becomes the keyframe
};

struct Errors {
  double scale = 1.0;  // of the still and proportional part of VisualErrorModelParams::along
  double failures = 0.0;

  double Sd(double way_m) const { return scale * std::hypot(2e-4, 0.003 * way_m); }
};

struct Stop {
  std::size_t tick = 0;
  bool is_false = false;
};

// The first alarm from a tick on.
std::optional<Stop> FirstAlarm(const std::vector<Tick>& ticks, std::size_t first, const Eyes& eyes,
                               const Errors& errors, const SlipCheckParams& check,
                               core::RandomStream& random) {
  double rolled_m = 0.0;
  double way_m = 0.0;
  double since_look_m = 0.0;
  double key_error = core::SampleNormal(random, 0.0, 1.0);
  for (std::size_t i = first; i < ticks.size(); ++i) {
    rolled_m += kRolledATick_m;
    way_m += ticks[i].way_m;
    since_look_m += kRolledATick_m;
    if (since_look_m < eyes.every_rolled_m - 1e-9) continue;
    since_look_m = 0.0;
    const double own_error = core::SampleNormal(random, 0.0, 1.0);
    if (random.Uniform() < errors.failures) continue;
    const double sd_m = errors.Sd(rolled_m);
    messages::RelativeMotion seen;
    seen.motion_F[0] = way_m + sd_m * (own_error + key_error) / std::sqrt(2.0);
    seen.covariance *= sd_m * sd_m;
    messages::RelativeMotion truth;
    truth.motion_F[0] = way_m;
    truth.covariance.setZero();
    const Eigen::Vector2d rolled_F(rolled_m, 0.0);
    const auto slip = SlipOf(rolled_F, seen, check);
    if (slip && slip->exceeded) return Stop{i, !SlipOf(rolled_F, truth, check)->exceeded};
    if (rolled_m < eyes.keyframe_m - 1e-9) continue;
    rolled_m = way_m = 0.0;
    key_error = own_error;
  }
  return std::nullopt;
}

// Where the true slip over kOnset_m of rolled way first exceeds the limit.
std::optional<std::size_t> Onset(const std::vector<Tick>& ticks, double limit) {
  const auto window = static_cast<std::size_t>(std::lround(kOnset_m / kRolledATick_m));
  double way_m = 0.0;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    way_m += ticks[i].way_m - (i >= window ? ticks[i - window].way_m : 0.0);
    if (i + 1 >= window && way_m < (1.0 - limit) * kOnset_m) return i;
  }
  return std::nullopt;
}

struct Tally {
  double way_m = 0.0;  // true, before a stop or the onset
  int false_stops = 0;
  int missed = 0;
  std::vector<double> delay_m;  // rolled
  std::vector<double> depth_m;  // of the wheels where the rover stopped
};

// One drive: stops in vain are counted and driven on from.
void RunDrive(const std::vector<Tick>& ticks, const Eyes& eyes, const Errors& errors,
              const SlipCheckParams& check, core::RandomStream& random, Tally& tally) {
  const auto onset = Onset(ticks, check.limit);
  const std::size_t clean = onset.value_or(ticks.size());
  for (std::size_t i = 0; i < clean; ++i) tally.way_m += ticks[i].way_m;
  std::size_t from = 0;
  while (true) {
    const auto stop = FirstAlarm(ticks, from, eyes, errors, check, random);
    if (!stop) {
      if (onset) ++tally.missed;
      return;
    }
    if (onset && stop->tick >= *onset) {
      tally.delay_m.push_back(static_cast<double>(stop->tick - *onset) * kRolledATick_m);
      tally.depth_m.push_back(ticks[stop->tick].depth_m);
      return;
    }
    if (stop->is_false) ++tally.false_stops;
    from = stop->tick + 1;
  }
}

// Nothing where there are none.
std::string Quantile(std::vector<double> values, double share, double scale) {
  if (values.empty()) return "";
  std::sort(values.begin(), values.end());
  const double at = share * static_cast<double>(values.size() - 1);
  return fmt::format("{:.4g}", scale * values[static_cast<std::size_t>(std::lround(at))]);
}

const std::vector<Eyes>& AllEyes() {
  // 0.2 s at 0.15 m/s are 3 cm.
  static const std::vector<Eyes> kEyes{{"step_75cm", 0.75, 0.75},
                                       {"5hz_keyframe_50cm", 0.03, 0.5},
                                       {"5hz_keyframe_25cm", 0.03, 0.25}};
  return kEyes;
}

void Detection() {
  const std::vector<Tick> level = DriveUp(0.0, true, 2.75);
  fmt::print(
      "slope_deg,eyes,error_scale,failure_share,sigma,way_before_m,false_stops,"
      "false_stops_per_100m,detected,missed,delay_p50_m,delay_p90_m,depth_p50_mm,depth_end_mm\n");
  for (const double slope_deg : {0.0, 9.0, 10.0, 11.0, 12.0, 13.0, 15.0, 18.0}) {
    const std::vector<Tick> slope = DriveUp(slope_deg, true, kDrive_m);
    for (const Eyes& eyes : AllEyes()) {
      for (const double scale : {1.0, 10.0, 30.0}) {
        for (const double sigma : {0.0, 1.0, 2.0, 3.0}) {
          const Errors errors{scale, 0.05};
          const SlipCheckParams check{.enabled = true, .limit = 0.5, .sigma = sigma};
          Tally tally;
          for (int drive = 0; drive < kDrives; ++drive) {
            core::RandomStream random({kSeed, static_cast<std::uint32_t>(drive)},
                                      core::Purpose::kVisualMotion);
            const double before_m = 2.0 + 0.75 * random.Uniform();
            std::vector<Tick> ticks(level.begin(), level.begin() + static_cast<std::ptrdiff_t>(
                                                                       before_m / kRolledATick_m));
            ticks.insert(ticks.end(), slope.begin(), slope.end());
            RunDrive(ticks, eyes, errors, check, random, tally);
          }
          fmt::print("{},{},{},{},{},{:.1f},{},{:.3f},{},{},{},{},{},{:.2f}\n", slope_deg,
                     eyes.name, scale, errors.failures, sigma, tally.way_m, tally.false_stops,
                     100.0 * tally.false_stops / tally.way_m, tally.delay_m.size(), tally.missed,
                     Quantile(tally.delay_m, 0.5, 1.0), Quantile(tally.delay_m, 0.9, 1.0),
                     Quantile(tally.depth_m, 0.5, 1000.0), 1000.0 * slope.back().depth_m);
        }
      }
    }
  }
}

// Ten metres that the wheels roll: where the rover is, and what it believes of its way.
void Position() {
  constexpr double kRolled_m = 10.0;
  fmt::print("slope_deg,digs_in,true_way_m,error_of_wheels_m,sd_of_vision_m,depth_mm\n");
  for (const double slope_deg : {0.0, 3.0, 6.0, 9.0, 11.0, 12.0, 13.0, 15.0, 18.0}) {
    for (const bool digs : {false, true}) {
      const std::vector<Tick> ticks = DriveUp(slope_deg, digs, kRolled_m);
      double way_m = 0.0;
      for (const Tick& tick : ticks) way_m += tick.way_m;
      // Keyframes half a rolled metre apart, of independent errors.
      const double steps = kRolled_m / 0.5;
      const double sd_m = std::sqrt(steps) * Errors{}.Sd(way_m / steps);
      fmt::print("{},{:d},{:.3f},{:.3f},{:.4f},{:.2f}\n", slope_deg, digs, way_m, kRolled_m - way_m,
                 sd_m, 1000.0 * ticks.back().depth_m);
    }
  }
}

}  // namespace
}  // namespace rockyard::perception

int main(int count, char** arguments) {
  const std::string table = count == 2 ? arguments[1] : "";
  if (table == "detection") {
    rockyard::perception::Detection();
  } else if (table == "position") {
    rockyard::perception::Position();
  } else {
    fmt::print(stderr, "usage: slip_detection_study detection|position\n");
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
