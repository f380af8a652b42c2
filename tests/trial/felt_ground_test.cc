// What a rover must not call an obstacle: gravel that no wheel notices, and single rocks that it is
// allowed to drive over.
#include <gtest/gtest.h>

#include <sstream>

#include "navigation/gestalt/gestalt_params.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

const Overrides kMultibody = {"rover.fidelity=multibody"};

std::string List(const std::vector<double>& values) {
  std::ostringstream text;
  text << '[';
  for (std::size_t i = 0; i < values.size(); ++i) text << (i > 0 ? "," : "") << values[i];
  text << ']';
  return text.str();
}

struct ListedRocks {
  std::vector<double> x_m, y_m, diameter_m, height_m;

  Overrides AsOverrides() const {
    const std::string path = "terrain.rocks.listed.";
    return {"terrain.rocks.kind=listed", path + "x_m=" + List(x_m), path + "y_m=" + List(y_m),
            path + "diameter_m=" + List(diameter_m), path + "height_m=" + List(height_m)};
  }
};

// 900 pebbles of 2.5 to 4.5 cm: less than a quarter of a wheel of 20 cm.
Overrides Gravel() {
  core::RandomStream random({20021109, 0}, core::Purpose::kTest, 0);
  ListedRocks rocks;
  for (int i = 0; i < 900; ++i) {
    rocks.x_m.push_back(1.0 + 4.5 * random.Uniform());
    rocks.y_m.push_back(-2.0 + 4.0 * random.Uniform());
    rocks.height_m.push_back(0.025 + 0.02 * random.Uniform());
    rocks.diameter_m.push_back(1.6 * rocks.height_m.back());
  }
  return rocks.AsOverrides() + Overrides{"course.goal_x_m=6.5"};
}

TEST(FeltGround, GravelBelowAQuarterOfTheWheelRaisesNothing) {
  for (const Overrides& fidelity : {Overrides{}, kMultibody}) {
    const std::uint32_t trials = fidelity.empty() ? 6 : 2;
    for (const DriveResult& result :
         RunTrials(Gestalt("viking_lander_2", Gravel() + fidelity), trials)) {
      EXPECT_EQ(result.record.safeguard_stops, 0.0);
      EXPECT_EQ(result.outcome, truth::TrialOutcome::kGoalReached);
      EXPECT_GT(result.record.max_bogie_deg, 2.0) << "it did drive over pebbles";
    }
  }
}

// The limit that called climbing an obstacle does so here, too: the test sees it.
TEST(FeltGround, CurrentAloneCallsGravelAnObstacle) {
  const Overrides alone = {"perception.vehicle_hazard.max_turn_share=2",
                           "perception.vehicle_hazard.current_ticks=3"};
  double stops = 0.0;
  for (const DriveResult& result : RunTrials(Gestalt("viking_lander_2", Gravel() + alone), 6)) {
    stops += result.record.safeguard_stops;
  }
  EXPECT_GT(stops, 6.0);
}

// One rock of obst_height under the wheels of one side; the navigator looks at nothing.
TEST(FeltGround, ASingleRockThatMayBeDrivenOverRaisesNothing) {
  struct Case {
    std::string scenario;
    double height_m;
    double y_m;
  };
  for (const Case& rock :
       {Case{"viking_lander_2", 0.20, 0.36}, Case{"abundance_rocky_3_2", 0.13, 0.21}}) {
    for (const Overrides& fidelity : {Overrides{}, kMultibody}) {
      const ListedRocks one{{1.5}, {rock.y_m}, {1.5 * rock.height_m}, {rock.height_m}};
      const DriveParams drive = Gestalt(
          rock.scenario, one.AsOverrides() + fidelity +
                             Overrides{"course.goal_x_m=3", "navigation.navigator=pathfinder",
                                       "perception.hazard.enabled=false"});
      EXPECT_NEAR(
          drive.navigation.navigators.params<navigation::GestaltParams>().map.rover.obst_height_m,
          rock.height_m, 1e-9);
      const DriveResult result = RunTrial(drive, {1, 0});
      EXPECT_GT(result.record.max_bogie_deg, 30.0) << "it did drive over the rock";
      EXPECT_EQ(result.record.safeguard_stops, 0.0);
      EXPECT_EQ(result.outcome, truth::TrialOutcome::kGoalReached);
    }
  }
}

}  // namespace
}  // namespace rockyard::trial
