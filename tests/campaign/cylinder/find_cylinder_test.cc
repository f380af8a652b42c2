// The coloured cylinder in image files: what is written, and what is refused.
#include "campaign/cylinder/find_cylinder.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <span>

#include "campaign/cylinder/painted_files.h"
#include "core/random.h"
#include "core/refusals.h"
#include "core/test_folder.h"
#include "image_files/png_file.h"
#include "math/angles.h"

namespace rockyard::campaign {
namespace {

using testing::HasSubstr;

class FindCylinderTest : public testing::Test {
 protected:
  std::string Refusal() const {
    return core::RefusalOf([&] { FindCylinderInFiles(request_); });
  }

  void WriteFile(const char* name, const std::string& bytes) const {
    std::ofstream(own_.path() / name, std::ios::binary) << bytes;
  }

  core::TestFolder own_;
  CylinderRequest request_ = WritePaintedPair(own_.path());
};

TEST_F(FindCylinderTest, BothFindersFindItInFiles) {
  for (const CylinderFinder finder : {CylinderFinder::kRobust, CylinderFinder::kPublished}) {
    request_.finder = finder;
    const CylinderResult result = FindCylinderInFiles(request_);
    ASSERT_TRUE(result.finding.sighting) << result.finding.reason;
    EXPECT_NEAR(math::RadToDeg(result.finding.sighting->orientation_rad), 30.0, 2.0);
    EXPECT_NEAR(result.finding.sighting->p_LT_L.x(), 2.0, 0.05);
    EXPECT_TRUE(result.files.empty());
  }
}

// Bands of noise, and pieces of the image in each other's places.
TEST_F(FindCylinderTest, DamagedPixelsDoNotMoveIt) {
  std::string what;
  const vision::ColourImage whole = ReadColour(request_.left, what);
  request_.left = own_.path() / "damaged.png";
  int found = 0;
  int missed = 0;
  for (std::uint32_t number = 0; number < 30; ++number) {
    core::RandomStream stream({27, number}, core::Purpose::kTest);
    vision::ColourImage image = whole;
    const std::span<vision::Rgb> pixels = image.values();
    std::array<std::size_t, 3> ends{};
    for (std::size_t& end : ends) end = stream.NextU64() % pixels.size();
    std::ranges::sort(ends);
    if (number % 2 == 0) {
      std::ranges::rotate(pixels.subspan(ends[0], ends[2] - ends[0]),
                          pixels.begin() + static_cast<std::ptrdiff_t>(ends[1]));
    } else {
      for (vision::Rgb& pixel : pixels.subspan(ends[0], (ends[1] - ends[0]) / 3)) {
        pixel.red = pixel.green = pixel.blue = static_cast<std::uint8_t>(stream.NextU32() >> 24);
      }
    }
    WriteFile("damaged.png", image_files::EncodePng(image));
    for (const CylinderFinder finder : {CylinderFinder::kPublished, CylinderFinder::kRobust}) {
      request_.finder = finder;
      const vision::CylinderFinding finding = FindCylinderInFiles(request_).finding;
      EXPECT_NE(finding.sighting.has_value(), finding.miss != vision::CylinderMiss::kNone);
      EXPECT_NE(finding.sighting.has_value(), !finding.reason.empty());
      if (finder == CylinderFinder::kPublished) continue;
      ++(finding.sighting ? found : missed);
      if (!finding.sighting) continue;
      EXPECT_NEAR(math::RadToDeg(finding.sighting->orientation_rad), 30.0, 10.0) << number;
      EXPECT_NEAR(finding.sighting->p_LT_L.x(), 2.0, 0.2) << number;
    }
  }
  EXPECT_GE(found, 5);
  EXPECT_GE(missed, 5);
}

TEST_F(FindCylinderTest, WritesAPictureAndASummary) {
  request_.out = own_.path() / "seen";
  const CylinderResult result = FindCylinderInFiles(request_);
  ASSERT_EQ(result.files.size(), 2U);
  EXPECT_TRUE(std::filesystem::exists(request_.out / "regions.png"));
  EXPECT_TRUE(std::filesystem::exists(request_.out / "cylinder.json"));
  const core::JsonValue json = CylinderJson(request_, result);
  EXPECT_TRUE(json.Find("found")->boolean());
  EXPECT_TRUE(json.Find("miss")->Is(core::JsonValue::Type::kNull));
  std::string what;
  const vision::ColourImage picture = ReadColour(request_.out / "regions.png", what);
  EXPECT_EQ(picture.width(), 1024);
  // The box of the whole stands a pixel outside of it.
  const vision::ColourRegion& whole = result.finding.sighting->regions[1].front();
  EXPECT_EQ(picture.At(512 + whole.left - 1, whole.top - 1), (vision::Rgb{255, 255, 255}));
}

TEST_F(FindCylinderTest, AMissIsNoErrorAndSaysWhy) {
  std::swap(request_.left, request_.right);
  request_.out = own_.path() / "seen";
  const CylinderResult result = FindCylinderInFiles(request_);
  EXPECT_EQ(result.finding.miss, vision::CylinderMiss::kSwappedEyes);
  const core::JsonValue json = CylinderJson(request_, result);
  EXPECT_FALSE(json.Find("found")->boolean());
  EXPECT_EQ(json.Find("miss")->text(), "swapped_eyes");
  EXPECT_THAT(json.Find("reason")->text(), HasSubstr("swapped"));
  EXPECT_TRUE(json.Find("sighting")->Is(core::JsonValue::Type::kNull));
}

TEST_F(FindCylinderTest, RefusesWhatIsNoPairOfColourImages) {
  WriteFile("grey.png", image_files::EncodePng(vision::GrayImage(512, 480, 90)));
  WriteFile("small.png", image_files::EncodePng(vision::ColourImage(64, 48, {9, 9, 9})));
  WriteFile("none.png", "no image");
  const std::filesystem::path right = request_.right;
  for (const auto& [name, words] : {std::pair{"grey.png", "grey"},
                                    {"small.png", "64 x 48"},
                                    {"none.png", "none.png"},
                                    {"absent.png", "absent.png"},
                                    {"left.png", "the same as the left"}}) {
    request_.right = own_.path() / name;
    EXPECT_THAT(Refusal(), HasSubstr(words));
  }
  request_.right = right;
  request_.settings = {"robust.fit.nonsense=1"};
  EXPECT_THAT(Refusal(), HasSubstr("nonsense"));
}

// As with cameras that are told in a frame whose z points ahead.
TEST_F(FindCylinderTest, RefusesAnAxisThatDoesNotPointUpwards) {
  for (const char* axis : {"cylinder.axis=[1,0,0]", "cylinder.axis=[0,0,-1]"}) {
    request_.settings = {axis};
    EXPECT_THAT(Refusal(), HasSubstr("cylinder.axis"));
    EXPECT_THAT(Refusal(), HasSubstr("[0.000,0.000,1.000]"));
  }
  request_.settings = {"cylinder.axis=[0,0,0]"};
  EXPECT_THAT(Refusal(), HasSubstr("points nowhere"));
  request_.settings = {"cylinder.axis=[0,0,0.5]"};
  EXPECT_EQ(Refusal(), "");
  request_.settings = {"cylinder.axis=[1,0,0]"};
  request_.finder = CylinderFinder::kPublished;
  EXPECT_EQ(Refusal(), "");
}

TEST_F(FindCylinderTest, RefusesCamerasOfAnotherSize) {
  WriteFile("a.png", image_files::EncodePng(vision::ColourImage(64, 48, {9, 9, 9})));
  WriteFile("b.png", image_files::EncodePng(vision::ColourImage(64, 48, {8, 9, 9})));
  request_.left = own_.path() / "a.png";
  request_.right = own_.path() / "b.png";
  EXPECT_THAT(Refusal(), HasSubstr("512 x 480"));
}

TEST_F(FindCylinderTest, SamplesOfSixteenBitsAreScaled) {
  WriteFile("deep.ppm", std::string("P6\n2 1\n1000\n") + std::string("\x03\xE8\x01\xF4\0\0"
                                                                     "\0\x02\0\x04\0\x06",
                                                                     12));
  std::string what;
  const vision::ColourImage image = ReadColour(own_.path() / "deep.ppm", what);
  EXPECT_EQ(image.At(0, 0), (vision::Rgb{255, 128, 0}));
  EXPECT_EQ(image.At(1, 0), (vision::Rgb{1, 1, 2}));
  EXPECT_THAT(what, HasSubstr("255 / 1000"));
}

}  // namespace
}  // namespace rockyard::campaign
