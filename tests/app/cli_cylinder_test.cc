// rockyard cylinder on files: what it says, its exit codes, and what is said of broken input.
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/kill_runs.h"
#include "campaign/cylinder/painted_files.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// left.png, right.png and cameras.json of a cylinder 2 m away at 30 deg.
class CliCylinder : public CommandTest {
 protected:
  CliCylinder() { campaign::WritePaintedPair(work()); }

  static std::vector<std::string> Words(const std::vector<std::string>& more = {}) {
    return With({"cylinder", "left.png", "right.png", "--cameras", "cameras.json"}, more);
  }

  // Exit code 2, these words, and nothing written.
  void ExpectRefused(const std::vector<std::string>& words,
                     const std::vector<std::string>& said) const {
    const CommandResult result = RunTo(2, words);
    EXPECT_EQ(result.out, "");
    for (const std::string& word : said) EXPECT_THAT(result.err, HasSubstr(word));
    EXPECT_FALSE(fs::exists(work() / "seen"));
  }
};

class CylinderOnFullDisk : public KillRuns {};

TEST_F(CylinderOnFullDisk, AllOrNothingIsWritten) {
  campaign::WritePaintedPair(work());
  const std::vector<std::string> words = {"cylinder",     "left.png", "right.png", "--cameras",
                                          "cameras.json", "--out",    "a"};
  ExpectLacksAreTold(words, words, 1, true);
}

TEST_F(CliCylinder, AFoundOneIsToldWithItsUnits) {
  const CommandResult result = RunTo(0, Words());
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, Says("left   left.png: ", "right  right.png: ", "\nfound\n",
                               " deg: azimuth of the cameras", " m by stereo, ", " m by size\n"));
  EXPECT_THAT(result.out, Not(HasSubstr("regions.png")));
  EXPECT_FALSE(fs::exists(work() / "seen"));
}

TEST_F(CliCylinder, JsonIsThatOfItsFile) {
  const CommandResult result = Run(Words({"--json", "--out", "seen"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  json printed = json::parse(result.out);
  EXPECT_EQ(printed["found"], true);
  EXPECT_NEAR(printed["sighting"]["orientation_deg"].get<double>(), 30.0, 1.0);
  EXPECT_TRUE(fs::exists(work() / "seen/regions.png"));
  json written = json::parse(ReadFile(work() / "seen/cylinder.json"));
  printed.erase("files");
  written.erase("files");
  EXPECT_EQ(printed, written);
}

TEST_F(CliCylinder, FilesAreToldWhereTheyAreAsked) {
  EXPECT_THAT(RunTo(0, Words({"--out", "seen", "--published"})).out,
              Says(" in seen/regions.png\n", " in seen/cylinder.json\n"));
}

TEST_F(CliCylinder, AMissIsInconclusiveAndSaysWhy) {
  const std::vector<std::string> swapped = {"cylinder",     "right.png", "left.png", "--cameras",
                                            "cameras.json", "--out",     "seen"};
  EXPECT_THAT(RunTo(4, swapped).out,
              AllOf(HasSubstr("\nnot found (swapped_eyes): "), Not(HasSubstr("deg"))));
  EXPECT_EQ(json::parse(ReadFile(work() / "seen/cylinder.json"))["miss"], "swapped_eyes");
}

TEST_F(CliCylinder, ParametersAreListedAndChangeWhatIsFound) {
  EXPECT_THAT(RunTo(0, {"cylinder", "--parameters"}).out,
              Says("robust.fit.least_margin", "cylinder.axis"));
  RunTo(4, Words({"--param", "robust.candidates.least_whole_px=100000"}));
  ExpectRefused(Words({"--out", "seen", "--param", "robust.fit.least_margins=1"}),
                {"robust.fit.least_margins", "least_margin"});
  ExpectRefused(Words({"--out", "seen", "--param", "robust.fit.noise_grey=-1"}),
                {"robust.fit.noise_grey"});
}

TEST_F(CliCylinder, WhatIsMissingIsNamed) {
  ExpectRefused({"cylinder"}, {"LEFT: is missing"});
  ExpectRefused({"cylinder", "left.png"}, {"RIGHT: is missing"});
  ExpectRefused({"cylinder", "left.png", "right.png"}, {"--cameras: is missing"});
  ExpectRefused({"cylinder", "none.png", "right.png", "--cameras", "cameras.json"}, {"none.png"});
  ExpectRefused({"cylinder", "left.png", "right.png", "--cameras", "left.png"}, {"left.png"});
}

TEST_F(CliCylinder, BrokenImagesAreRefusedBeforeAnythingIsWritten) {
  const std::string good = ReadFile(work() / "right.png");
  WriteFile(work() / "right.png", good.substr(0, good.size() / 2));
  ExpectRefused(Words({"--out", "seen"}), {"right.png: "});
  WriteFile(work() / "right.png", ReadFile(work() / "left.png"));
  ExpectRefused(Words({"--out", "seen"}), {"right.png: ", "the same as the left"});
}

TEST_F(CliCylinder, AFolderThatCannotBeMadeIsAnError) {
  EXPECT_THAT(RunTo(2, Words({"--out", "left.png/seen"})).err, HasSubstr("left.png/seen"));
}

}  // namespace
}  // namespace rockyard::app
