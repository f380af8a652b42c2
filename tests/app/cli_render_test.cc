// rockyard render: files that rockyard stereo reads, and truth that it can be held against.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/command.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

class CliRender : public CommandTest {
 protected:
  static std::vector<std::string> Render(const std::string& folder, int level = 0) {
    return {"render", std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/gestalt/abundance.json",
            "--out",  folder,
            "--set",  "sensors.stereo.images.pyramid_level=" + std::to_string(level)};
  }
};

TEST_F(CliRender, WhatItWritesIsMatchedAndHeldAgainstTheTruth) {
  const CommandResult rendered = Run(Render("pair", 1));
  ASSERT_EQ(rendered.exit_code, 0) << rendered.err;
  EXPECT_THAT(rendered.out, Says("256 x 256 pixels each, exposed for ",
                                 "rover at x 0.00 m, y 0.00 m, heading 0.0 deg"));
  for (const char* name :
       {"left.png", "right.png", "cameras.json", "disparity.pfm", "disparity.png"}) {
    EXPECT_TRUE(fs::exists(work() / "pair" / name)) << name;
  }
  const CommandResult matched =
      Run({"stereo", "pair/left.png", "pair/right.png", "--cameras", "pair/cameras.json",
           "--nearest", "0.3", "--reference", "pair/disparity.pfm", "--out", "stereo", "--json"});
  ASSERT_EQ(matched.exit_code, 0) << matched.err;
  const json summary = json::parse(matched.out);
  // f = 128 px / tan(55 deg), as the scenario has the view.
  EXPECT_NEAR(summary["cameras"]["focal_px"], 89.63, 0.01);
  EXPECT_NEAR(summary["cameras"]["baseline_m"], 0.12, 1e-9);
  EXPECT_EQ(summary["size"]["rows"], 256);
  EXPECT_GT(summary["score"]["density"], 0.6);
  EXPECT_LT(summary["score"]["bad"]["above_1_px"], 0.06);
  EXPECT_LT(std::abs(summary["score"]["mean_error_px"].get<double>()), 0.2);
}

TEST_F(CliRender, PlaceDirectionTrialAndLightChangeTheImages) {
  ASSERT_EQ(Run(Render("start")).exit_code, 0);
  const std::string left = ReadFile(work() / "start/left.png");
  ASSERT_EQ(Run(Render("again")).exit_code, 0);
  EXPECT_EQ(ReadFile(work() / "again/left.png"), left);
  const std::vector<std::vector<std::string>> changes = {{"--x", "1.5"},
                                                         {"--y", "-0.5"},
                                                         {"--heading", "40"},
                                                         {"--behind"},
                                                         {"--trial", "1"},
                                                         {"--seed", "5"},
                                                         {"--set", "sensors.sun.elevation_deg=15"}};
  for (const std::vector<std::string>& change : changes) {
    std::vector<std::string> command = Render("other");
    command.insert(command.end(), change.begin(), change.end());
    const CommandResult result = Run(command);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(ReadFile(work() / "other/left.png"), left) << change.front();
  }
}

TEST_F(CliRender, MistakesAreExplained) {
  EXPECT_THAT(
      RunTo(2, {"render", std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/gestalt/abundance.json"})
          .err,
      HasSubstr("--out: is missing"));
  std::vector<std::string> command = Render("pair");
  command.insert(command.end(), {"--set", "sensors.look.soil_graininess=2"});
  EXPECT_THAT(RunTo(2, command).err, HasSubstr("sensors.look.soil_graininess"));
  EXPECT_FALSE(fs::exists(work() / "pair"));
  WriteFile(work() / "file", "x");
  RunTo(2, Render("file"));
}

}  // namespace
}  // namespace rockyard::app
