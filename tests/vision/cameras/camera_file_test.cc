// Cameras and pairs as files, JSON or text.
#include "vision/cameras/camera_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/json_text.h"
#include "core/refusals.h"
#include "core/test_folder.h"
#include "vision/cameras/test_cameras.h"

namespace rockyard::vision {
namespace {

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

}  // namespace
}  // namespace rockyard::vision
