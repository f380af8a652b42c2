// Mutated files of cameras.
#include <gtest/gtest.h>

#include <string>

#include "core/error.h"
#include "core/json_text.h"
#include "core/random.h"
#include "vision/cameras/camera_file.h"
#include "vision/cameras/test_cameras.h"

namespace rockyard::vision {
namespace {

// Mutated files give a camera or a UserError, and a camera that is given is one to work with.
TEST(CameraFileFuzzTest, MutatedFilesAreReadOrRefused) {
  const CameraPair pair{FlightCamera("M2020_HAZFLA"), FlightCamera("VW_MER_CAHVOR")};
  const std::string seeds[] = {CameraPairText(pair), core::DumpJson(CameraPairJson(pair)),
                               CameraText(pair.left), core::DumpJson(CameraJson(pair.right))};
  core::RandomStream random({24, 0}, core::Purpose::kTest);
  const auto below = [&](std::size_t end) {
    return static_cast<std::size_t>(random.Uniform() * static_cast<double>(end));
  };
  const std::string tokens[] = {"=",
                                "\n",
                                "nan",
                                "1e308",
                                "-",
                                "\"",
                                "[",
                                "}",
                                "Camera = left\n",
                                "S =\n",
                                "Model = CAHVORE",
                                ",",
                                "#",
                                std::string(1, '\0')};
  int read = 0;
  int refused = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    std::string text = seeds[below(4)];
    const std::size_t changes = 1 + below(4);
    for (std::size_t change = 0; change < changes && !text.empty(); ++change) {
      const std::size_t at = below(text.size());
      switch (below(4)) {
        case 0:
          text[at] = static_cast<char>(below(256));
          break;
        case 1:
          text.insert(at, tokens[below(std::size(tokens))]);
          break;
        case 2:
          text.erase(at, 1 + below(30));
          break;
        default:
          text.resize(below(10) == 0 ? at : text.size());
      }
    }
    try {
      const CameraModel camera =
          below(2) == 0 ? ParseCamera(text, "f") : ParseCameraPair(text, "f").left;
      ++read;
      ASSERT_GT(camera.size.columns, 0);
      ASSERT_LE(camera.size.columns, kLongestSide_px);
      const auto ray = BackProject(camera, MiddleOf(camera.size));
      ASSERT_TRUE(!ray || ray->direction.allFinite());
    } catch (const core::UserError& error) {
      ++refused;
      ASSERT_FALSE(error.problems().empty());
    }
  }
  EXPECT_GT(read, 100);
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace rockyard::vision
