// Decisions of a map-based navigator and what stereo cameras saw, as the page is given them.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "replay/payload_text.h"

namespace rockyard::replay {
namespace {

using Json = nlohmann::json;
using testing::ElementsAre;
using testing::SizeIs;

messages::SplineVote Vote(double first_knot_per_m, double merged, bool feasible) {
  messages::SplineVote vote;
  vote.spline = {.start_per_m = 0.25,
                 .first_knot_per_m = first_knot_per_m,
                 .second_knot_per_m = -first_knot_per_m,
                 .length_m = 3.0};
  vote.hazard = merged + 1.0;
  vote.hazard_certainty = merged + 2.0;
  vote.waypoint = merged + 3.0;
  vote.merged = merged;
  vote.feasible = feasible;
  return vote;
}

ReplayStep Step(std::int64_t number) {
  ReplayStep step;
  step.time_s = 10.0;
  step.look_time_s = 8.5;
  step.pose = {1.0, 2.0, 0.3};
  step.look_believed = {1.1, 2.2, 0.33};
  step.view.step = number;
  step.view.estimate.x_m = 1.5;
  step.view.splines = {Vote(-0.5, 100.0, true), Vote(0.125, 200.4, true), Vote(1.0, 0.0, false)};
  step.view.splines[1].chosen = true;
  step.view.spline_start.x_m = 1.6;
  step.view.spline_start.y_m = 2.6;
  step.view.spline_start.heading_rad = 0.4;
  return step;
}

Json StepsOf(const std::vector<ReplayStep>& steps) { return Json::parse(StepsJson(steps)); }

TEST(StepsJson, SayWhenAndWhereThePointsWereTaken) {
  const Json step = StepsOf({Step(4)})[0];
  EXPECT_EQ(step["step"], 4);
  EXPECT_EQ(step["t"], 10.0);
  EXPECT_EQ(step["look"],
            Json({{"t", 8.5}, {"believed", {{"x", 1.1}, {"y", 2.2}, {"heading", 0.33}}}}));
  EXPECT_EQ(step["pose"], Json({{"x", 1.0}, {"y", 2.0}, {"heading", 0.3}}));
  EXPECT_EQ(step["believed"]["x"], 1.5);
}

TEST(StepsJson, SplinesAreColumns) {
  const Json step = StepsOf({Step(0)})[0];
  EXPECT_EQ(step["spline_start"], Json({{"x", 1.6}, {"y", 2.6}, {"heading", 0.4}}));
  const Json& splines = step["splines"];
  EXPECT_THAT(splines["start"], ElementsAre(0.25, 0.25, 0.25));
  EXPECT_THAT(splines["first"], ElementsAre(-0.5, 0.125, 1.0));
  EXPECT_THAT(splines["second"], ElementsAre(0.5, -0.125, -1.0));
  EXPECT_THAT(splines["length"], ElementsAre(3.0, 3.0, 3.0));
  EXPECT_THAT(splines["merged"], ElementsAre(100, 200, 0));
  EXPECT_THAT(splines["hazard"], ElementsAre(101, 201, 1));
  EXPECT_THAT(splines["certainty"], ElementsAre(102, 202, 2));
  EXPECT_THAT(splines["waypoint"], ElementsAre(103, 203, 3));
  EXPECT_THAT(splines["feasible"], ElementsAre(true, true, false));
  EXPECT_EQ(splines["chosen"], 1);
}

TEST(StepsJson, ThereMayBeNoSplinesOrNoneMayBeChosen) {
  ReplayStep arcs = Step(0);
  arcs.view.splines.clear();
  EXPECT_TRUE(StepsOf({arcs})[0]["splines"].is_null());
  ReplayStep none = Step(0);
  for (messages::SplineVote& vote : none.view.splines) vote.chosen = false;
  EXPECT_EQ(StepsOf({none})[0]["splines"]["chosen"], -1);
}

// Of many steps those without details keep the spline that is driven.
TEST(StepsJson, ManyStepsKeepTheirChosenSplines) {
  const Json steps = StepsOf(std::vector<ReplayStep>(kMaxDetailedSteps + 1, Step(0)));
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Json& splines = steps[i]["splines"];
    const bool detailed = i % 2 == 0;
    EXPECT_THAT(splines["first"], SizeIs(detailed ? 3 : 1)) << i;
    const auto chosen = splines["chosen"].get<std::size_t>();
    EXPECT_EQ(chosen, detailed ? 1U : 0U);
    EXPECT_EQ(splines["first"][chosen], 0.125);
    EXPECT_THAT(splines["feasible"], SizeIs(detailed ? 3 : 1)) << i;
  }
}

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
