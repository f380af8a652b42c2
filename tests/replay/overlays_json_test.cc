// What a navigator shows, as the page is given it.
#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "replay/payload_text.h"

namespace rockyard::replay {
namespace {

using Json = nlohmann::json;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

ReplayOverlay Showing(double time_s, messages::Overlay shown) {
  return {.time_s = time_s,
          .pose = {1.0, 2.0, 0.3},
          .believed = {1.1, 2.2, 0.33},
          .shown = std::move(shown)};
}

Json JsonOf(const std::vector<ReplayOverlay>& overlays, std::size_t every = 1) {
  return Json::parse(OverlaysJson(overlays, every));
}

TEST(OverlaysJson, IsNullWhereNothingIsShown) { EXPECT_EQ(OverlaysJson({}, 1), "null"); }

TEST(OverlaysJson, LinesAndGridsInTheBelievedWorld) {
  const Json json = JsonOf({Showing(
      12.5, {.lines = {{"path \"a\"", {{0.12345, -2.0}, {kNan, 1.0}, {3.0, 4.0}}}},
             .grids = {{"cost", -0.5, 1.5, 0.25, 3, 2, {0.0, 0.5, 1.0, kNan, -3.0, 7.0}}}})});
  EXPECT_EQ(json["every"], 1);
  ASSERT_THAT(json["shown"], SizeIs(1));
  const Json& overlay = json["shown"][0];
  EXPECT_EQ(overlay["t"], 12.5);
  EXPECT_EQ(overlay["pose"], Json({{"x", 1.0}, {"y", 2.0}, {"heading", 0.3}}));
  EXPECT_EQ(overlay["believed"], Json({{"x", 1.1}, {"y", 2.2}, {"heading", 0.33}}));
  EXPECT_EQ(overlay["lines"],
            Json::array({{{"name", "path \"a\""}, {"points", {{0.123, -2.0}, {3.0, 4.0}}}}}));
  EXPECT_EQ(overlay["grids"], Json::array({{{"name", "cost"},
                                            {"x0", -0.5},
                                            {"y0", 1.5},
                                            {"step", 0.25},
                                            {"nx", 3},
                                            {"ny", 2},
                                            {"values", {0, 128, 255, -1, 0, 255}}}}));
}

TEST(OverlaysJson, AnEmptyOneStaysAsItTakesTheOneBeforeAway) {
  const Json json = JsonOf({Showing(0.0, {.lines = {{"a", {}}}, .grids = {}}), Showing(1.0, {})});
  ASSERT_THAT(json["shown"], SizeIs(2));
  EXPECT_THAT(json["shown"][0]["lines"][0]["points"], IsEmpty());
  EXPECT_THAT(json["shown"][1]["lines"], IsEmpty());
}

// Each takes a fifth of the room, and some more.
TEST(OverlaysJson, LeavesOutWhatTakesTooMuchRoom) {
  const messages::Overlay large{.lines = {},
                                .grids = {{"cost", 0, 0, 1, static_cast<int>(kMaxOverlayBytes / 10),
                                           1, std::vector<double>(kMaxOverlayBytes / 10, 0.0)}}};
  std::vector<ReplayOverlay> overlays;
  const auto times = [&](std::size_t every) {
    std::vector<double> shown;
    const Json json = JsonOf(overlays, every);
    for (const Json& overlay : json["shown"]) shown.push_back(overlay["t"]);
    return shown;
  };
  for (int i = 0; i < 4; ++i) overlays.push_back(Showing(i, large));
  EXPECT_THAT(times(1), ElementsAre(0, 1, 2, 3));
  for (int i = 4; i < 10; ++i) overlays.push_back(Showing(i, large));
  EXPECT_THAT(times(1), ElementsAre(0, 3, 6, 9));
  EXPECT_EQ(JsonOf(overlays)["every"], 3);
  EXPECT_EQ(JsonOf(overlays, 4)["every"], 12);
}

TEST(OverlaysJson, ShowsNoneWhereTheFirstAloneIsTooLarge) {
  const messages::Overlay large{.lines = {},
                                .grids = {{"cost", 0, 0, 1, static_cast<int>(kMaxOverlayBytes), 1,
                                           std::vector<double>(kMaxOverlayBytes, 0.0)}}};
  EXPECT_THAT(JsonOf({Showing(0.0, large), Showing(1.0, {})})["shown"], IsEmpty());
  EXPECT_THAT(JsonOf({Showing(0.0, large)})["shown"], IsEmpty());
}

}  // namespace
}  // namespace rockyard::replay
