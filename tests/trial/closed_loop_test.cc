// What holds for whole drives, whatever the rocks.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "navigation/pathfinder/pathfinder_params.h"
#include "trial/counters/drive_monitor.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

TEST(ClosedLoopTest, PerfectLocalizationNeverArrivesBeforeTheGoal) {
  const DriveParams drive = Pathfinder("nominal_perfect_localization");
  const double tick_m = drive.rover.drive.speed_m_s / drive.clock.control_rate_hz;
  const double tolerance_m =
      drive.navigation.navigators.params<navigation::PathfinderParams>().goal_tolerance_m;
  const double shortest_m = drive.course.goal_x_m - drive.course.start_x_m - tolerance_m - tick_m;
  int arrived = 0;
  for (const DriveResult& result : RunTrials(drive, 20)) {
    const truth::DriveRecord& record = result.record;
    EXPECT_EQ(record.position_error_m, 0.0);
    EXPECT_EQ(record.heading_error_deg, 0.0);
    EXPECT_NE(result.outcome, truth::TrialOutcome::kFalseGoal);
    if (result.outcome != truth::TrialOutcome::kGoalReached) continue;
    ++arrived;
    // A chord that a reflection cuts off is not counted.
    EXPECT_GE(record.true_distance_m, shortest_m - record.reflections * DriveMonitor::kChord_m);
    EXPECT_LE(record.true_goal_distance_m, tolerance_m);
  }
  EXPECT_GT(arrived, 10);
}

// However short of the goal a rover stops that believes to be there, and however often it was
// turned at a mirror line: a path is no shorter than the straight way to its end.
TEST(ClosedLoopTest, PathRatioOfArrivalsIsAtLeastOne) {
  int short_of_goal = 0;
  int reflected = 0;
  for (const DriveResult& result :
       RunTrials(Pathfinder("nominal", {"rover.fidelity=quasi_static"}), 60)) {
    const truth::DriveRecord& record = result.record;
    EXPECT_GE(record.true_distance_m, record.displacement_m - 1e-9);
    EXPECT_NEAR(record.displacement_m, std::hypot(record.final_x_m, record.final_y_m), 0.01);
    if (!truth::DeclaredSuccess(result.outcome)) {
      EXPECT_TRUE(std::isnan(record.path_ratio));
      continue;
    }
    EXPECT_EQ(record.path_ratio, record.true_distance_m / record.displacement_m);
    EXPECT_GE(record.path_ratio, 1.0 - 1e-9);
    short_of_goal += record.true_distance_m < record.straight_distance_m ? 1 : 0;
    reflected += record.reflections > 0.0 ? 1 : 0;
  }
  EXPECT_GT(short_of_goal, 3) << "the ratio to the goal was below 1";
  EXPECT_GT(reflected, 3);
}

TEST(ClosedLoopTest, OtherNavigatorsMeetTheSameRocks) {
  const DriveParams first = Pathfinder("nominal");
  const DriveParams second =
      Pathfinder("nominal", {"navigation.pathfinder.turn_increment_deg=30",
                             "navigation.pathfinder.both_sides=toward_goal"});
  bool drove_otherwise = false;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const truth::DriveRecord a = RunTrial(first, {1, i}).record;
    const truth::DriveRecord b = RunTrial(second, {1, i}).record;
    EXPECT_EQ(a.rocks, b.rocks);
    EXPECT_EQ(a.rock_cover, b.rock_cover);
    EXPECT_EQ(a.layout, b.layout);
    drove_otherwise = drove_otherwise || a.true_distance_m != b.true_distance_m;
  }
  EXPECT_TRUE(drove_otherwise);
}

TEST(ClosedLoopTest, TrialsShareLayoutsAndNothingElse) {
  const DriveParams drive =
      Pathfinder("nominal", {"course.trials_per_layout=3", "referee.time_limit_s=500"});
  const std::vector<DriveResult> results = RunTrials(drive, 6);
  for (std::size_t i = 0; i < results.size(); ++i) {
    const truth::DriveRecord& record = results[i].record;
    const truth::DriveRecord& first = results[i - i % 3].record;
    EXPECT_EQ(record.layout, static_cast<double>(i / 3));
    EXPECT_EQ(record.rocks, first.rocks);
    EXPECT_EQ(record.rock_cover, first.rock_cover);
    if (i % 3 == 0) continue;
    EXPECT_NE(record.dead_reckoned_distance_m, first.dead_reckoned_distance_m);
  }
  EXPECT_NE(results[0].record.rock_cover, results[3].record.rock_cover);
}

TEST(ClosedLoopTest, WithoutHazardSensingThereAreNoScans) {
  const DriveResult result =
      RunTrial(Pathfinder("nominal", {"perception.hazard.enabled=false"}), {1, 0});
  EXPECT_EQ(result.record.scans, 0.0);
  EXPECT_EQ(result.record.scan_time_s, 0.0);
  EXPECT_EQ(result.record.hazards_believed, 0.0);
  EXPECT_GT(RunTrial(Pathfinder("nominal"), {1, 0}).record.scans, 50.0);
}

TEST(ClosedLoopTest, TrackerChangesReportedErrorsAndNothingElse) {
  const DriveResult plain = RunTrial(Pathfinder("nominal"), {1, 2});
  const DriveResult tracked =
      RunTrial(Pathfinder("nominal", {"sensors.tracker.enabled=true"}), {1, 2});
  EXPECT_THAT(Differences(plain, tracked),
              testing::ElementsAre("heading_error_deg", "position_error_m"));
  EXPECT_NEAR(plain.record.position_error_m, tracked.record.position_error_m, 0.025);
  EXPECT_NEAR(plain.record.heading_error_deg, tracked.record.heading_error_deg, 1.4);
}

// Time and energy of a drive, summed over its trace tick by tick.
struct Books {
  double drive_s = 0.0;
  double turn_s = 0.0;
  double steer_s = 0.0;
};

Books BooksOf(const truth::Trace& trace) {
  // A sample ends the stretch of its activity: a control tick, or the stop before a look. It begins
  // where the last one ended, or the rest between them.
  std::map<std::string, double> spent_s;
  double last_s = 0.0;
  auto rest = trace.rests.begin();
  for (std::size_t i = 0; i < trace.samples.size(); ++i) {
    for (; rest != trace.rests.end() && rest->samples_before == i; ++rest) {
      last_s = rest->sample.time_s;
    }
    spent_s[trace.samples[i].activity] += trace.samples[i].time_s - last_s;
    last_s = trace.samples[i].time_s;
  }
  return {spent_s["drive"], spent_s["turn"], spent_s["steer"]};
}

double EnergyWh(const Books& books, double scan_s, double stall_s, const EnergyParams& energy) {
  const double base_W = energy.cpu_W + energy.gyro_W;
  constexpr double kScan_W = 7.33;  // published
  return ((books.drive_s + books.turn_s + stall_s) * (base_W + energy.driving_W) +
          books.steer_s * (base_W + energy.steering_W) + scan_s * kScan_W) /
         3600.0;
}

void ExpectBooksBalance(const DriveParams& drive, const TracedTrial& trial) {
  const truth::DriveRecord& record = trial.result.record;
  const bool stuck = trial.result.outcome == truth::TrialOutcome::kJammed ||
                     trial.result.outcome == truth::TrialOutcome::kHighCentred;
  const double stall_s = stuck ? record.sim_time_s - trial.trace.samples.back().time_s : 0.0;
  const Books books = BooksOf(trial.trace);
  EXPECT_NEAR(record.drive_time_s, books.drive_s, 1e-6);
  EXPECT_NEAR(record.turn_time_s, books.turn_s, 1e-6);
  EXPECT_NEAR(record.scan_time_s, record.scans * drive.clock.scan_time_s, 1e-6);
  EXPECT_NEAR(record.sim_time_s,
              books.drive_s + books.turn_s + books.steer_s + record.scan_time_s + stall_s, 1e-6);
  EXPECT_NEAR(record.energy_wh, EnergyWh(books, record.scan_time_s, stall_s, drive.energy), 1e-6);
}

TEST(ClosedLoopTest, TimeAndEnergyAddUp) {
  const DriveParams drive = Pathfinder("obstacles_0.57");
  for (std::uint32_t i = 0; i < 3; ++i) {
    const TracedTrial trial = RunTraced(drive, i);
    EXPECT_GT(trial.result.record.turn_time_s, 0.0);
    EXPECT_GT(trial.result.record.scans, 0.0);
    ExpectBooksBalance(drive, trial);
  }
}

// 25 Hz and 30 Hz both make a tick of two steps of 1/60 s: then nothing may tell them apart.
TEST(ClosedLoopTest, TickLastsWholeStepsForAllThatGoesByIt) {
  const auto drive = [](const std::string& rate_hz) {
    return RunTraced(Pathfinder("level_sand", {"course.start_heading_deg=40",
                                               "clock.control_rate_hz=" + rate_hz}),
                     0);
  };
  const TracedTrial asked_25 = drive("25");
  EXPECT_THAT(Differences(asked_25.result, drive("30").result), testing::IsEmpty());
  EXPECT_THAT(Differences(asked_25.result, drive("20").result), testing::Not(testing::IsEmpty()));
  const Books books = BooksOf(asked_25.trace);
  EXPECT_NEAR(asked_25.result.record.drive_time_s, books.drive_s, 1e-6);
  EXPECT_NEAR(asked_25.result.record.turn_time_s, books.turn_s, 1e-6);
}

TEST(ClosedLoopTest, BooksBalanceOfARoverThatJams) {
  for (const std::string stuck_rover : {"end", "run_on"}) {
    const DriveParams drive = Pathfinder(
        "level_sand", {"terrain.arena.kind=walled", "terrain.ground.soil.preset=hard_ground",
                       "course.start_y_m=1.2", "course.start_heading_deg=90",
                       "energy.battery_wh=50", "referee.stuck_rover=" + stuck_rover});
    const TracedTrial trial = RunTraced(drive, 0);
    ASSERT_EQ(trial.result.outcome, truth::TrialOutcome::kJammed);
    const truth::DriveRecord& record = trial.result.record;
    if (stuck_rover == "run_on") {
      EXPECT_NEAR(record.energy_wh, drive.energy.battery_wh, 1e-9);
      EXPECT_GT(record.sim_time_s, 3600.0);
    } else {
      EXPECT_NEAR(record.energy_wh + record.stall_energy_wh, drive.energy.battery_wh, 1e-9);
      EXPECT_LT(record.sim_time_s, 3600.0);
    }
    ExpectBooksBalance(drive, trial);
  }
}

// Where the soil swallows the rover, the trial says so instead of driving on with its belly below
// the ground; where wheels sink deeper than the law of the rut holds, the record does.
TEST(ClosedLoopTest, SoilThatBearsNothingEmbedsTheRover) {
  for (const std::string fidelity : {"multibody", "quasi_static"}) {
    const auto run = [&](const std::string& modulus) {
      return RunTrial(
          Pathfinder("level_sand", {"rover.fidelity=" + fidelity, "terrain.ground.soil.law=bekker",
                                    "terrain.ground.soil.sinkage_exponent=1",
                                    "terrain.ground.soil.cohesive_modulus_N_per_mn1=0",
                                    "terrain.ground.soil.frictional_modulus_N_per_mn2=" + modulus,
                                    "referee.time_limit_s=60"}),
          {1, 0});
    };
    // 33 N on a wheel of 8 x 13 cm: by N = 2/3 b k sqrt(D) z^1.5, 1.5 cm, 3.5 cm and 14 cm.
    const DriveResult firm = run("9.3e5");
    EXPECT_EQ(firm.record.beyond_soil_law, 0.0) << fidelity;
    EXPECT_NEAR(firm.record.max_sinkage_m, 0.015, 0.004) << fidelity;
    const DriveResult soft = run("2.6e5");
    EXPECT_EQ(soft.record.beyond_soil_law, 1.0) << fidelity;
    EXPECT_GT(soft.record.max_sinkage_m, 0.065 / 3.0) << fidelity;
    EXPECT_EQ(soft.detail.find("sank into the soil"), std::string::npos) << fidelity;
    const DriveResult liquid = run("3.2e4");
    EXPECT_EQ(liquid.outcome, truth::TrialOutcome::kJammed) << fidelity;
    EXPECT_NE(liquid.detail.find("sank into the soil"), std::string::npos) << fidelity;
  }
}

TEST(ClosedLoopTest, RecordAgreesWithTheTrace) {
  const TracedTrial trial = RunTraced(Pathfinder("obstacles_0.57"), 1);
  const truth::DriveRecord& record = trial.result.record;
  const truth::TraceSample& last = trial.trace.samples.back();
  EXPECT_EQ(record.final_x_m, last.pose.x_m);
  EXPECT_EQ(record.final_y_m, last.pose.y_m);
  EXPECT_EQ(record.believed_x_m, last.estimate.x_m);
  EXPECT_EQ(record.dead_reckoned_distance_m, last.estimate.distance_m);
  const auto events = [&](const char* kind) {
    return static_cast<double>(EventsOf(trial.trace, kind).size());
  };
  EXPECT_EQ(record.hazards_believed, events("hazard"));
  EXPECT_EQ(record.scrapes, events("scrape"));
  EXPECT_EQ(record.reflections, events("reflection"));
  EXPECT_EQ(trial.trace.events.back().kind, "end");
}

// A course aimed at the mirror line over level sand, by a rover whose odometer is far off.
TracedTrial DriveAtTheMirrorLine() {
  return RunTraced(Pathfinder("level_sand", {"terrain.arena.kind=virtual_reflected",
                                             "course.start_y_m=0.6", "course.start_heading_deg=90",
                                             "perception.dead_reckoning.distance_scale=0.6"}),
                   0);
}

TEST(ReflectionTest, TurnsTheRoverAndItsEstimateAtTheLine) {
  const TracedTrial trial = DriveAtTheMirrorLine();
  ASSERT_GE(trial.result.record.reflections, 1.0);
  const std::vector<truth::TraceSample>& samples = trial.trace.samples;
  const double reflected_s = EventsOf(trial.trace, "reflection").at(0).time_s;
  const auto before = std::find_if(samples.begin(), samples.end(), [&](const auto& sample) {
    return sample.time_s >= reflected_s;
  });
  ASSERT_LT(before + 1, samples.end());
  const auto after = before + 1;  // one tick after the rover was turned
  const double tick_m = 0.15 / 20.0;
  const double tick_rad = 0.03;

  EXPECT_GE(before->pose.y_m, 1.1);
  EXPECT_LT(before->pose.y_m, 1.1 + tick_m);
  EXPECT_NEAR(after->pose.x_m, before->pose.x_m, tick_m);
  EXPECT_NEAR(after->pose.y_m, before->pose.y_m, tick_m);
  EXPECT_NEAR(after->pose.heading_rad, -before->pose.heading_rad, tick_rad);

  // The error goes on in the mirror image. It turns over within twice the overshoot, and the tick
  // adds what its motion adds.
  const double error_y_m = before->estimate.y_m - before->pose.y_m;
  ASSERT_LT(error_y_m, -0.1);
  EXPECT_NEAR(after->estimate.x_m - after->pose.x_m, before->estimate.x_m - before->pose.x_m,
              tick_m);
  EXPECT_NEAR(after->estimate.y_m - after->pose.y_m, -error_y_m, 3.0 * tick_m);
  EXPECT_NEAR(after->estimate.heading_rad - after->pose.heading_rad,
              -(before->estimate.heading_rad - before->pose.heading_rad), tick_rad);
}

TEST(ReflectionTest, KeepsTheRoverBetweenTheLines) {
  const TracedTrial trial = DriveAtTheMirrorLine();
  for (const truth::TraceSample& sample : trial.trace.samples) {
    EXPECT_LT(std::abs(sample.pose.y_m), 1.1 + 0.15 / 20.0);
  }
}

// How far the rover's centre got to the left of the course when it drove off to the left.
double FarthestLeft(const std::string& arena) {
  const TracedTrial trial =
      RunTraced(Pathfinder("level_sand", {"terrain.arena.kind=" + arena, "course.start_y_m=1.4",
                                          "course.start_heading_deg=70"}),
                0);
  const auto farthest =
      std::max_element(trial.trace.samples.begin(), trial.trace.samples.end(),
                       [](const auto& a, const auto& b) { return a.pose.y_m < b.pose.y_m; });
  return farthest->pose.y_m;
}

TEST(WallsTest, KeepTheRoverInside) {
  // Half the width of the rover is the least that its centre keeps off a wall.
  const double inside_m = 2.0 - 0.24;
  EXPECT_LT(FarthestLeft("walled"), inside_m + 0.01);
  EXPECT_GT(FarthestLeft("open"), inside_m + 0.01);  // the same drive without a wall goes farther
}

// Operators turn a rover whose position reaches the line (Matthies 1995 sec. 7); one that turns in
// place near it is left alone, or it could never turn across the line's direction.
TEST(MirrorLine, OnlyADrivingRoverIsReflected) {
  const DriveParams drive = Pathfinder("obstacles_0.85");
  int reflections = 0;
  for (std::uint32_t index = 0; index < 12; ++index) {
    const TracedTrial trial = RunTraced(drive, index);
    for (const truth::TraceEvent& event : EventsOf(trial.trace, "reflection")) {
      ++reflections;
      const auto sample =
          std::find_if(trial.trace.samples.begin(), trial.trace.samples.end(),
                       [&](const truth::TraceSample& s) { return s.time_s >= event.time_s; });
      ASSERT_NE(sample, trial.trace.samples.end());
      EXPECT_NE(sample->activity, "turn") << "trial " << index << " at " << event.time_s << " s";
    }
  }
  EXPECT_GT(reflections, 0);
}

// In this trial the rover comes to rest on a rock at the line, steers, and slides back to the
// heading from which it was turned. Turned at every tick it could never finish steering, nor the
// trial end. Of 3000 such trials it is the second in how often that happens.
TEST(MirrorLine, ARoverThatWasTurnedDrivesBeforeItIsTurnedAgain) {
  const auto [result, trace] =
      RunTraced(Pathfinder("vl2", {"rover.fidelity=quasi_static"}), 370, 77);
  EXPECT_EQ(result.outcome, truth::TrialOutcome::kNoPath);
  std::optional<double> last_s;
  int pairs = 0;
  for (const truth::TraceEvent& event : EventsOf(trace, "reflection")) {
    if (last_s) {
      ++pairs;
      EXPECT_TRUE(std::any_of(trace.samples.begin(), trace.samples.end(),
                              [&](const auto& sample) {
                                return sample.activity == "drive" && sample.time_s > *last_s &&
                                       sample.time_s <= event.time_s;
                              }))
          << "between " << *last_s << " s and " << event.time_s << " s";
    }
    last_s = event.time_s;
  }
  EXPECT_GT(pairs, 10);
}

}  // namespace
}  // namespace rockyard::trial
