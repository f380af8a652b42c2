// What a trace holds, against the record of the same drive.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "math/angles.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

// Samples and rests in the order of time.
std::vector<truth::TraceSample> Moments(const truth::Trace& trace) {
  std::vector<truth::TraceSample> moments;
  auto rest = trace.rests.begin();
  for (std::size_t i = 0; i <= trace.samples.size(); ++i) {
    for (; rest != trace.rests.end() && rest->samples_before <= i; ++rest) {
      moments.push_back(rest->sample);
    }
    if (i < trace.samples.size()) moments.push_back(trace.samples[i]);
  }
  return moments;
}

// Trial 7 of nominal finds no path after three reflections; trial 8 is jammed.
class TraceTest : public testing::TestWithParam<std::uint32_t> {
 protected:
  const TracedTrial trial_ = RunTraced(Pathfinder("nominal"), GetParam());
  const truth::DriveRecord& record() const { return trial_.result.record; }
};

TEST_P(TraceTest, EndsInTheStateOfTheRecord) {
  const truth::TraceSample last = Moments(trial_.trace).back();
  EXPECT_EQ(last.time_s, record().sim_time_s);
  EXPECT_EQ(last.pose.x_m, record().final_x_m);
  EXPECT_EQ(last.pose.y_m, record().final_y_m);
  EXPECT_EQ(last.pose.heading_rad, record().final_heading_rad);
  EXPECT_EQ(last.estimate.x_m, record().believed_x_m);
  EXPECT_EQ(trial_.trace.now_s(), last.time_s);
}

TEST_P(TraceTest, PosturesAreThoseOfThePoses) {
  double bogie_deg = 0.0;
  double rocker_deg = 0.0;
  for (const truth::TraceSample& moment : Moments(trial_.trace)) {
    const math::Pose2 pose = math::ToPose2(moment.posture.X_WR);
    ASSERT_EQ(pose.x_m, moment.pose.x_m);
    ASSERT_EQ(pose.heading_rad, moment.pose.heading_rad);
    ASSERT_EQ(math::Tilt(moment.posture.X_WR), moment.tilt_rad);
    for (const double angle_rad : {moment.posture.left_bogie_rad, moment.posture.right_bogie_rad}) {
      bogie_deg = std::max(bogie_deg, math::RadToDeg(std::abs(angle_rad)));
    }
    for (const double angle_rad :
         {moment.posture.left_rocker_rad, moment.posture.right_rocker_rad}) {
      rocker_deg = std::max(rocker_deg, math::RadToDeg(std::abs(angle_rad)));
    }
  }
  EXPECT_NEAR(bogie_deg, record().max_bogie_deg, 1e-9);
  EXPECT_NEAR(rocker_deg, record().max_rocker_deg, 1e-9);
}

TEST_P(TraceTest, StretchesAddUpToTheTimesOfTheRecord) {
  std::map<std::string, double> times_s;
  double before_s = 0.0;
  for (const truth::TraceSample& moment : Moments(trial_.trace)) {
    ASSERT_GE(moment.time_s, before_s);
    times_s[moment.activity] += moment.time_s - before_s;
    before_s = moment.time_s;
  }
  EXPECT_EQ(times_s[""], 0.0);
  EXPECT_NEAR(times_s["drive"], record().drive_time_s, 1e-6);
  EXPECT_NEAR(times_s["turn"], record().turn_time_s, 1e-6);
  EXPECT_NEAR(times_s["scan"], record().scan_time_s, 1e-6);
  EXPECT_EQ(times_s["stall"], 0.0);
}

// Activities that took no time leave no rest: light stripe takes no images apart from its scans.
TEST_P(TraceTest, EveryRestOfAnActivityTakesTime) {
  double last_s = 0.0;
  std::size_t rests = 0;
  for (const truth::TraceSample& moment : Moments(trial_.trace)) {
    const bool scan = moment.activity == "scan";
    rests += scan ? 1 : 0;
    if (!moment.activity.empty()) {
      EXPECT_GT(moment.time_s, last_s) << moment.activity;
    }
    last_s = moment.time_s;
  }
  EXPECT_GT(rests, 10U);
}

TEST_P(TraceTest, EveryReflectionSetsTheRoverBack) {
  const auto& rests = trial_.trace.rests;
  EXPECT_EQ(std::count_if(rests.begin(), rests.end(),
                          [](const truth::TraceRest& rest) { return rest.set_back; }),
            record().reflections);
}

TEST_P(TraceTest, FixedRocksStay) { EXPECT_TRUE(trial_.trace.rock_moves.empty()); }

INSTANTIATE_TEST_SUITE_P(Trials, TraceTest, testing::Values(0, 7, 8));

TEST(TraceOfLooseRocks, PushedRocksMoveABitAtATime) {
  const TracedTrial trial = RunTraced(
      Pathfinder("nominal", {"terrain.rocks.mobility=movable", "terrain.rocks.pointedness=0"}), 10);
  ASSERT_FALSE(trial.trace.rock_moves.empty());
  std::map<int, math::Vector3> last;
  double before_s = 0.0;
  for (const truth::RockMove& move : trial.trace.rock_moves) {
    EXPECT_GE(move.time_s, before_s);
    before_s = move.time_s;
    const auto found = last.find(move.rock);
    if (found != last.end()) {
      EXPECT_GT((move.center_W - found->second).norm(), 0.0);
      EXPECT_LT((move.center_W - found->second).norm(), 0.1);
    }
    last[move.rock] = move.center_W;
  }
}

}  // namespace
}  // namespace rockyard::trial
