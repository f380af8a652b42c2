// Cameras and pairs as files, in JSON and in the text form of flight calibrations.
#include "vision/cameras/camera_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/json_text.h"
#include "core/refusals.h"
#include "core/test_folder.h"
#include "vision/cameras/camera_text.h"
#include "vision/cameras/test_cameras.h"

namespace rockyard::vision {
namespace {

using math::Vector3;

// Cameras and pairs as files, JSON or text.

// The same camera to the eye: the rays of some pixels.
void ExpectSameRays(const CameraModel& a, const CameraModel& b, double tolerance) {
  EXPECT_EQ(a.size, b.size);
  ASSERT_EQ(a.lens.index(), b.lens.index());
  for (const Pixel& pixel : {Pixel(10, 20), Pixel(600, 30), Pixel(300, 400)}) {
    const auto first = BackProject(a, pixel);
    const auto second = BackProject(b, pixel);
    ASSERT_TRUE(first && second);
    EXPECT_LE((first->direction - second->direction).norm(), tolerance);
    EXPECT_LE((first->origin - second->origin).norm(), tolerance);
  }
}

TEST(CameraFileTest, EveryModelReadsBackFromItsJson) {
  for (const NamedCamera& named : ModelCameras()) {
    const std::string text = core::DumpJson(CameraJson(named.camera));
    const bool is_brown = std::holds_alternative<BrownPinhole>(named.camera.lens);
    ExpectSameRays(ParseCamera(text, "x"), named.camera, is_brown ? 1e-14 : 0.0);
  }
}

TEST(CameraFileTest, APairReadsBackFromItsJsonAndItsText) {
  const CameraPair pair{FlightCamera("MER2_NAVCAM_LEFT_sol767"),
                        FlightCamera("MER2_NAVCAM_RIGHT_sol767")};
  for (const std::string& content : {core::DumpJson(CameraPairJson(pair)), CameraPairText(pair)}) {
    const CameraPair back = ParseCameraPair(content, "x");
    ExpectSameRays(back.left, pair.left, 0.0);
    ExpectSameRays(back.right, pair.right, 0.0);
  }
}

TEST(CameraFileTest, FilesOfBothFormsAreLoaded) {
  const core::TestFolder own;
  const std::filesystem::path& folder = own.path();
  const CameraModel camera = FlightCamera("M2020_HAZFLA");
  std::ofstream(folder / "eye.json") << "\n  " << core::DumpJson(CameraJson(camera));
  std::ofstream(folder / "eye.cahvore") << CameraText(camera, "an eye");
  std::ofstream(folder / "pair.json") << core::DumpJson(CameraPairJson({camera, camera}));
  ExpectSameRays(LoadCamera(folder / "eye.json"), camera, 0.0);
  ExpectSameRays(LoadCamera(folder / "eye.cahvore"), camera, 0.0);
  ExpectSameRays(LoadCameraPair(folder / "pair.json").right, camera, 0.0);
  EXPECT_THROW(LoadCamera(folder / "none.json"), core::UserError);
  EXPECT_THROW(LoadCamera(folder), core::UserError);
  std::ofstream(folder / "long.cahv") << CameraText(camera) << std::string(2 << 20, ' ');
  EXPECT_THROW(LoadCamera(folder / "long.cahv"), core::UserError);
}

std::string JsonProblem(const std::string& text, bool as_pair = false) {
  const auto problems = core::ProblemsIn(
      [&] { as_pair ? void(ParseCameraPair(text, "f")) : void(ParseCamera(text, "f")); });
  if (problems.empty()) return "none";
  EXPECT_LE(problems.size(), as_pair ? 2U : 1U);
  EXPECT_FALSE(problems.front().suggestion.empty());
  return problems.front().path + " " + problems.front().reason;
}

TEST(CameraFileTest, ProblemsAreToldByTheirPaths) {
  const std::string linear =
      R"("columns": 640, "rows": 480, "C": [0, 0, 0], "A": [0, 0, 1], "H": [300, 0, 320], )";
  EXPECT_EQ(JsonProblem(R"({"model": "cahv", )" + linear + R"("V": [0, 300, 240]})"), "none");
  EXPECT_EQ(JsonProblem(R"({"model": "cahv", )" + linear + R"("V": [0, 300]})"),
            "f: V has 2 elements, not 3");
  EXPECT_EQ(JsonProblem(R"({"model": "cahv", )" + linear + R"("V": [0, "x", 240]})"),
            "f: V[1] is \"x\" (a text), not a number");
  EXPECT_EQ(JsonProblem(R"({"model": "cahw", )" + linear + R"("V": [0, 300, 240]})"),
            "f: model is \"cahw\", which is not a known name");
  EXPECT_EQ(
      JsonProblem(R"({"model": "cahv", "E": [0, 0, 0], )" + linear + R"("V": [0, 300, 240]})"),
      "f: E is not a known key");
  EXPECT_EQ(JsonProblem("{").substr(0, 18), "f line 1, column 2");
  EXPECT_EQ(JsonProblem(R"({"left": {}, "right": {}})", true), "f: left.model is missing");
  EXPECT_EQ(JsonProblem(R"({"left": 3})", true), "f: left is 3 (an integer), not an object");
  EXPECT_EQ(JsonProblem(std::string(2 << 20, ' ') + "{}").substr(0, 1), "f");
  const std::string brown =
      R"({"model": "brown", "columns": 64, "rows": 48, "position_m": [0, 0, 0],
          "centre_px": [32, 24], "radial": [0, 0, 0], "tangential": [0, 0], )";
  EXPECT_EQ(JsonProblem(brown + R"("rotation_wxyz": [1, 0, 0, 0], "focal_px": [50, 50]})"), "none");
  EXPECT_EQ(JsonProblem(brown + R"("rotation_wxyz": [1, 0, 0, 0.5], "focal_px": [50, 50]})"),
            "f: rotation_wxyz is not of length 1");
  EXPECT_EQ(JsonProblem(brown + R"("rotation_wxyz": [1, 0, 0, 0], "focal_px": [50, 0]})"),
            "f: focal_px[1] is 0, below the smallest allowed value 0.001");
}

// The text form of flight calibrations.

const char* const kFisheye = R"(# A fisheye on a mast.
Model = CAHVORE3,0.37 = general

Dimensions = 1024 768

C = 0.1 0.25 -1.2   # m
A = 1 0 0
H = 511.5 400 0
V = 383.5 0 400
O = 1 0 0
R = 0 -0.013 -7.5e-3
E = +0.001 0.002 0.0015

S =
  1.0e-05  2.0e-06 0
 -2.0e-06  1.0e-05 0

Hs    = 400.0
Hc    = 511.5
Vs    = 400.0
Vc    = 383.5
Theta = -1.570796 (-90.0 deg)

S internal =
  1.0 0.0
)";

std::string ProblemsOf(const std::string& text, bool as_pair = false) {
  const auto problems = core::ProblemsIn([&] {
    as_pair ? void(ParseCameraPairText(text, "eye.cahv")) : void(ParseCameraText(text, "eye.cahv"));
  });
  std::string all;
  for (const core::Problem& problem : problems) {
    EXPECT_EQ(problem.path, "eye.cahv");
    EXPECT_FALSE(problem.suggestion.empty());
    all += problem.reason + "; ";
  }
  return problems.empty() ? "none" : all;
}

std::string Linear(const std::string& model = "CAHV") {
  return "Model = " + model + "\nDimensions = 640 480\nC = 0 0 0\nA = 0 0 1\nH = 300 0 320\n" +
         "V = 0 300 240\n";
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(CameraTextTest, AFlightCalibrationIsReadWithAllThatSurroundsIt) {
  const CameraModel camera = ParseCameraText(kFisheye, "eye.cahvore");
  EXPECT_EQ(camera.size, (ImageSize{1024, 768}));
  const auto& lens = std::get<Cahvore>(camera.lens);
  EXPECT_EQ(lens.linear.C, Vector3(0.1, 0.25, -1.2));
  EXPECT_EQ(lens.linear.A, Vector3(1, 0, 0));
  EXPECT_EQ(lens.linear.H, Vector3(511.5, 400, 0));
  EXPECT_EQ(lens.linear.V, Vector3(383.5, 0, 400));
  EXPECT_EQ(lens.O, Vector3(1, 0, 0));
  EXPECT_EQ(lens.R, Vector3(0, -0.013, -0.0075));
  EXPECT_EQ(lens.E, Vector3(0.001, 0.002, 0.0015));
  EXPECT_EQ(lens.type, CahvoreType::kGeneral);
  EXPECT_EQ(lens.general_linearity, 0.37);
}

TEST(CameraTextTest, EveryNameOfAModelIsKnown) {
  const std::string lens = "O = 0 0 1\nR = 0 0.01 0\n";
  const std::string pupil = lens + "E = 0 0 0\n";
  EXPECT_TRUE(std::holds_alternative<Cahv>(
      ParseCameraText(Linear("CAHV = perspective, linear"), "x").lens));
  EXPECT_TRUE(std::holds_alternative<Cahvor>(ParseCameraText(Linear("CAHVOR") + lens, "x").lens));
  const auto type = [&](const std::string& model, const std::string& more) {
    return std::get<Cahvore>(ParseCameraText(Linear(model) + pupil + more, "x").lens).type;
  };
  EXPECT_EQ(type("CAHVORE1 = perspective, distortion, pupil", ""), CahvoreType::kPerspective);
  EXPECT_EQ(type("CAHVORE2 = fish-eye", ""), CahvoreType::kFisheye);
  EXPECT_EQ(type("CAHVORE", "Mtype = 2\nMparm = 0\n"), CahvoreType::kFisheye);
  EXPECT_EQ(type("CAHVORE", "T = 3\nP = 0.2\n"), CahvoreType::kGeneral);
  EXPECT_EQ(type("CAHVORE1", "P = 0.2\n"), CahvoreType::kPerspective);
  const std::string other = Replaced(Linear(), "Model", "Mclass");
  EXPECT_TRUE(std::holds_alternative<Cahv>(ParseCameraText(other, "x").lens));
}

TEST(CameraTextTest, LinesMayEndAsOnWindowsAndWithout) {
  std::string text = Linear();
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 2)) {
    text.replace(at, 1, "\r\n");
  }
  EXPECT_EQ(ProblemsOf(text), "none");
  EXPECT_EQ(ProblemsOf(Linear().substr(0, Linear().size() - 1)), "none");
}

TEST(CameraTextTest, WhatIsWrittenReadsBackToTheSameBits) {
  for (const NamedCamera& named : ModelCameras()) {
    if (std::holds_alternative<BrownPinhole>(named.camera.lens)) continue;
    const CameraModel back =
        ParseCameraText(CameraText(named.camera, named.name + "\nsecond line"), "x");
    EXPECT_EQ(back.size, named.camera.size);
    ASSERT_EQ(back.lens.index(), named.camera.lens.index());
    if (const auto* cahv = std::get_if<Cahv>(&named.camera.lens)) {
      EXPECT_EQ(std::get<Cahv>(back.lens), *cahv);
    } else if (const auto* cahvor = std::get_if<Cahvor>(&named.camera.lens)) {
      EXPECT_EQ(std::get<Cahvor>(back.lens), *cahvor);
    } else {
      EXPECT_EQ(std::get<Cahvore>(back.lens), std::get<Cahvore>(named.camera.lens));
    }
  }
}

TEST(CameraTextTest, APairIsTwoBlocksInEitherOrder) {
  const CameraModel left{TestCahv(), {640, 480}};
  const CameraModel right{Cahvor{TestCahv(TestPose()), {0, 0, 1}, {0, 0.1, 0}}, {320, 240}};
  const std::string text = CameraPairText({left, right}, "a pair");
  const CameraPair pair = ParseCameraPairText(text, "x");
  EXPECT_EQ(std::get<Cahv>(pair.left.lens), std::get<Cahv>(left.lens));
  EXPECT_EQ(std::get<Cahvor>(pair.right.lens), std::get<Cahvor>(right.lens));
  const std::size_t second = text.find("Camera = right");
  const CameraPair turned = ParseCameraPairText(text.substr(second) + text.substr(0, second), "x");
  EXPECT_EQ(std::get<Cahv>(turned.left.lens), std::get<Cahv>(left.lens));
  EXPECT_EQ(std::get<Cahvor>(turned.right.lens), std::get<Cahvor>(right.lens));
}

TEST(CameraTextTest, ProblemsAreToldByTheirLines) {
  const auto with = [](const std::string& from, const std::string& to) {
    return ProblemsOf(Replaced(Linear(), from, to));
  };
  const auto with_more = [](const std::string& lines) { return ProblemsOf(Linear() + lines); };
  EXPECT_EQ(ProblemsOf(Linear()), "none");
  EXPECT_EQ(ProblemsOf(""), "line 1 ff.: model is missing; ");
  EXPECT_EQ(ProblemsOf("\nModel = CAHV\nA = 0 0 1\n"),
            "line 1 ff.: columns is missing, as well as rows, C, H, V; ");
  EXPECT_EQ(with("Model = CAHV", "Model = CAHVX"),
            "line 1 has the model \"CAHVX\", which is not known; ");
  EXPECT_EQ(ProblemsOf(Linear("CAHVORE4")), "line 1 has the type \"4\" of a CAHVORE; ");
  EXPECT_EQ(ProblemsOf(Linear("CAHVORE3,x")), "line 1 has the linearity \"x\"; ");
  EXPECT_EQ(with("C = 0 0 0", "C = 0 0"), "line 3 gives 2 numbers for C, not 3; ");
  EXPECT_EQ(with("C = 0 0 0", "C = 0 0 0 0"), "line 3 gives more than 3 numbers for C, not 3; ");
  EXPECT_EQ(with("C = 0 0 0", "C = 0 nan 0"), "line 3 has \"nan\" in C; ");
  EXPECT_EQ(with("C = 0 0 0", "C = 0 1e999 0"), "line 3 has \"1e999\" in C; ");
  EXPECT_EQ(with("640 480", "640.5 480"), "line 2 has \"640.5\" in Dimensions; ");
  EXPECT_EQ(with("640 480", "640 -480"),
            "line 2: rows is -480, below the smallest allowed value 1; ");
  EXPECT_EQ(with("640 480", "65537 480"),
            "line 2: columns is 65537, above the largest allowed value 65536; ");
  EXPECT_EQ(with_more("C = 1 1 1\n"), "line 7 gives C again, after line 3; ");
  EXPECT_EQ(with_more("Dimension = 1 1\n"),
            "line 7 has the key \"Dimension\", which is not known; ");
  EXPECT_EQ(with_more("1 2 3\n"), "line 7 is \"1 2 3\", without a \"=\"; ");
  EXPECT_EQ(with_more("S =\n1 2\nC\n"), "line 9 is \"C\", without a \"=\"; ");
  EXPECT_EQ(with_more("S =\n1 2\nHs = 1\n3 4\n"), "line 10 is \"3 4\", without a \"=\"; ");
  EXPECT_EQ(with_more("O = 0 0 1\n"), "line 7: O is not a known key; ");
  EXPECT_EQ(ProblemsOf(Linear("CAHVOR")), "line 1 ff.: O is missing, as well as R; ");
  EXPECT_EQ(with("A = 0 0 1", "A = 0 0 0.9"), "line 4: A is not of length 1; ");
  EXPECT_EQ(with("A = 0 0 1", "A = 0 0 1.5"),
            "line 4: A[2] is 1.5, above the largest allowed value 1.001; ");
  EXPECT_EQ(with("V = 0 300 240", "V = 300 1 240"), "line 5: H lies in one plane with V and A; ");
  EXPECT_EQ(ProblemsOf(Linear("CAHVOR") + "O = 0 0 1\nR = -1 0 0\n"),
            "line 8: R has a first number of -1 or less: no image is left; ");
  EXPECT_EQ(ProblemsOf(Linear("CAHVORE3,1.5") + "O = 0 0 1\nR = 0 0 0\nE = 0 0 0\n"),
            "line 1: linearity is 1.5, above the largest allowed value 1; ");
  EXPECT_EQ(ProblemsOf(Linear("CAHVORE3") + "O = 0 0 1\nR = 0 0 0\nE = 0 0 0\n"),
            "line 1 ff.: linearity is missing; ");
  EXPECT_EQ(ProblemsOf(std::string("\xff\x01\0 = 3\n", 8) + Linear()),
            "line 1 has the key \"???\", which is not known; ");
}

TEST(CameraTextTest, APairWithTooFewOrTooManyIsNone) {
  const std::string none = "is no pair of a left and a right camera; ";
  const std::string left = "Camera = left\n" + Linear();
  const std::string right = "Camera = right\n" + Linear();
  EXPECT_EQ(ProblemsOf(left + right, true), "none");
  EXPECT_EQ(ProblemsOf(Linear(), true), none);
  EXPECT_EQ(ProblemsOf(left, true), none);
  EXPECT_EQ(ProblemsOf(left + left, true), none);
  EXPECT_EQ(ProblemsOf(left + right + right, true).substr(0, none.size()), none);
  EXPECT_EQ(ProblemsOf(left + "Camera = middle\n" + Linear(), true), none);
  EXPECT_EQ(ProblemsOf(Linear() + right, true), "line 7 begins a camera below lines of none; ");
  EXPECT_EQ(ProblemsOf(left), "line 1 begins a pair, where one camera is wanted; ");
  EXPECT_EQ(ProblemsOf(left + "Camera = right\n" + Replaced(Linear(), "640", "0"), true),
            "line 10: columns is 0, below the smallest allowed value 1; ");
}

TEST(CameraTextTest, LongTextsAreRefusedUnread) {
  const std::string text = Linear() + std::string(kLargestCameraFile, ' ');
  EXPECT_EQ(ProblemsOf(text),
            "has " + std::to_string(text.size()) + " bytes, more than the 1048576 allowed; ");
  EXPECT_EQ(ProblemsOf(text.substr(0, kLargestCameraFile)), "none");
}

TEST(CameraTextTest, ManyProblemsAreToldUpToTwenty) {
  std::string text;
  for (int i = 0; i < 500; ++i) text += "nonsense\n";
  EXPECT_EQ(core::ProblemsIn([&] { ParseCameraText(text, "x"); }).size(), 20U);
}

}  // namespace
}  // namespace rockyard::vision
