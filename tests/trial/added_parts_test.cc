// A navigator that no file of rockyard knows drives a trial: all that the trial asks it are its
// traits.

#include "core/archive.h"
#include "core/error.h"
#include "core/refusals.h"
#include "localization/toy_estimator.h"
#include "navigation/navigator.h"
#include "scenario/shipped.h"
#include "trial/clock/compute_profile.h"
#include "trial/shipped_trials.h"
#include "trial/toy_terrain_sensor.h"

namespace rockyard::trial {
namespace {

using core::Assumed;
using navigation::CostOfJudgement;
using navigation::CostOfLook;
using navigation::CostOfMap;
using navigation::LookReading;
using testing::HasSubstr;

// What the toy is told and what it does, for one test at a time.
struct ToyParams {
  double goal_tolerance_m = 0.1;
  std::int64_t looks = 2;  // before it gives up
  LookReading reads = LookReading::kHazardReport;
  navigation::DecisionCost cost = CostOfJudgement{};
  std::optional<navigation::StripeNames> stripes = {};
  std::optional<navigation::BelievedSize> size = {};
  bool follows_route = false;
  struct Seen {
    int reports = 0;
    int clouds = 0;
    std::size_t corners = 0;
    bool judges_hazards = false;
  };
  std::shared_ptr<Seen> seen = std::make_shared<Seen>();

  void Visit(core::FieldVisitor& v) {
    v.Integer("looks", looks, Assumed("before it gives up", {}, {0, 100}));
  }
};

// Stands, looks, and gives up.
class Toy final : public navigation::Navigator {
 public:
  Toy(const ToyParams& params, const navigation::NavigatorSetup& setup) : params_(params) {
    params_.seen->corners = setup.route.corners.size();
    params_.seen->judges_hazards = setup.judges_hazards;
  }

  navigation::NavigatorDecision Decide(const navigation::NavigatorInput& input) override {
    params_.seen->reports += input.report != nullptr ? 1 : 0;
    params_.seen->clouds += input.cloud != nullptr ? 1 : 0;
    if (looks_ == params_.looks) return {.status = navigation::NavigatorStatus::kGaveUp};
    ++looks_;
    return {.look = messages::LookDirection::kAhead};
  }
  void OnPoseUpdate(const messages::PoseEstimate&, const messages::PoseEstimate&) override {}
  void SetGoal(const messages::Goal&, navigation::GoalChange) override {}

 private:
  ToyParams params_;
  std::int64_t looks_ = 0;
};

DriveParams WithToy(const ToyParams& params, const Overrides& overrides = {}) {
  scenario::Scenario defaults;
  defaults.drive.navigation.navigators.Add<ToyParams>(
      {.name = "toy",
       .doc = "looks and gives up",
       .traits = [](const ToyParams& p) -> navigation::NavigatorTraits {
         navigation::NavigatorTraits traits(p.reads, p.cost,
                                            {"goal_tolerance_m", p.goal_tolerance_m});
         traits.stripes = p.stripes;
         traits.size = p.size;
         traits.follows_route = p.follows_route;
         return traits;
       },
       .make = [](const ToyParams& p, const navigation::NavigatorSetup& setup)
           -> std::unique_ptr<navigation::Navigator> { return std::make_unique<Toy>(p, setup); }},
      params);
  const Overrides toy = {"navigation.navigator=toy", "rover.fidelity=quasi_static"};
  return scenario::Shipped("pathfinder/nominal", toy + overrides, defaults).drive;
}

// "PATH REASON" of the only thing that is wrong.
std::string ProblemOf(const ToyParams& params, const Overrides& overrides = {}) {
  const auto problems = core::ProblemsIn([&] { WithToy(params, overrides); });
  EXPECT_LE(problems.size(), 1U);
  return problems.empty() ? "" : problems[0].path + " " + problems[0].reason;
}

// A rock of 40 cm that a rover at the start has in its array.
const Overrides kRockAhead = {"terrain.rocks.kind=listed",
                              "terrain.rocks.listed.x_m=[1.6]",
                              "terrain.rocks.listed.y_m=[0.0]",
                              "terrain.rocks.listed.diameter_m=[0.4]",
                              "terrain.rocks.listed.height_m=[0.3]",
                              "terrain.rocks.clear_radius_m=0",
                              "course.start_x_m=1.0"};

TEST(AddedNavigator, GetsWhatItReadsAndItsKeysAreReadFromTheScenario) {
  ToyParams params;
  DriveResult result = RunTrial(WithToy(params, {"navigation.toy.looks=3"}), {1, 0});
  EXPECT_EQ(result.outcome, truth::TrialOutcome::kNoPath);
  EXPECT_EQ(params.seen->reports, 3);
  EXPECT_EQ(params.seen->clouds, 0);
  EXPECT_TRUE(params.seen->judges_hazards);
  EXPECT_EQ(params.seen->corners, 0U);

  ToyParams points = {.reads = LookReading::kPoints};
  RunTrial(WithToy(points), {1, 0});
  EXPECT_EQ(points.seen->reports, 0);
  EXPECT_EQ(points.seen->clouds, 2);

  ToyParams blind;
  RunTrial(WithToy(blind, {"perception.hazard.enabled=false"}), {1, 0});
  EXPECT_FALSE(blind.seen->judges_hazards);
}

// The rock is met by whoever is told of hazards, and by nobody else.
TEST(AddedNavigator, MeetsHazardsWhereItReadsReports) {
  ToyParams params;
  EXPECT_EQ(RunTrial(WithToy(params, kRockAhead), {1, 0}).record.hazards_met, 1.0);
  params.reads = LookReading::kPoints;
  EXPECT_EQ(RunTrial(WithToy(params, kRockAhead), {1, 0}).record.hazards_met, 0.0);
}

// With stereo that is the array which its points are judged in. The rock reaches from 0.8 m ahead
// of the rover to 1.2 m.
TEST(AddedNavigator, MeetsHazardsWithinTheArrayOfItsSensor) {
  const auto met = [](const std::string& far_m) {
    const Overrides stereo = {"sensors.terrain_sensor=stereo", "terrain.rocks.pointedness=0",
                              "terrain.rocks.listed.x_m=[2.0]",
                              "perception.cloud_elevations.far_m=" + far_m};
    return RunTrial(WithToy(ToyParams{}, kRockAhead + stereo), {1, 0}).record.hazards_met;
  };
  EXPECT_EQ(met("0.82"), 1.0);
  EXPECT_EQ(met("0.78"), 0.0);
}

TEST(AddedNavigator, FollowsTheRouteOfAnOracleWhereItAsksForOne) {
  ToyParams params{.follows_route = true};
  RunTrial(WithToy(params), {1, 0});
  EXPECT_GE(params.seen->corners, 1U);
  EXPECT_THAT(ProblemOf(params, {"course.waypoints.x_m=[2]", "course.waypoints.y_m=[0]"}),
              HasSubstr("course.waypoints.x_m names waypoints where navigation.navigator is toy"));
  EXPECT_THAT(ProblemOf(params, {"course.tracking.enabled=true"}),
              HasSubstr("course.tracking.enabled is true where navigation.navigator is toy"));
}

// A look with stereo on the Athena SDM, with the costs that a navigator can have.
TEST(AddedNavigator, ALookTakesWhatItsDecisionCosts) {
  const Overrides stereo = {"sensors.terrain_sensor=stereo", "terrain.rocks.pointedness=0",
                            "clock.compute.computer=r3000_12mhz", "clock.compute.behaviour_s=0.75"};
  ToyParams params = {.reads = LookReading::kNothing};
  const auto computing_s = [&](const navigation::DecisionCost& cost) {
    params.cost = cost;
    return MakeLookTime(WithToy(params, stereo)).computing_s;
  };
  const double stereo_s = computing_s(CostOfLook{});
  EXPECT_DOUBLE_EQ(computing_s(CostOfLook{1.5}), stereo_s + 1.5);
  EXPECT_DOUBLE_EQ(computing_s(CostOfJudgement{}), stereo_s + 0.75);
  // Goldberg 2002, table 2: rows of cells grow with the area, path votes do not.
  const double map_s = computing_s(CostOfMap{0.2, 100.0}) - stereo_s;
  const double wide_s = computing_s(CostOfMap{0.2, 200.0}) - stereo_s;
  EXPECT_GT(map_s, 0.0);
  EXPECT_GT(wide_s, map_s);
  EXPECT_LT(wide_s, 2.0 * map_s);
}

// The software that a computer starts has a map, whoever decides: its grid is the navigator's own,
// else GESTALT's. Goldberg 2002, table 3: memory for the cells grows with their number.
TEST(AddedNavigator, TheComputerStartsWithTheMapThatIsOnBoard) {
  const Overrides stereo = {"sensors.terrain_sensor=stereo", "terrain.rocks.pointedness=0",
                            "clock.compute.computer=pentium_3_500mhz"};
  ToyParams params;
  const auto start_up_s = [&](const navigation::DecisionCost& cost, const std::string& xN_m) {
    params.cost = cost;
    return StartUpTime(
        WithToy(params, stereo + Overrides{"navigation.gestalt.map.grid.xN_m=" + xN_m}));
  };
  const double small_s = start_up_s(CostOfLook{}, "10");
  EXPECT_GT(small_s, 0.0);
  EXPECT_NEAR(start_up_s(CostOfLook{}, "20"), 2.0 * small_s, 1e-9);
  EXPECT_NEAR(start_up_s(CostOfMap{0.2, 100.0}, "20"), small_s, 1e-9);
  EXPECT_NEAR(start_up_s(CostOfMap{0.2, 300.0}, "20"), 3.0 * small_s, 1e-9);
}

// A look with light stripes takes what its scan takes, and what a map adds: the criteria of a
// behaviour controller are part of the scan.
TEST(AddedNavigator, OnlyAMapTakesAComputerWithLightStripes) {
  const Overrides computer = {"clock.compute.computer=pentium_3_500mhz",
                              "clock.compute.behaviour_s=0.75"};
  ToyParams params;
  EXPECT_EQ(StartUpTime(WithToy(params, computer)), 0.0);
  EXPECT_EQ(MakeLookTime(WithToy(params, computer)).computing_s, 0.0);
  params.cost = CostOfMap{};
  EXPECT_GT(StartUpTime(WithToy(params, computer)), 0.0);
  EXPECT_GT(MakeLookTime(WithToy(params, computer)).computing_s, 0.0);
}

TEST(AddedNavigator, ItsConditionsNameItsOwnParameters) {
  EXPECT_THAT(ProblemOf({.goal_tolerance_m = 5.0}),
              HasSubstr("course.goal_radius_m is below navigation.toy.goal_tolerance_m"));
  EXPECT_EQ(ProblemOf({.stripes = navigation::StripeNames{"ears", "names", 5}}), "");
  EXPECT_EQ(ProblemOf({.stripes = navigation::StripeNames{"ears", "names", 4}}),
            "navigation.toy.ears names another number of stripes than sensors.light_stripe has");
  const double length_m = DriveParams{}.rover.geometry.length_m;
  const double width_m = DriveParams{}.rover.geometry.width_m;
  EXPECT_EQ(ProblemOf({.size = navigation::BelievedSize{"long", length_m, "wide", width_m, ""}}),
            "");
  EXPECT_THAT(
      ProblemOf({.size = navigation::BelievedSize{"long", length_m, "wide", 3.0 * width_m, ""}}),
      HasSubstr("navigation.toy.wide is more than a factor of two"));
}

// An estimator that no file of rockyard knows localizes the rover of a trial.

DriveParams WithEstimator(const Overrides& overrides) {
  scenario::Scenario defaults;
  defaults.drive.localization.estimators.Add(localization::DescribeToy());
  const Overrides gestalt = {"rover.fidelity=quasi_static", "navigation.navigator=gestalt"};
  const Overrides all = kShortAndEmpty + gestalt + kTrueEncoders + overrides;
  return scenario::Shipped("gestalt/abundance", all, defaults).drive;
}

// It counts what one wheel rolls, without dead reckoning's distance scale.
TEST(AddedEstimator, TellsTheRoverWhereItIs) {
  const auto toy = RunTrial(WithEstimator({"localization.estimator=toy"}), {1, 0});
  const auto flown =
      RunTrial(WithEstimator({"perception.dead_reckoning.distance_scale=1.0"}), {1, 0});
  EXPECT_EQ(toy.outcome, flown.outcome);
  EXPECT_GT(toy.record.dead_reckoned_distance_m, 2.0);
  EXPECT_NEAR(toy.record.dead_reckoned_distance_m, flown.record.dead_reckoned_distance_m, 0.02);
  // The control: one that believes its wheels to roll less far drives on.
  const auto scaled =
      RunTrial(WithEstimator({"perception.dead_reckoning.distance_scale=0.8"}), {1, 0});
  EXPECT_GT(scaled.record.true_distance_m, toy.record.true_distance_m + 0.3);
}

TEST(AddedEstimator, HasItsGroupInAScenario) {
  const DriveParams drive = WithEstimator({"localization.toy.variance_m=0.25"});
  EXPECT_EQ(drive.localization.estimators.params<localization::ToyParams>().variance_m, 0.25);
  EXPECT_EQ(drive.localization.estimators.chosen().name(), "dead_reckoning");
  EXPECT_THAT(core::RefusalOf([] { WithEstimator({"localization.toy.variance_m=2"}); }),
              HasSubstr("localization.toy.variance_m"));
}

// A terrain sensor that no file of rockyard knows looks in a trial.

DriveParams WithSensor(const ToySensorParams& params, const Overrides& overrides) {
  const Overrides all = kShortAndEmpty + Overrides{"rover.fidelity=quasi_static"} + overrides;
  return scenario::Shipped("gestalt/abundance", all, WithToySensor(params)).drive;
}

// Both readings of a look, by a map and by a behaviour controller: each look takes its time.
TEST(AddedTerrainSensor, ShowsTheGroundToEitherNavigator) {
  for (const char* navigator : {"gestalt", "pathfinder"}) {
    const ToySensorParams params;
    const DriveParams drive =
        WithSensor(params, {"sensors.terrain_sensor=toy", "clock.compute.computer=none",
                            std::string("navigation.navigator=") + navigator});
    const DriveResult result = RunTrial(drive, {1, 0});
    const double looks = result.record.image_sets;
    EXPECT_EQ(result.outcome, truth::TrialOutcome::kGoalReached) << navigator << result.detail;
    EXPECT_GT(looks, 2.0) << navigator;
    EXPECT_EQ(looks, static_cast<double>(params.poses->size())) << navigator;
    EXPECT_NEAR(result.record.imaging_time_s, 0.12 * looks, 1e-9) << navigator;
    EXPECT_NEAR(result.record.compute_time_s, 0.2 * looks, 1e-9) << navigator;
    EXPECT_EQ(result.record.scans, 0.0) << navigator;
  }
}

TEST(AddedTerrainSensor, HasItsGroupAndItsConditionsInAScenario) {
  const auto problem = [](const Overrides& overrides) -> std::string {
    return core::RefusalOf([&] { WithSensor({}, overrides); });
  };
  EXPECT_EQ(problem({"sensors.toy.computing_s=60"}), "");  // of a sensor that is not chosen
  EXPECT_THAT(problem({"sensors.terrain_sensor=toy", "sensors.toy.computing_s=60"}),
              HasSubstr("sensors.toy.computing_s"));
  EXPECT_THAT(problem({"sensors.toy.imaging_s=-1"}), HasSubstr("sensors.toy.imaging_s"));
  EXPECT_THAT(problem({"sensors.terrain_sensor=toi"}), HasSubstr("toy"));
}

TEST(AddedTerrainSensor, ANameOfAnotherGroupIsRefused) {
  class NamedGyro final : public TerrainSensorKind {
   public:
    NamedGyro() : TerrainSensorKind("gyro", "") {}
    bool has_params() const override { return false; }
    void Visit(core::FieldVisitor&) override {}
    std::unique_ptr<TerrainSensorKind> Clone() const override { return nullptr; }
    bool uses_computer() const override { return false; }
    bool takes_image_sets() const override { return false; }
    void Require(const DriveParams&, core::FieldVisitor&) const override {}
    void RequireDrive(const DriveParams&, core::FieldVisitor&) const override {}
    ReportArray report_array(const DriveParams&) const override { return {}; }
    Zone reported_zone(const DriveParams&) const override { return {}; }
    LookTime look_time(const DriveParams&, const ComputeTimes&) const override { return {}; }
    const sensing::StereoParams* cameras(const DriveParams&) const override { return nullptr; }
    std::unique_ptr<TerrainSensor> MakeSensor(const DriveParams&, core::TrialKey,
                                              RoverCameras&) const override {
      return nullptr;
    }
    std::unique_ptr<TerrainReader> MakeReader(const DriveParams&,
                                              const SightWatchers&) const override {
      return nullptr;
    }
  };
  TerrainSensorSet sensors = StandardTerrainSensors();
  EXPECT_THROW(sensors.Add(std::make_unique<NamedGyro>()), core::UserError);
  EXPECT_THROW(sensors.Add(StandardTerrainSensors().Named("stereo").Clone()), core::UserError);
}

}  // namespace
}  // namespace rockyard::trial
