// What a step and a page show of the images of a drive's stereo cameras.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "campaign/replay_moments.h"
#include "campaign/replay_payloads.h"
#include "image_files/png_file.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
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
