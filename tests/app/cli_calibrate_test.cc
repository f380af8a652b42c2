// rockyard calibrate: rendered images of a chessboard to cameras that rockyard stereo reads, and
// what is said of images that give none.

#include <cmath>

#include "app/kill_runs.h"
#include "campaign/cylinder/painted_files.h"
#include "vision/calibration/rendered_target.h"
#include "vision/cameras/camera_file.h"

namespace rockyard::app {
namespace {

constexpr std::size_t kImages = 6;
// Four deviations of the principal point from six images.
constexpr double kWithin_px = 0.4;

std::string PgmOf(const vision::GrayImage& image) {
  std::string text =
      "P5\n" + std::to_string(image.width()) + " " + std::to_string(image.height()) + "\n255\n";
  for (const std::uint8_t value : image.values()) text += static_cast<char>(value);
  return text;
}

// On a disk that may be full.
class CliCalibrate : public KillRuns {
 protected:
  // Rendered once for all tests.
  static void SetUpTestSuite() {
    core::RandomStream stream({236, 0}, core::Purpose::kTest);
    const vision::TargetRenderer left({vision::TestCahvor(), vision::kTestSize});
    const vision::TargetRenderer right({vision::TestRightCahvor(), vision::kTestSize});
    const auto poses = vision::TestPoses(kImages);
    for (std::size_t i = 0; i < kImages; ++i) {
      const auto name = std::to_string(i) + ".pgm";
      images_["left" + name] = PgmOf(left.Render(vision::TestBoard(), poses[i], stream));
      images_["right" + name] = PgmOf(right.Render(vision::TestBoard(), poses[i], stream));
    }
  }

  CliCalibrate() {
    for (const auto& [name, bytes] : images_) WriteFile(work() / name, bytes);
    WriteFile(work() / "board.json", R"({"rows": 6, "columns": 9, "spacing_m": 0.03})");
  }

  static Words Names(const std::string& eye, std::size_t count = kImages) {
    Words names;
    for (std::size_t i = 0; i < count; ++i) names.push_back(eye + std::to_string(i) + ".pgm");
    return names;
  }

  CommandResult Calibrate(const Words& images, const Words& more = {}) const {
    Words words{"calibrate"};
    words.insert(words.end(), images.begin(), images.end());
    words.insert(words.end(), {"--target", "board.json", "--out", "out"});
    words.insert(words.end(), more.begin(), more.end());
    return Run(words);
  }

  // Exit code 2, these words, and nothing written.
  void ExpectRefused(const CommandResult& result, const Words& words) const {
    EXPECT_EQ(result.exit_code, 2);
    for (const std::string& word : words) EXPECT_THAT(result.err, HasSubstr(word));
    EXPECT_FALSE(fs::exists(work() / "out"));
  }

  static inline std::map<std::string, std::string> images_;
};

TEST_F(CliCalibrate, AFullDiskHoldsAllOrNothing) {
  const Words words =
      With(With({"calibrate"}, Names("left")), {"--target", "board.json", "--out", "a"});
  ExpectLacksAreTold(words, words, 1, true);
}

// Of the truth, over the middle of the image, at half a metre.
double LargestError_px(const vision::CameraModel& found, const vision::Cahvor& truth) {
  double largest_px = 0.0;
  for (const double column : {60.0, 160.0, 260.0}) {
    for (const double row : {40.0, 120.0, 200.0}) {
      const auto ray = vision::BackProject(truth, {column, row});
      const auto pixel = vision::Project(found, ray->origin + 0.5 * ray->direction);
      largest_px = std::max(largest_px, (*pixel - vision::Pixel(column, row)).norm());
    }
  }
  return largest_px;
}

TEST_F(CliCalibrate, APairOfCamerasThatStereoReads) {
  Words right{"--right"};
  for (const std::string& name : Names("right")) right.push_back(name);
  const CommandResult result = Calibrate(Names("left"), right);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, Says(" corners in 12 images of 320 x 240 pixels", "baseline 0.1"));
  const vision::CameraPair pair = vision::LoadCameraPair(work() / "out/cameras.json");
  EXPECT_LT(LargestError_px(pair.left, vision::TestCahvor()), kWithin_px);
  EXPECT_LT(LargestError_px(pair.right, vision::TestRightCahvor()), kWithin_px);
  const vision::CameraPair text = vision::LoadCameraPair(work() / "out/cameras.txt");
  EXPECT_EQ(std::get<vision::Cahvor>(text.right.lens), std::get<vision::Cahvor>(pair.right.lens));

  const json report = json::parse(ReadFile(work() / "out/calibration.json"));
  EXPECT_EQ(report["frame"], "first camera");
  EXPECT_EQ(report["fit"]["corners"].get<std::size_t>() + report["outliers"].size(), 648u);
  EXPECT_LT(report["outliers"].size(), 13u);
  EXPECT_EQ(report["cameras"][1]["name"], "right");
  EXPECT_EQ(report["cameras"][1]["covariance"].size(), 18u);
  EXPECT_EQ(report["cameras"][1]["predicted_error"].size(), 25u);
  EXPECT_EQ(report["images"].size(), 12u);
  EXPECT_LT(report["images"][7]["rms_px"], 0.06);
  EXPECT_NEAR(report["baseline_m"]["value"], std::sqrt(0.12 * 0.12 + 0.002 * 0.002 + 0.003 * 0.003),
              4.0 * report["baseline_m"]["sd"].get<double>());
  RunTo(0, {"stereo", "left2.pgm", "right2.pgm", "--cameras", "out/cameras.json", "--nearest",
            "0.25", "--out", "pair"});
}

TEST_F(CliCalibrate, OneCameraInTheFrameOfASurvey) {
  json target = json::parse(ReadFile(work() / "board.json"));
  // The frame of the survey: that of the camera, moved by X_SA.
  const math::Transform X_SA = math::MakePose({1.0, 2.0, 0.5}, 0.3, 0.2, -0.1);
  for (const math::Transform& X_AT : vision::TestPoses(kImages)) {
    const math::Transform X_ST = X_SA * X_AT;
    const Eigen::Quaterniond q(X_ST.linear());
    const math::Vector3 p = X_ST.translation();
    target["poses"].push_back(
        {{"position_m", {p.x(), p.y(), p.z()}}, {"rotation_wxyz", {q.w(), q.x(), q.y(), q.z()}}});
  }
  WriteFile(work() / "board.json", target.dump());
  const CommandResult result = Calibrate(Names("left"), {"--json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json report = json::parse(result.out);
  EXPECT_EQ(report["frame"], "survey");
  EXPECT_TRUE(report["baseline_m"].is_null());
  const vision::CameraModel camera = vision::LoadCamera(work() / "out/camera.json");
  EXPECT_LT((vision::CentreOf(camera) - math::Vector3(1.0, 2.0, 0.5)).norm(), 5e-4);
  EXPECT_LT(LargestError_px(camera, Moved(X_SA, vision::TestCahvor())), kWithin_px);

  target["poses"].erase(0);
  WriteFile(work() / "board.json", target.dump());
  EXPECT_THAT(Calibrate(Names("left")).err, HasSubstr("has 5 poses, there are 6 images"));
}

TEST_F(CliCalibrate, ALinearCameraOnRequest) {
  const CommandResult result = Calibrate(Names("left"), {"--model", "cahv"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(
      std::holds_alternative<vision::Cahv>(vision::LoadCamera(work() / "out/camera.txt").lens));
  const json report = json::parse(ReadFile(work() / "out/calibration.json"));
  EXPECT_EQ(report["cameras"][0]["covariance"].size(), 12u);
  EXPECT_GT(report["fit"]["rms_px"], 0.1);
}

TEST_F(CliCalibrate, ImagesWithoutATargetAreNamedAllAtOnce) {
  const std::string& good = images_.at("left1.pgm");
  // The upper half of the board is painted over.
  std::string hidden = good;
  for (std::size_t i = 15; i < 15 + 320 * 120; ++i) hidden[i] = '\x50';
  WriteFile(work() / "left1.pgm", hidden);
  WriteFile(work() / "left4.pgm", "P5\n320 240\n255\n" + std::string(320 * 240, '\x80'));
  ExpectRefused(Calibrate(Names("left")),
                {"left1.pgm: shows no chessboard of 6 x 9 inner corners",
                 "left4.pgm: shows no chessboard of 6 x 9 inner corners: the largest grid found "
                 "has 0"});
}

TEST_F(CliCalibrate, FilesThatCannotBeUsed) {
  WriteFile(work() / "left1.pgm", "P5\n320 240\n255\n cut");
  fs::remove(work() / "left3.pgm");
  ExpectRefused(Calibrate(Names("left")), {"left1.pgm: ", "left3.pgm: "});
  WriteFile(work() / "left1.pgm", "P5\n160 120\n255\n" + std::string(160 * 120, '\x80'));
  ExpectRefused(Calibrate(Names("left", 3)),
                {"left1.pgm: has 160 x 120 pixels, left0.pgm has 320"});
}

TEST_F(CliCalibrate, TooFewImagesOrOnesThatShowTheSame) {
  ExpectRefused(Calibrate(Names("left", 2)), {"targets: are seen in 2 images", "at least 3"});
  ExpectRefused(Calibrate({"left0.pgm", "left1.pgm", "left0.pgm"}), {"left0.pgm: is named twice"});
  for (const char* name : {"left0.pgm", "left1.pgm", "left2.pgm"}) {
    WriteFile(work() / name, images_.at("left3.pgm"));
  }
  ExpectRefused(Calibrate(Names("left", 4)), {"targets: show parallel planes"});
  ExpectRefused(Calibrate(Names("left", 4), {"--right", "right0.pgm"}),
                {"--right: names 1 images, the left camera has 4"});
}

TEST_F(CliCalibrate, TargetsThatAreNone) {
  const auto refused = [&](const std::string& target, const std::string& words) {
    WriteFile(work() / "board.json", target);
    ExpectRefused(Calibrate(Names("left")), {words});
  };
  refused("{", "board.json");
  refused(R"({"rows": 6, "columns": 9})", "board.json: spacing_m: is missing or 0");
  refused(R"({"rows": 2, "columns": 9, "spacing_m": 0.03})",
          "board.json: rows: is missing or below 3");
  refused(R"({"rows": 7, "columns": 9, "spacing_m": 0.03})", "half a turn");
  refused(R"({"rows": 6, "columns": 9, "spacing_m": 0.03, "poses": [{}]})",
          "board.json: poses[0].position_m: is missing");
  refused(R"({"rows": 6, "columns": 9, "spacing_m": 0.03, "poses": 3})", "is no list of poses");
  ExpectRefused(Run({"calibrate", "left0.pgm", "--out", "out"}), {"--target: is missing"});
  ExpectRefused(Run({"calibrate", "--target", "board.json", "--out", "out"}),
                {"IMAGE: is missing"});
  ExpectRefused(Run({"calibrate", "left0.pgm", "--target", "board.json"}), {"--out: is missing"});
}

// rockyard cylinder on files: what it says, its exit codes, and what is said of broken input.

// left.png, right.png and cameras.json of a cylinder 2 m away at 30 deg.
class CliCylinder : public CommandTest {
 protected:
  CliCylinder() { campaign::WritePaintedPair(work()); }

  static Words Pair(const Words& more = {}) {
    return With({"cylinder", "left.png", "right.png", "--cameras", "cameras.json"}, more);
  }

  // Exit code 2, these words, and nothing written.
  void ExpectRefused(const Words& words, const Words& said) const {
    const CommandResult result = RunTo(2, words);
    EXPECT_EQ(result.out, "");
    for (const std::string& word : said) EXPECT_THAT(result.err, HasSubstr(word));
    EXPECT_FALSE(fs::exists(work() / "seen"));
  }
};

class CylinderOnFullDisk : public KillRuns {};

TEST_F(CylinderOnFullDisk, AllOrNothingIsWritten) {
  campaign::WritePaintedPair(work());
  const Words words = {"cylinder",     "left.png", "right.png", "--cameras",
                       "cameras.json", "--out",    "a"};
  ExpectLacksAreTold(words, words, 1, true);
}

TEST_F(CliCylinder, AFoundOneIsToldWithItsUnits) {
  const CommandResult result = RunTo(0, Pair());
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, Says("left   left.png: ", "right  right.png: ", "\nfound\n",
                               " deg: azimuth of the cameras", " m by stereo, ", " m by size\n"));
  EXPECT_THAT(result.out, Not(HasSubstr("regions.png")));
  EXPECT_FALSE(fs::exists(work() / "seen"));
}

TEST_F(CliCylinder, JsonIsThatOfItsFile) {
  const CommandResult result = RunTo(0, Pair({"--json", "--out", "seen"}));
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
  EXPECT_THAT(RunTo(0, Pair({"--out", "seen", "--published"})).out,
              Says(" in seen/regions.png\n", " in seen/cylinder.json\n"));
}

TEST_F(CliCylinder, AMissIsInconclusiveAndSaysWhy) {
  const Words swapped = {"cylinder",     "right.png", "left.png", "--cameras",
                         "cameras.json", "--out",     "seen"};
  EXPECT_THAT(RunTo(4, swapped).out,
              AllOf(HasSubstr("\nnot found (swapped_eyes): "), Not(HasSubstr("deg"))));
  EXPECT_EQ(json::parse(ReadFile(work() / "seen/cylinder.json"))["miss"], "swapped_eyes");
}

TEST_F(CliCylinder, ParametersAreListedAndChangeWhatIsFound) {
  EXPECT_THAT(RunTo(0, {"cylinder", "--parameters"}).out,
              Says("robust.fit.least_margin", "cylinder.axis"));
  RunTo(4, Pair({"--param", "robust.candidates.least_whole_px=100000"}));
  ExpectRefused(Pair({"--out", "seen", "--param", "robust.fit.least_margins=1"}),
                {"robust.fit.least_margins", "least_margin"});
  ExpectRefused(Pair({"--out", "seen", "--param", "robust.fit.noise_grey=-1"}),
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
  ExpectRefused(Pair({"--out", "seen"}), {"right.png: "});
  WriteFile(work() / "right.png", ReadFile(work() / "left.png"));
  ExpectRefused(Pair({"--out", "seen"}), {"right.png: ", "the same as the left"});
}

TEST_F(CliCylinder, AFolderThatCannotBeMadeIsAnError) {
  EXPECT_THAT(RunTo(2, Pair({"--out", "left.png/seen"})).err, HasSubstr("left.png/seen"));
}

}  // namespace
}  // namespace rockyard::app
