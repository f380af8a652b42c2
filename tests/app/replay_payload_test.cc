// What the replay page is given, held against the drive itself.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/drive_recording.h"
#include "app/replay_page.h"
#include "core/error.h"
#include "report/replay_motion.h"
#include "rover/rover_links.h"
#include "scenario/load.h"

namespace rockyard::app {
namespace {

using Json = nlohmann::json;
using testing::Each;
using testing::Ge;
using testing::HasSubstr;
using testing::SizeIs;

TrialSource SourceOf(const std::string& scenario, const std::vector<std::string>& overrides = {}) {
  TrialSource source;
  source.scenario = scenario::LoadScenario(
      std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/" + scenario + ".json", overrides);
  source.seed = static_cast<std::uint64_t>(source.scenario.seed);
  source.request = scenario;
  return source;
}

Json PayloadOf(const TrialSource& source, std::uint64_t trial) {
  return Json::parse(ReplayPayload(ReplayTrial(source, trial)));
}

double ValueOf(const Json& payload, const std::string& name) {
  for (const Json& column : payload["record"]) {
    if (column["name"] == name) return column["value"].get<double>();
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> Channel(const Json& payload, const char* name) {
  return payload["motion"][name].get<std::vector<double>>();
}

// Trial 7 of nominal: 388 scans, three settings back, no path.
class ReplayPayloadTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    source_ = SourceOf("pathfinder/nominal");
    payload_ = PayloadOf(source_, 7);
  }

  static inline TrialSource source_;
  static inline Json payload_;
};

TEST_F(ReplayPayloadTest, EndsWhereTheRecordDoes) {
  EXPECT_EQ(payload_["outcome"], "no_path");
  EXPECT_EQ(Channel(payload_, "x").back(), ValueOf(payload_, "final_x_m"));
  EXPECT_EQ(Channel(payload_, "y").back(), ValueOf(payload_, "final_y_m"));
  EXPECT_EQ(Channel(payload_, "t").back(), ValueOf(payload_, "sim_time_s"));
  EXPECT_EQ(Channel(payload_, "believed_x").back(), ValueOf(payload_, "believed_x_m"));
  EXPECT_EQ(Channel(payload_, "believed_heading").back(),
            ValueOf(payload_, "believed_heading_rad"));
  const Eigen::Quaterniond q(Channel(payload_, "qw").back(), Channel(payload_, "qx").back(),
                             Channel(payload_, "qy").back(), Channel(payload_, "qz").back());
  const math::Vector3 forward = q.toRotationMatrix().col(0);
  EXPECT_NEAR(std::atan2(forward.y(), forward.x()), ValueOf(payload_, "final_heading_rad"), 1e-12);
}

TEST_F(ReplayPayloadTest, ChannelsHaveOneLengthAndTimesAscend) {
  const Json& motion = payload_["motion"];
  const std::vector<double> times = Channel(payload_, "t");
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  EXPECT_EQ(times.front(), 0.0);
  for (const auto& [name, channel] : motion.items()) {
    if (!channel.is_array() || name == "activity_names" || name == "breaks") continue;
    EXPECT_THAT(channel, SizeIs(times.size())) << name;
  }
  for (const auto& [name, channel] : motion["joints"].items()) {
    EXPECT_THAT(channel, SizeIs(times.size())) << name;
  }
  EXPECT_THAT(motion["activity"].get<std::vector<int>>(),
              Each(testing::AllOf(Ge(0), testing::Lt(int(motion["activity_names"].size())))));
}

TEST_F(ReplayPayloadTest, JointsAreThoseOfTheLinks) {
  std::vector<std::string> links;
  for (const Json& link : payload_["rover"]["links"]) {
    EXPECT_LT(link["parent"].get<int>(), static_cast<int>(links.size()));
    links.push_back(link["name"]);
  }
  EXPECT_EQ(links.front(), "chassis");
  std::vector<std::string> joints;
  for (const auto& [name, channel] : payload_["motion"]["joints"].items()) joints.push_back(name);
  links.erase(links.begin());
  EXPECT_THAT(joints, testing::UnorderedElementsAreArray(links));
}

TEST_F(ReplayPayloadTest, AttitudesAreUnitQuaternionsThatTurnTheShortWay) {
  const auto w = Channel(payload_, "qw");
  const auto x = Channel(payload_, "qx");
  const auto y = Channel(payload_, "qy");
  const auto z = Channel(payload_, "qz");
  for (std::size_t i = 0; i < w.size(); ++i) {
    EXPECT_NEAR(w[i] * w[i] + x[i] * x[i] + y[i] * y[i] + z[i] * z[i], 1.0, 5e-5) << i;
    if (i == 0) continue;
    EXPECT_GE(w[i] * w[i - 1] + x[i] * x[i - 1] + y[i] * y[i - 1] + z[i] * z[i - 1], 0.0) << i;
  }
}

TEST_F(ReplayPayloadTest, BreaksWhereOperatorsSetTheRoverBack) {
  const auto breaks = payload_["motion"]["breaks"].get<std::vector<std::size_t>>();
  ASSERT_EQ(breaks.size(), ValueOf(payload_, "reflections"));
  ASSERT_THAT(breaks, SizeIs(3));
  std::vector<double> reflected;
  for (const Json& event : payload_["events"]) {
    if (event["kind"] == "reflection") reflected.push_back(event["t"]);
  }
  const auto times = Channel(payload_, "t");
  const auto headings = Channel(payload_, "believed_heading");
  for (std::size_t i = 0; i < breaks.size(); ++i) {
    EXPECT_EQ(times[breaks[i]], reflected[i]);
    EXPECT_EQ(times[breaks[i]], times[breaks[i] - 1]);
    EXPECT_NE(headings[breaks[i]], headings[breaks[i] - 1]);
  }
}

TEST_F(ReplayPayloadTest, ScansStandInTheRecordAndShowTheGround) {
  const Json& scans = payload_["scans"];
  EXPECT_EQ(scans.size(), ValueOf(payload_, "scans"));
  double last_s = -1.0;
  for (const Json& scan : scans) {
    EXPECT_GT(scan["t"].get<double>(), last_s);
    last_s = scan["t"];
    EXPECT_THAT(scan["hazards"], SizeIs(5));
    for (const Json& point : scan["points"]) {
      const double ahead_m = std::hypot(point["x"].get<double>() - scan["x"].get<double>(),
                                        point["y"].get<double>() - scan["y"].get<double>());
      EXPECT_LT(ahead_m, 1.5);
      EXPECT_LT(std::abs(point["z"].get<double>()), 0.6);
    }
  }
}

// The whole course, not thinned, against what the page shows between its moments.
TEST_F(ReplayPayloadTest, LeavesOutNoMomentThatIsFurtherOffThanItSays) {
  const DriveRecording recording = RecordDrive(source_.scenario, source_.seed, 7);
  const auto poses = PosesOf(source_.scenario, recording.traced.trace);
  const report::ThinnedMotion motion = report::ThinMotion(poses);
  EXPECT_EQ(motion.kept.size(), Channel(payload_, "t").size());
  EXPECT_LT(motion.kept.size(), poses.size() / 2);
  EXPECT_EQ(motion.tolerance.position_m, payload_["motion"]["position_tolerance"]);
  EXPECT_EQ(motion.tolerance.position_m, 0.002);
  std::size_t after = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    while (motion.kept[after] < i) ++after;
    if (motion.kept[after] == i) continue;
    EXPECT_LE(report::ShownError(poses[motion.kept[after - 1]], poses[motion.kept[after]], poses[i],
                                 motion.tolerance),
              1.0)
        << i;
  }
}

TEST(ReplayPayload, SaysWhetherTheStoredRecordIsRepeated) {
  TrialSource source = SourceOf("pathfinder/nominal", {"referee.time_limit_s=60"});
  EXPECT_TRUE(PayloadOf(source, 1)["repeats_stored"].is_null());
  source.stored = ReplayTrial(source, 1).data.record;
  EXPECT_EQ(PayloadOf(source, 1)["repeats_stored"], true);
  source.stored->values[0] += 1e-12;
  EXPECT_EQ(PayloadOf(source, 1)["repeats_stored"], false);
}

TEST(ReplayPayload, RocksThatThePushedRoverMoves) {
  const Json payload =
      PayloadOf(SourceOf("pathfinder/nominal", {"terrain.rocks.mobility=movable"}), 10);
  ASSERT_FALSE(payload["rock_moves"].empty());
  for (const Json& move : payload["rock_moves"]) {
    const Json& rock = payload["rocks"][move["rock"].get<std::size_t>()];
    const double moved_m = std::hypot(move["x"].get<double>() - rock["x"].get<double>(),
                                      move["y"].get<double>() - rock["y"].get<double>());
    EXPECT_LT(moved_m, 1.0);
  }
}

TEST(ReplayPayload, StepsOfAMapBasedNavigator) {
  const Json payload = PayloadOf(SourceOf("gestalt/narrow_course"), 0);
  ASSERT_FALSE(payload["steps"].empty());
  for (const Json& step : payload["steps"]) {
    const Json& map = step["map"];
    const std::size_t cells = map["nx"].get<std::size_t>() * map["ny"].get<std::size_t>();
    EXPECT_THAT(map["goodness"], SizeIs(cells));
    EXPECT_THAT(map["elevation"], SizeIs(cells));
    EXPECT_EQ(std::count_if(step["votes"].begin(), step["votes"].end(),
                            [](const Json& vote) { return vote["chosen"] == true; }),
              1);
    EXPECT_THAT(step["points"], SizeIs(kMostStepPoints));
  }
}

// Of many steps only some keep what takes room. Steps of a real drive, over and over.
TEST(ReplayPayload, ManyStepsStaySmall) {
  ReplayedTrial replayed = ReplayTrial(SourceOf("gestalt/narrow_course"), 0);
  std::vector<report::ReplayStep>& steps = replayed.data.steps;
  const std::vector<report::ReplayStep> few = steps;
  while (steps.size() <= 2 * report::kMostDetailedSteps) {
    steps.insert(steps.end(), few.begin(), few.end());
  }
  const Json payload = Json::parse(ReplayPayload(replayed));
  std::size_t detailed = 0;
  for (const Json& step : payload["steps"]) {
    const Json& heights = step["map"]["elevation"];
    const bool any = std::any_of(heights.begin(), heights.end(),
                                 [](const Json& height) { return !height.is_null(); });
    EXPECT_EQ(any, !step["points"].empty());
    detailed += any;
  }
  EXPECT_EQ(detailed, (steps.size() + 2) / 3);
}

// Four hours of simulated time, and rough ground in the arena.
TEST(ReplayPayload, TheLongestTrialStaysSmall) {
  const std::string text = ReplayPayload(
      ReplayTrial(SourceOf("pathfinder/obstacles_2.0",
                           {"terrain.ground.roughness_rms_m=0.02", "terrain.ground.slope_deg=3"}),
                  1));
  // Compressed and in base64 a fifth of it; the page itself has some 0.8 MB.
  EXPECT_LT(text.size(), 6'000'000U);
}

// A rover that slides until its speed leaves the model's range.
TEST(ReplayPayload, ASimulatorFaultIsShownUpToWhereItHappens) {
  const Json payload =
      PayloadOf(SourceOf("pathfinder/level_sand",
                         {"terrain.ground.slope_deg=40", "terrain.ground.slope_direction_deg=90",
                          "terrain.ground.soil.friction_angle_deg=5"}),
                0);
  EXPECT_EQ(payload["outcome"], "simulator_fault");
  EXPECT_TRUE(payload["record"].empty());
  EXPECT_LT(Channel(payload, "y").back(), -1.0);
  EXPECT_EQ(payload["events"].back()["kind"], "end");
  EXPECT_NEAR(payload["events"].back()["t"].get<double>(), Channel(payload, "t").back(), 1e-4);
  EXPECT_EQ(payload["events"].back()["detail"], payload["detail"]);
}

// No place for every rock of an exact count.
TEST(ReplayPayload, ATrialWithoutATerrainIsSaid) {
  const TrialSource source = SourceOf(
      "pathfinder/obstacles_0.85", {"terrain.rocks.clear_radius_m=3.3", "referee.time_limit_s=1"});
  int told = 0;
  for (std::uint64_t trial = 0; trial < 8; ++trial) {
    try {
      ReplayTrial(source, trial);
    } catch (const core::UserError& error) {
      EXPECT_THAT(error.problems().front().reason, HasSubstr("has no terrain to show"));
      ++told;
    }
  }
  EXPECT_GE(told, 1);
}

TEST(ReplayPayload, AMeasurementHasNoCourse) {
  try {
    ReplayTrial(SourceOf("hazard_detection/false_alarm"), 0);
    FAIL();
  } catch (const core::UserError& error) {
    EXPECT_THAT(error.problems().front().suggestion, HasSubstr("--list"));
  }
}

TEST(ReplayPayload, NamesAreTextWhateverTheyHold) {
  TrialSource source = SourceOf("pathfinder/nominal", {"referee.time_limit_s=1"});
  source.scenario.name = "</script><b>\"\\\n\xff";
  const Json payload = PayloadOf(source, 0);
  EXPECT_EQ(payload["scenario"], "</script><b>\"\\\n\xef\xbf\xbd");
}

}  // namespace
}  // namespace rockyard::app
