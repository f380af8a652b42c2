// What stereo cameras saw, as the page is given it.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "replay/payload_text.h"

namespace rockyard::replay {
namespace {

using Json = nlohmann::json;
using testing::ElementsAre;

ReplayLook Look(std::int64_t number, bool behind, std::size_t bytes) {
  return {.time_s = 10.0 * static_cast<double>(number),
          .number = number,
          .behind = behind,
          .points = 100 + number,
          .least_disparity_px = -1.0,
          .most_disparity_px = 17.0,
          .left_png = std::string(bytes - bytes / 4, 'L'),
          .disparity_png = std::string(bytes / 4, 'D')};
}

std::vector<int> Numbers(const Json& eyes) {
  std::vector<int> numbers;
  for (const Json& look : eyes["looks"]) numbers.push_back(look["number"]);
  return numbers;
}

TEST(EyesJson, IsNullWithoutLooks) { EXPECT_EQ(EyesJson({}), "null"); }

TEST(EyesJson, NamesEachLookAndItsPictures) {
  const std::vector<ReplayLook> looks{Look(3, true, 8)};
  const Json eyes = Json::parse(EyesJson(looks));
  EXPECT_EQ(eyes["every"], 1);
  EXPECT_EQ(eyes["looks"], Json::array({{{"t", 30.0},
                                         {"number", 3},
                                         {"behind", true},
                                         {"points", 103},
                                         {"least", -1.0},
                                         {"most", 17.0},
                                         {"left", "LLLLLL"},
                                         {"disparity", "DD"}}}));
}

// As many as fit are kept, of either end of the rover as many as of the other.
TEST(EyesJson, LeavesOutLooksWhereTheirPicturesAreTooLarge) {
  std::vector<ReplayLook> looks;
  for (int i = 0; i < 12; ++i) looks.push_back(Look(i, i % 2 == 1, kMaxLookBytes / 12));
  EXPECT_EQ(Json::parse(EyesJson(looks))["every"], 1);
  EXPECT_EQ(Numbers(Json::parse(EyesJson(looks))).size(), 12U);
  looks.push_back(Look(12, false, kMaxLookBytes / 12));
  const Json eyes = Json::parse(EyesJson(looks));
  EXPECT_EQ(eyes["every"], 2);
  EXPECT_THAT(Numbers(eyes), ElementsAre(0, 1, 4, 5, 8, 9, 12));
  for (ReplayLook& look : looks) look.left_png += std::string(kMaxLookBytes / 12, 'L');
  EXPECT_EQ(Json::parse(EyesJson(looks))["every"], 3);
}

}  // namespace
}  // namespace rockyard::replay
