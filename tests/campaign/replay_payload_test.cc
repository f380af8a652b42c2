// What the replay page is given, held against the drive itself.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "campaign/replay_moments.h"
#include "campaign/replay_payloads.h"
#include "campaign/trial_source.h"
#include "image_files/png_file.h"
#include "replay/motion.h"
#include "trial/run_trial.h"

namespace rockyard::campaign {
namespace {

using testing::DoubleNear;
using testing::Each;
using testing::ElementsAre;
using testing::Ge;
using testing::SizeIs;

// Trial 26 of nominal: hundreds of scans, several settings back, and no arrival.
class ReplayPayloadTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    source_ = SourceOf("pathfinder/nominal");
    payload_ = PayloadOf(source_, kTrial);
  }

  static constexpr std::uint32_t kTrial = 26;
  static inline TrialSource source_;
  static inline Json payload_;
};

TEST_F(ReplayPayloadTest, EndsWhereTheRecordDoes) {
  const trial::DriveResult driven = trial::RunTrial(source_.scenario.drive, {source_.seed, kTrial});
  EXPECT_EQ(payload_["outcome"], std::string(truth::Name(driven.outcome)));
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
  ASSERT_THAT(breaks, SizeIs(Ge(2)));
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
  const DriveRecording recording = RecordDrive(source_.scenario, source_.seed, kTrial);
  const auto poses = PosesOf(source_.scenario, recording.traced.trace);
  const replay::ThinnedMotion motion = replay::ThinMotion(poses);
  EXPECT_EQ(motion.kept.size(), Channel(payload_, "t").size());
  EXPECT_LT(motion.kept.size(), poses.size() / 2);
  EXPECT_EQ(motion.tolerance.position_m, payload_["motion"]["position_tolerance"]);
  EXPECT_EQ(motion.tolerance.position_m, 0.002);
  std::size_t after = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    while (motion.kept[after] < i) ++after;
    if (motion.kept[after] == i) continue;
    EXPECT_LE(replay::ShownError(poses[motion.kept[after - 1]], poses[motion.kept[after]], poses[i],
                                 motion.tolerance),
              1.0)
        << i;
  }
}

// A step of the simulation ends millimetres beyond a line before operators act.
TEST_F(ReplayPayloadTest, OperatorsReflectAtTheLinesThatItNames) {
  const double line_m = source_.scenario.drive.terrain.arena.MirrorLine();
  EXPECT_THAT(payload_["course"]["mirror_lines"].get<std::vector<double>>(),
              ElementsAre(DoubleNear(-line_m, 1e-4), DoubleNear(line_m, 1e-4)));
  const auto breaks = payload_["motion"]["breaks"].get<std::vector<std::size_t>>();
  ASSERT_FALSE(breaks.empty());
  const auto y = Channel(payload_, "y");
  for (const std::size_t i : breaks) EXPECT_NEAR(std::abs(y[i]), line_m, 0.01) << i;
}

// What a step and a page show of the images of a drive's stereo cameras.

namespace fs = std::filesystem;
using testing::HasSubstr;

std::vector<std::string> Briefly(const std::string& fidelity) {
  return {"sensors.stereo.fidelity=" + fidelity, "sensors.stereo.images.pyramid_level=0",
          "rover.fidelity=quasi_static", "referee.time_limit_s=100"};
}

std::string Bytes(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class ReplayLooks : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  // Of the second decision.
  MomentsResult Step(const std::string& fidelity) const {
    return ReplayMoments(
        {.trial = {.source = std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/gestalt/abundance.json",
                   .overrides = Briefly(fidelity)},
         .step = 1,
         .folder = folder_});
  }

  static std::vector<std::string> NamesOf(const MomentsResult& result) {
    std::vector<std::string> names;
    for (const LookFile& file : result.look_files) names.push_back(file.name);
    return names;
  }

  std::size_t CsvPoints() const {
    const std::string csv = Bytes(folder_ / "points.csv");
    return static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')) - 1;
  }

  image_files::RawImage Png(const std::string& name) const {
    return image_files::DecodePng(Bytes(folder_ / name), name, {});
  }

  fs::path folder_;
};

TEST_F(ReplayLooks, AStepShowsImagesBesideTheMap) {
  const MomentsResult result = Step("image");
  ASSERT_EQ(result.outcome, Outcome::kDone);
  EXPECT_EQ(result.no_images, "");
  EXPECT_THAT(NamesOf(result),
              ElementsAre("front-left.png", "front-grid.png", "front-disparity.png",
                          "front-elevation.png", "front-cloud.ply"));
  EXPECT_THAT(result.look_files[0].what, HasSubstr("128 x 128"));
  EXPECT_EQ(Png("front-left.png").width(), 128);
  EXPECT_EQ(Png("front-grid.png").width(), 512);
  EXPECT_EQ(Png("front-disparity.png").height(), 512);
  EXPECT_GT(Png("front-elevation.png").width(), 256);
  ASSERT_GT(CsvPoints(), 1000U);
  EXPECT_THAT(Bytes(folder_ / "front-cloud.ply"),
              HasSubstr("element vertex " + std::to_string(CsvPoints()) + "\n"));
  EXPECT_TRUE(fs::exists(folder_ / "step.svg"));
}

TEST_F(ReplayLooks, WithoutImagesThereArePointsAndItSaysSo) {
  const MomentsResult result = Step("error_model");
  ASSERT_EQ(result.outcome, Outcome::kDone);
  EXPECT_THAT(result.no_images, HasSubstr("sensors.stereo.fidelity is error_model"));
  EXPECT_THAT(NamesOf(result), ElementsAre("front-elevation.png", "front-cloud.ply"));
  EXPECT_THAT(Bytes(folder_ / "front-cloud.ply"),
              HasSubstr("element vertex " + std::to_string(CsvPoints()) + "\n"));
  EXPECT_FALSE(fs::exists(folder_ / "front-left.png"));
}

TEST(ReplayEyes, ThePageHasEveryLookThatHadImages) {
  const Json payload = PayloadOf(SourceOf("gestalt/abundance", Briefly("image")), 0);
  const Json& looks = payload["eyes"]["looks"];
  EXPECT_EQ(payload["eyes"]["every"], 1);
  ASSERT_GT(looks.size(), 1U);
  EXPECT_EQ(static_cast<double>(looks.size()), ValueOf(payload, "image_sets"));
  // A decision follows its look: the same side of the rover, later.
  ASSERT_FALSE(payload["steps"].empty());
  double before_s = -1.0;
  for (const Json& look : looks) {
    EXPECT_GT(look["t"].get<double>(), before_s);
    before_s = look["t"];
    EXPECT_THAT(look["left"].get<std::string>(), HasSubstr("iVBORw0KGgo"));
    EXPECT_THAT(look["disparity"].get<std::string>(), HasSubstr("iVBORw0KGgo"));
    EXPECT_LT(look["left"].get<std::string>().size(), 30000U);
    EXPECT_LT(look["disparity"].get<std::string>().size(), 30000U);
  }
  EXPECT_LT(looks[0]["t"].get<double>(), payload["steps"][0]["t"].get<double>());
  EXPECT_GT(looks[0]["points"].get<int>(), 1000);
}

TEST(ReplayEyes, ATrialWithoutImagesHasNone) {
  EXPECT_TRUE(
      PayloadOf(SourceOf("gestalt/abundance", Briefly("error_model")), 0)["eyes"].is_null());
  EXPECT_TRUE(PayloadOf(SourceOf("pathfinder/nominal",
                                 {"rover.fidelity=quasi_static", "referee.time_limit_s=30"}),
                        0)["eyes"]
                  .is_null());
}

}  // namespace
}  // namespace rockyard::campaign
