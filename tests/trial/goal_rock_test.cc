// Rocks at goals: what the rover finds, and how drives to them end.

#include "trial/referee/goal_rock.h"

#include "core/refusals.h"
#include "math/angles.h"
#include "scenario/shipped.h"
#include "terrain/field.h"
#include "trial/course/layout.h"
#include "trial/shipped_trials.h"
#include "truth/end_cause.h"

namespace rockyard::trial {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using truth::TrialOutcome;

DriveParams Outdoor(const Overrides& overrides = {}) {
  const Overrides quasi_static = {"rover.fidelity=quasi_static"};
  return scenario::Shipped("localization/outdoor_5m", quasi_static + overrides).drive;
}

DriveResult DriveOutdoor(const Overrides& overrides) {
  return RunTrial(Outdoor(overrides), {1, 0});
}

// 3 m of empty sand to the rock.
const Overrides kBare = {"terrain.rocks.kind=none", "course.goal_x_m=3",
                         "localization.estimator=oracle"};

const Overrides kSearchTooSmall = {"course.goal_rock.search.squares=1",
                                   "course.goal_rock.search.spacing_m=0.1"};

// Told a place that lies so far to the left of the rock: the pan error of a lander 3 m away.
Overrides Beside(double left_m) {
  return kBare +
         Overrides{
             "course.designation.pixel_sd_px=0", "course.designation.disparity_sd_px=0",
             "course.designation.pan_error_deg=" + std::to_string(math::RadToDeg(left_m / 3.0))};
}

math::Transform At(double x_m, double y_m, double heading_rad = 0.0) {
  math::Transform X_WR = math::Transform::Identity();
  X_WR.linear() = Eigen::AngleAxisd(heading_rad, math::Vector3::UnitZ()).toRotationMatrix();
  X_WR.translation() << x_m, y_m, 0.1;
  return X_WR;
}

// One rock of radius 0.2 m at (2, 0), and another that is none of ours; a rover of 0.6 x 0.4 m, an
// array from 0.3 to 0.6 m ahead, 0.26 m wide.
class GoalRockTest : public testing::Test {
 protected:
  static terrain::Rock RockAt(double x_m) {
    terrain::Rock rock;
    rock.center_W << x_m, 0.0, 0.0;
    rock.semi_axes_m << 0.2, 0.2, 0.2;
    return rock;
  }
  static rover::RoverGeometryParams Rover() {
    rover::RoverGeometryParams rover;
    rover.length_m = 0.6;
    rover.width_m = 0.4;
    return rover;
  }

  terrain::Terrain terrain_{terrain::Ground(), {RockAt(-5.0), RockAt(2.0)}, {}};
  GoalRock rock_{terrain_, 1, Zone{0.3, 0.6, -0.13, 0.13}, Rover()};
};

TEST_F(GoalRockTest, DistancesAreThoseOfOutlines) {
  EXPECT_NEAR(rock_.Distance_m(At(0.0, 0.0)), 2.0 - 0.2 - 0.3, 1e-12);
  EXPECT_NEAR(rock_.Distance_m(At(4.0, 0.0)), 2.0 - 0.2 - 0.3, 1e-12);
  // Abeam, and off a corner.
  EXPECT_NEAR(rock_.Distance_m(At(2.0, 1.0)), 1.0 - 0.2 - 0.2, 1e-12);
  EXPECT_NEAR(rock_.Distance_m(At(1.3, 0.5)), 0.5 - 0.2, 1e-12);
  EXPECT_NEAR(rock_.Distance_m(At(2.0, 1.0, std::acos(0.0))), 1.0 - 0.2 - 0.3, 1e-12);
  EXPECT_EQ(rock_.Distance_m(At(1.9, 0.1)), 0.0);
  EXPECT_NEAR(rock_.FrontDistance_m(At(0.0, 0.0)), 2.0 - 0.3 - 0.2, 1e-12);
  EXPECT_NEAR(rock_.FrontDistance_m(At(4.0, 0.0)), 2.0 + 0.3 - 0.2, 1e-12);
  EXPECT_EQ(rock_.FrontDistance_m(At(1.7, 0.0)), 0.0);
}

// The array ends 0.6 m ahead of the rover, the rock begins at 1.8 m.
TEST_F(GoalRockTest, ABelievedHazardFindsItWithinReachOnly) {
  rock_.OnBelieved(At(1.19, 0.0));
  EXPECT_FALSE(rock_.found());
  rock_.OnBelieved(At(1.4, 0.34));
  EXPECT_FALSE(rock_.found());
  rock_.OnBelieved(At(1.21, 0.0));
  EXPECT_EQ(rock_.sign(), RockSign::kArray);
}

TEST_F(GoalRockTest, ATouchOfTheRockFindsIt) {
  truth::RoverState state;
  rock_.Observe(state);
  state.contacts = {{.rock = 0, .normal_force_N = 5.0}, {.rock = -1, .normal_force_N = 5.0}};
  rock_.Observe(state);
  state.contacts = {{.rock = 1, .normal_force_N = 0.0}};
  rock_.Observe(state);
  EXPECT_FALSE(rock_.found());
  state.contacts.push_back({.rock = 1, .normal_force_N = 0.1});
  rock_.Observe(state);
  EXPECT_EQ(rock_.sign(), RockSign::kContact);
  // What found it first, found it.
  rock_.OnBelieved(At(1.21, 0.0));
  EXPECT_EQ(rock_.sign(), RockSign::kContact);
}

TEST(LocalSearchTest, DrivesAroundGrowingSquares) {
  EXPECT_THAT(LocalSearchParams{}.Places({1.0, 2.0}), IsEmpty());
  const LocalSearchParams search{.squares = 2, .spacing_m = 0.5};
  const std::vector<messages::Goal> places = search.Places({1.0, 2.0});
  ASSERT_EQ(places.size(), 8U);
  const double expected[8][2] = {{1.5, 2.5}, {0.5, 2.5}, {0.5, 1.5}, {1.5, 1.5},
                                 {2.0, 3.0}, {0.0, 3.0}, {0.0, 1.0}, {2.0, 1.0}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_EQ(places[i].x_m, expected[i][0]) << i;
    EXPECT_EQ(places[i].y_m, expected[i][1]) << i;
  }
}

// The rock stands at the goal, of the size that was asked for, the last of the field; the others
// are those of the field without it.
TEST(GoalRockFieldTest, IsAddedToTheField) {
  const DriveParams with = Outdoor();
  const DriveParams without = Outdoor({"course.goal_rock.enabled=false"});
  const terrain::Field a = terrain::BuildField(with.terrain, {1, 3}, TerrainCourse(with.course));
  const terrain::Field b =
      terrain::BuildField(without.terrain, {1, 3}, TerrainCourse(without.course));
  ASSERT_EQ(a.terrain.rocks().size(), b.terrain.rocks().size() + 1);
  for (std::size_t i = 0; i < b.terrain.rocks().size(); ++i) {
    EXPECT_EQ(a.terrain.rocks()[i].center_W, b.terrain.rocks()[i].center_W);
    const terrain::Rock& rock = a.terrain.rocks()[i];
    EXPECT_GT(std::hypot(rock.center_W.x() - 5.0, rock.center_W.y()),
              with.terrain.rocks.clear_radius_m);
  }
  const terrain::Rock& rock = a.terrain.rocks().back();
  EXPECT_EQ(rock.center_W.x(), 5.0);
  EXPECT_EQ(rock.center_W.y(), 0.0);
  EXPECT_EQ(rock.diameter_m, with.course.goal_rock.diameter_m);
  EXPECT_NEAR(a.terrain.Height(5.0, 0.0), with.course.goal_rock.height_m, 1e-9);
}

TEST(GoalRockDriveTest, ARockStraightAheadIsFound) {
  const DriveResult result = DriveOutdoor(Beside(0.0));
  EXPECT_EQ(result.outcome, TrialOutcome::kGoalReached) << result.detail;
  EXPECT_EQ(result.detail, truth::Info(truth::EndCause::kFoundRock).sentence);
  EXPECT_EQ(result.record.goal_rock_found, 1.0);
  EXPECT_EQ(result.record.goal_rock_sign, 1.0);
  EXPECT_EQ(result.record.goal_rock_recognized, 0.0);
  EXPECT_EQ(result.record.search_places_reached, 0.0);
  // Within the array's 30 cm.
  EXPECT_LT(result.record.goal_rock_distance_m, 0.31);
  EXPECT_GT(result.record.goal_rock_distance_m, 0.0);
}

// Without hazard detection nothing is believed, and the rover drives into it.
TEST(GoalRockDriveTest, ABlindRoverTouchesIt) {
  const Overrides blind = {"perception.hazard.enabled=false", "rover.fidelity=multibody"};
  const DriveResult result = DriveOutdoor(Beside(0.0) + blind);
  EXPECT_EQ(result.outcome, TrialOutcome::kGoalReached) << result.detail;
  EXPECT_EQ(result.record.goal_rock_sign, 2.0);
  EXPECT_LT(result.record.goal_rock_distance_m, 0.05);
}

// 1.2 m beside the rock, beyond the array's 0.13 m and the rover's own width.
TEST(GoalRockDriveTest, ARockThatWasPassedByIsNotFound) {
  const DriveResult result = DriveOutdoor(Beside(1.2));
  EXPECT_EQ(result.outcome, TrialOutcome::kFalseGoal);
  EXPECT_EQ(result.detail, truth::Info(truth::EndCause::kRockNotFound).sentence);
  EXPECT_EQ(result.record.goal_rock_found, 0.0);
  EXPECT_EQ(result.record.goal_rock_sign, 0.0);
  EXPECT_GT(result.record.goal_rock_distance_m, 0.5);
  EXPECT_EQ(result.record.waypoints_reached, 0.0);
}

// It would be at the goal by distance alone, were the rock not asked for.
TEST(GoalRockDriveTest, NearnessAloneIsNoFind) {
  const DriveResult with = DriveOutdoor(Beside(0.6));
  const DriveResult without =
      DriveOutdoor(Beside(0.6) + Overrides{"course.goal_rock.enabled=false"});
  EXPECT_EQ(with.outcome, TrialOutcome::kFalseGoal) << with.detail;
  EXPECT_LT(with.record.true_goal_distance_m, 0.65);
  EXPECT_EQ(without.outcome, TrialOutcome::kGoalReached) << without.detail;
  EXPECT_TRUE(std::isnan(without.record.goal_rock_found));
  EXPECT_TRUE(std::isnan(without.record.goal_rock_distance_m));
}

// A search has places that nobody named: the trace counts them and knows no distance.
TEST(GoalRockDriveTest, ASearchIsTracedByItsPlaces) {
  const TracedTrial trial = RunTraced(Outdoor(Beside(1.2) + kSearchTooSmall), 0);
  std::vector<std::string> places;
  for (const truth::TraceEvent& event : EventsOf(trial.trace, "waypoint")) {
    places.push_back(event.detail);
  }
  EXPECT_THAT(places, testing::ElementsAre("place 1 of the search", "place 2 of the search",
                                           "place 3 of the search", "place 4 of the search"));
}

TEST(GoalRockDriveTest, ASearchFindsWhatWasPassedBy) {
  const Overrides search = {"course.goal_rock.search.squares=4",
                            "course.goal_rock.search.spacing_m=0.5"};
  const DriveResult result = DriveOutdoor(Beside(1.2) + search);
  EXPECT_EQ(result.outcome, TrialOutcome::kGoalReached) << result.detail;
  EXPECT_EQ(result.record.goal_rock_found, 1.0);
  EXPECT_GE(result.record.search_places_reached, 1.0);
  EXPECT_EQ(result.record.waypoints_reached, 0.0);
  // A search that ends too soon.
  const DriveResult brief = DriveOutdoor(Beside(1.2) + kSearchTooSmall);
  EXPECT_EQ(brief.outcome, TrialOutcome::kFalseGoal) << brief.detail;
  EXPECT_EQ(brief.record.search_places_reached, 4.0);
}

TEST(GoalRockDriveTest, ARockThatIsRecognizedIsDrivenTo) {
  const auto with = [](double recognition_m) {
    return DriveOutdoor(
        Beside(0.7) + Overrides{"course.goal_rock.recognition_m=" + std::to_string(recognition_m)});
  };
  const DriveResult far = with(1.0);
  EXPECT_EQ(far.outcome, TrialOutcome::kGoalReached) << far.detail;
  EXPECT_EQ(far.record.goal_rock_recognized, 1.0);
  // Its outline never comes as near as this.
  const DriveResult near = with(0.2);
  EXPECT_EQ(near.outcome, TrialOutcome::kFalseGoal) << near.detail;
  EXPECT_EQ(near.record.goal_rock_recognized, 0.0);
}

// The field of view of course.tracking holds for recognition, too.
TEST(GoalRockDriveTest, RecognitionLooksAhead) {
  const Overrides narrow = {"course.goal_rock.recognition_m=1",
                            "course.tracking.half_field_of_view_deg=5"};
  EXPECT_EQ(DriveOutdoor(Beside(0.7) + narrow).record.goal_rock_recognized, 0.0);
}

std::string ProblemsWith(const Overrides& overrides) {
  return core::RefusalOf([&] { Outdoor(overrides); });
}

TEST(GoalRockParamsTest, BadScenariosSayWhatIsWrong) {
  EXPECT_EQ(ProblemsWith({}), "");
  EXPECT_THAT(ProblemsWith({"terrain.arena.kind=virtual_reflected"}), HasSubstr("open arena"));
  EXPECT_THAT(ProblemsWith({"course.tracking.enabled=true"}), HasSubstr("recognition_m"));
  EXPECT_THAT(ProblemsWith({"course.target_speed_m_s=0.01"}), HasSubstr("do not move on"));
  EXPECT_THAT(ProblemsWith({"course.goal_rock.diameter_m=1.2"}), HasSubstr("clear_radius_m"));
  EXPECT_EQ(ProblemsWith({"course.goal_rock.diameter_m=1.0"}), "");
  EXPECT_EQ(ProblemsWith({"course.goal_rock.diameter_m=1.2", "terrain.rocks.kind=none"}), "");
  EXPECT_THAT(ProblemsWith({"navigation.navigator=route"}), HasSubstr("use navigator pathfinder"));
  EXPECT_THAT(ProblemsWith({"navigation.navigator=gestalt", "sensors.terrain_sensor=stereo",
                            "terrain.rocks.pointedness=0"}),
              HasSubstr("which reads no report"));
}

}  // namespace
}  // namespace rockyard::trial
