// rockyard stereo: what it writes of a pair whose disparities are known, and what it says of pairs
// that are none.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "app/command.h"

namespace rockyard::app {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 96;
constexpr int kNear_px = 12;  // the left half of the wall
constexpr int kFar_px = 6;    // the right half

// Grains of about two pixels.
std::vector<int> Texture(std::uint32_t seed) {
  const int width = 2 * kWidth;
  std::vector<int> grains(static_cast<std::size_t>(width * kHeight));
  std::uint32_t state = seed;
  for (int& grain : grains) {
    state = state * 1664525U + 1013904223U;
    grain = static_cast<int>(state >> 24);
  }
  std::vector<int> smooth(grains.size(), 128);
  for (std::size_t i = 0; i + static_cast<std::size_t>(width) + 1 < grains.size(); ++i) {
    const auto below = i + static_cast<std::size_t>(width);
    smooth[i] = (grains[i] + grains[i + 1] + grains[below] + grains[below + 1]) / 4;
  }
  return smooth;
}

int TrueDisparity(int x) { return x < kWidth / 2 ? kNear_px : kFar_px; }

// The texture is fixed to the wall as the left eye sees it: what stands at (x, y) there stands at
// (x - d, y) in the right image.
std::string Pgm(bool right, std::uint32_t seed = 1) {
  const std::vector<int> texture = Texture(seed);
  std::string text = "P5\n" + std::to_string(kWidth) + " " + std::to_string(kHeight) + "\n255\n";
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      int from = x;
      // Of the two halves that may be seen here the nearer one hides the other.
      if (right) from = x + kNear_px < kWidth / 2 ? x + kNear_px : x + kFar_px;
      text += static_cast<char>(texture[static_cast<std::size_t>(y * 2 * kWidth + from)]);
    }
  }
  return text;
}

std::string Truth() {
  std::string text = "P2 " + std::to_string(kWidth) + " " + std::to_string(kHeight) + " 255\n";
  for (int i = 0; i < kWidth * kHeight; ++i) {
    text += std::to_string(4 * TrueDisparity(i % kWidth)) + "\n";
  }
  return text;
}

std::string SmallPgm() {
  std::string text = "P2 20 20 255\n";
  for (int i = 0; i < 400; ++i) text += "1\n";
  return text;
}

// 200 px of focal length, 0.1 m apart; x to the right, y down, z ahead.
std::string Cameras(int columns = kWidth) {
  const auto camera = [&](const char* eye, double x_m) {
    return "Camera = " + std::string(eye) +
           "\nModel = CAHV\nDimensions = " + std::to_string(columns) + " " +
           std::to_string(kHeight) + "\nC = " + std::to_string(x_m) +
           " 0 0\nA = 0 0 1\nH = 200 0 79.5\nV = 0 200 47.5\n";
  };
  return camera("left", 0.0) + camera("right", 0.1);
}

class CliStereo : public CommandTest {
 protected:
  CliStereo() {
    WriteFile(work() / "left.pgm", Pgm(false));
    WriteFile(work() / "right.pgm", Pgm(true));
  }

  json Summary(const std::string& folder) const {
    return json::parse(ReadFile(work() / folder / "stereo.json"));
  }
};

TEST_F(CliStereo, FindsTheDisparitiesOfAnAlignedPair) {
  WriteFile(work() / "truth.pgm", Truth());
  const CommandResult result = RunTo(0, {"stereo", "left.pgm", "right.pgm", "--out", "pair",
                                         "--reference", "truth.pgm", "--reference-samples", "4"});
  EXPECT_THAT(result.out, HasSubstr("160 x 96 pixels, taken as aligned, disparities -1 to 20 px"));
  const json summary = Summary("pair");
  EXPECT_GT(summary["pixels"]["density"], 0.6);
  // Windows over the step between the halves take the nearer disparity up to half a window beyond
  // it: 3 of some 140 columns, by 6 px.
  EXPECT_LT(summary["score"]["bad"]["above_1_px"], 0.03);
  EXPECT_LT(summary["score"]["rms_error_px"], 6.0 * std::sqrt(0.03));
  EXPECT_TRUE(summary["cameras"].is_null());
  std::int64_t all = summary["pixels"]["matched"];
  for (const auto& dropped : summary["pixels"]["dropped"]) all += dropped.get<std::int64_t>();
  EXPECT_EQ(all, kWidth * kHeight);
  for (const char* name : {"disparity.pfm", "disparity.png", "picture.png"}) {
    EXPECT_TRUE(fs::exists(work() / "pair" / name)) << name;
  }
  EXPECT_FALSE(fs::exists(work() / "pair/points.ply"));
}

TEST_F(CliStereo, CamerasGivePointsAtTheirDepths) {
  WriteFile(work() / "cameras.txt", Cameras());
  const CommandResult result = RunTo(0, {"stereo", "left.pgm", "right.pgm", "--out", "pair",
                                         "--cameras", "cameras.txt", "--nearest", "1", "--json"});
  const json summary = json::parse(result.out);
  EXPECT_NEAR(summary["cameras"]["baseline_m"], 0.1, 1e-12);
  // f B / 1 m = 20 px, and one more at either end.
  EXPECT_EQ(summary["parameters"]["correlator"]["disparities"], 23);
  EXPECT_GT(summary["points"], 8000);
  const std::string ply = ReadFile(work() / "pair/points.ply");
  const std::size_t data = ply.find("end_header\n") + 11;
  std::vector<float> depths_m;
  for (std::size_t at = data; at + 15 <= ply.size(); at += 15) {
    float z_m = 0.0F;
    std::memcpy(&z_m, ply.data() + at + 8, sizeof z_m);
    depths_m.push_back(z_m);
  }
  ASSERT_EQ(depths_m.size(), summary["points"].get<std::size_t>());
  // Z = f B / d: 1.667 m of the nearer half, 3.333 m of the other.
  const auto near = std::count_if(depths_m.begin(), depths_m.end(),
                                  [](float z_m) { return std::abs(z_m - 1.667F) < 0.07F; });
  const auto far = std::count_if(depths_m.begin(), depths_m.end(),
                                 [](float z_m) { return std::abs(z_m - 3.333F) < 0.2F; });
  EXPECT_GT(near, 3000);
  EXPECT_GT(far, 3000);
  EXPECT_GT(near + far, 0.98 * static_cast<double>(depths_m.size()));
  EXPECT_TRUE(fs::exists(work() / "pair/elevation.png"));
}

TEST_F(CliStereo, ThreadsAndRepetitionChangeNothing) {
  RunTo(0, {"stereo", "left.pgm", "right.pgm", "--out", "one"});
  RunTo(0, {"stereo", "left.pgm", "right.pgm", "--out", "three", "--threads", "3"});
  EXPECT_EQ(ReadFile(work() / "one/disparity.pfm"), ReadFile(work() / "three/disparity.pfm"));
  RunTo(0, {"stereo", "left.pgm", "right.pgm", "--out", "one"});
}

TEST_F(CliStereo, ParametersAreListedAndChanged) {
  EXPECT_THAT(RunTo(0, {"stereo", "--parameters"}).out, HasSubstr("`correlator.window_side_px`"));
  const CommandResult result = RunTo(
      0, {"stereo", "left.pgm", "right.pgm", "--out", "pair", "--param",
          "correlator.window_side_px=9", "--param", "correlator.min_disparity_px=3", "--json"});
  const json parameters = json::parse(result.out)["parameters"];
  EXPECT_EQ(parameters["correlator"]["window_side_px"], 9);
  EXPECT_EQ(parameters["correlator"]["min_disparity_px"], 3);
}

// The right image stands three rows lower.
TEST_F(CliStereo, AlignsRowsByTheMatchesOfThePair) {
  const std::string pgm = Pgm(true);
  const std::size_t head = pgm.size() - static_cast<std::size_t>(kWidth * kHeight);
  std::string lower = pgm.substr(0, head) + pgm.substr(head, 3 * kWidth);
  lower += pgm.substr(head, static_cast<std::size_t>((kHeight - 3) * kWidth));
  WriteFile(work() / "lower.pgm", lower);
  const CommandResult without = RunTo(2, {"stereo", "left.pgm", "lower.pgm", "--out", "without"});
  const CommandResult result =
      RunTo(0, {"stereo", "left.pgm", "lower.pgm", "--align", "--out", "aligned"});
  EXPECT_THAT(result.out, HasSubstr("rows of the right image moved by -3.0"));
  const json summary = Summary("aligned");
  EXPECT_NEAR(summary["alignment"]["offset_px"], 3.0, 0.1);
  EXPECT_GT(summary["pixels"]["density"], 0.5);
  // Without matches nothing is aligned, and with cameras there is no need.
  WriteFile(work() / "other.pgm", Pgm(true, 2));
  RunTo(2, {"stereo", "left.pgm", "other.pgm", "--align", "--out", "no"});
  WriteFile(work() / "cameras.txt", Cameras());
  const CommandResult both = RunTo(
      2, {"stereo", "left.pgm", "right.pgm", "--align", "--cameras", "cameras.txt", "--out", "no"});
  EXPECT_THAT(both.err, HasSubstr("--align: is for pairs without cameras"));
}

// Nothing is written, and what is wrong is said with what would be right.
TEST_F(CliStereo, RefusesWhatIsNoPair) {
  WriteFile(work() / "other.pgm", Pgm(true, 2));
  WriteFile(work() / "small.pgm", SmallPgm());
  WriteFile(work() / "broken.pgm", Pgm(false).substr(0, 3000));
  WriteFile(work() / "cameras.txt", Cameras());
  WriteFile(work() / "large.txt", Cameras(1024));
  WriteFile(work() / "truth.pgm", SmallPgm());
  struct Wrong {
    Words words;
    std::string said;
  };
  const std::vector<Wrong> all{
      {{"left.pgm", "left.pgm"}, "shows the same as the left image"},
      {{"right.pgm", "left.pgm"}, "with the eyes swapped many more have"},
      {{"left.pgm", "other.pgm"}, "of the pixels have a match in the right image"},
      {{"left.pgm", "small.pgm"}, "has 20 x 20 pixels, the left image 160 x 96"},
      {{"left.pgm", "broken.pgm"}, "broken.pgm"},
      {{"left.pgm", "nowhere.pgm"}, "nowhere.pgm"},
      {{"left.pgm"}, "RIGHT: is missing"},
      {{"left.pgm", "right.pgm", "--cameras", "large.txt"}, "is a camera of 1024 x 96 pixels"},
      {{"left.pgm", "right.pgm", "--nearest", "1"}, "means nothing without cameras"},
      {{"left.pgm", "right.pgm", "--farthest", "1"}, "needs --nearest"},
      {{"left.pgm", "right.pgm", "--cameras", "cameras.txt", "--nearest", "0.001"}, "disparities"},
      {{"left.pgm", "right.pgm", "--cameras", "cameras.txt", "--nearest", "5", "--farthest", "1"},
       "--farthest: is nearer than --nearest"},
      {{"left.pgm", "right.pgm", "--param", "correlator.window=9"}, "correlator.window"},
      {{"left.pgm", "right.pgm", "--param", "pyramid_level=6"}, "at pyramid level 6"},
      {{"left.pgm", "right.pgm", "--reference", "truth.pgm"}, "has 20 x 20 pixels"},
      {{"left.pgm", "right.pgm", "--white", "0"}, "--white"},
  };
  for (const Wrong& wrong : all) {
    Words words{"stereo"};
    words.insert(words.end(), wrong.words.begin(), wrong.words.end());
    words.insert(words.end(), {"--out", "wrong"});
    const CommandResult result = Run(words);
    EXPECT_EQ(result.exit_code, 2) << wrong.said;
    EXPECT_THAT(result.err, Says(wrong.said, "  try: "));
    EXPECT_FALSE(fs::exists(work() / "wrong")) << wrong.said;
  }
}

TEST_F(CliStereo, TexturelessImagesAreNoErrorButANote) {
  const std::string head = "P5\n160 96\n255\n";
  WriteFile(work() / "a.pgm", head + std::string(kWidth * kHeight, '\x64'));
  WriteFile(work() / "b.pgm", head + std::string(kWidth * kHeight, '\x65'));
  EXPECT_THAT(RunTo(0, {"stereo", "a.pgm", "b.pgm", "--out", "blank"}).out,
              HasSubstr("no pixel has a match: the images show too little texture"));
  EXPECT_EQ(Summary("blank")["pixels"]["matched"], 0);
}

TEST_F(CliStereo, EightBitsInSixteenAreToldOfWithTheWhiteThatHelps) {
  const auto in_sixteen = [&](const char* name) {
    std::string text = "P5\n160 96\n65535\n";
    for (const char sample : ReadFile(work() / name).substr(14)) {
      text += {'\0', sample};
    }
    WriteFile(work() / (std::string("16_") + name), text);
  };
  in_sixteen("left.pgm");
  in_sixteen("right.pgm");
  const Words words{"stereo", "16_left.pgm", "16_right.pgm", "--out"};
  EXPECT_THAT(RunTo(0, With(words, {"dark"})).out, HasSubstr("--white 255 would keep more"));
  EXPECT_THAT(RunTo(0, With(words, {"right", "--white", "255"})).out, Not(HasSubstr("--white")));
}

// Noise of two grey levels either way is no texture, though the matching's gain makes more of them:
// such a pair is not told that it is none.
TEST_F(CliStereo, NoiseIsNoTexture) {
  const auto noise = [](std::uint32_t seed) {
    std::string text = "P5\n160 96\n255\n";
    for (const int grain : Texture(seed)) {
      if (text.size() == 14 + static_cast<std::size_t>(kWidth * kHeight)) break;
      text += static_cast<char>(98 + grain % 5);
    }
    return text;
  };
  WriteFile(work() / "a.pgm", noise(7));
  WriteFile(work() / "b.pgm", noise(8));
  EXPECT_THAT(RunTo(0, {"stereo", "a.pgm", "b.pgm", "--out", "blank", "--param",
                        "filters.blob_min_px=2000"})
                  .out,
              HasSubstr("no pixel has a match: the images show too little texture"));
}

TEST_F(CliStereo, AFolderThatCannotBeMadeIsSaid) {
  WriteFile(work() / "file", "");
  EXPECT_THAT(RunTo(2, {"stereo", "left.pgm", "right.pgm", "--out", "file/pair"}).err,
              HasSubstr("file/pair: cannot be made"));
}

// rockyard render: files that rockyard stereo reads, and truth that it can be held against.

class CliRender : public CommandTest {
 protected:
  static Words Render(const std::string& folder, int level = 0) {
    return {"render", Source("scenarios/gestalt/abundance.json"),
            "--out",  folder,
            "--set",  "sensors.stereo.images.pyramid_level=" + std::to_string(level)};
  }
};

TEST_F(CliRender, WhatItWritesIsMatchedAndHeldAgainstTheTruth) {
  const CommandResult rendered = RunTo(0, Render("pair", 1));
  EXPECT_THAT(rendered.out, Says("256 x 256 pixels each, exposed for ",
                                 "rover at x 0.00 m, y 0.00 m, heading 0.0 deg"));
  for (const char* name :
       {"left.png", "right.png", "cameras.json", "disparity.pfm", "disparity.png"}) {
    EXPECT_TRUE(fs::exists(work() / "pair" / name)) << name;
  }
  const CommandResult matched = RunTo(
      0, {"stereo", "pair/left.png", "pair/right.png", "--cameras", "pair/cameras.json",
          "--nearest", "0.3", "--reference", "pair/disparity.pfm", "--out", "stereo", "--json"});
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
  RunTo(0, Render("start"));
  const std::string left = ReadFile(work() / "start/left.png");
  RunTo(0, Render("again"));
  EXPECT_EQ(ReadFile(work() / "again/left.png"), left);
  const std::vector<Words> changes = {{"--x", "1.5"},
                                      {"--y", "-0.5"},
                                      {"--heading", "40"},
                                      {"--behind"},
                                      {"--trial", "1"},
                                      {"--seed", "5"},
                                      {"--set", "sensors.sun.elevation_deg=15"}};
  for (const Words& change : changes) {
    Words command = Render("other");
    command.insert(command.end(), change.begin(), change.end());
    const CommandResult result = RunTo(0, command);
    EXPECT_NE(ReadFile(work() / "other/left.png"), left) << change.front();
  }
}

TEST_F(CliRender, MistakesAreExplained) {
  EXPECT_THAT(RunTo(2, {"render", Source("scenarios/gestalt/abundance.json")}).err,
              HasSubstr("--out: is missing"));
  Words command = Render("pair");
  command.insert(command.end(), {"--set", "sensors.look.soil_graininess=2"});
  EXPECT_THAT(RunTo(2, command).err, HasSubstr("sensors.look.soil_graininess"));
  EXPECT_FALSE(fs::exists(work() / "pair"));
  WriteFile(work() / "file", "x");
  RunTo(2, Render("file"));
}

}  // namespace
}  // namespace rockyard::app
