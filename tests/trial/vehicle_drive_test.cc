// Whole drives of a rover that feels: the sensors change what it does, and nothing where they are
// off.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "navigation/gestalt/gestalt_params.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

using truth::TrialOutcome;

const Overrides kQuasiStatic = {"rover.fidelity=quasi_static"};
const Overrides kContact = {"sensors.vehicle.contact.enabled=true"};
const Overrides kTilt = {"sensors.vehicle.accelerometers.enabled=true"};
const Overrides kBlind = {"perception.hazard.enabled=false"};
const Overrides kAll = kContact + kTilt +
                       Overrides{"sensors.vehicle.articulation.enabled=true",
                                 "sensors.vehicle.motor_current.enabled=true"};

// A rover that sees nothing among rocks of 25 to 35 cm.
class BlindRover : public testing::TestWithParam<const char*> {
 protected:
  DriveParams With(const Overrides& sensors) const {
    return Pathfinder("obstacles_0.57", kBlind + sensors +
                                            Overrides{"terrain.arena.kind=open",
                                                      std::string("rover.fidelity=") + GetParam()});
  }
};

// The first turn in place after the touch begins a back-off behind it.
void ExpectBacksOff(const truth::Trace& trace) {
  const std::vector<truth::TraceEvent> all_felt = EventsOf(trace, "felt");
  ASSERT_FALSE(all_felt.empty());
  const auto felt = all_felt.begin();
  EXPECT_THAT(felt->detail, testing::StartsWith("contact"));
  const auto turn =
      std::find_if(trace.samples.begin(), trace.samples.end(), [&](const auto& sample) {
        return sample.time_s > felt->time_s && sample.activity == "turn";
      });
  ASSERT_NE(turn, trace.samples.end());
  const double ahead_m = std::cos(felt->pose.heading_rad) * (turn->pose.x_m - felt->pose.x_m) +
                         std::sin(felt->pose.heading_rad) * (turn->pose.y_m - felt->pose.y_m);
  EXPECT_NEAR(ahead_m, -0.20, 0.05);  // navigation.pathfinder.vehicle_reaction.back_off_m
}

// Fields in which it meets rocks head on and gets stuck. One may go another way where the numerics
// of the rover change.
TEST_P(BlindRover, BacksOffFromARockThatItTouchesAndTurnsAway) {
  int stuck = 0;
  int arrived = 0;
  for (const std::uint32_t index : {4U, 19U, 22U, 24U, 26U, 36U}) {
    const DriveResult without = RunTrial(With({}), {1, index});
    stuck += !truth::DeclaredSuccess(without.outcome);
    EXPECT_EQ(without.record.contact_hazards, 0.0);
    EXPECT_GE(without.record.hazards_missed, 1.0);
    const TracedTrial feeling = RunTraced(With(kContact), index);
    arrived += truth::DeclaredSuccess(feeling.result.outcome);
    EXPECT_GE(feeling.result.record.contact_hazards, 1.0) << index;
    ExpectBacksOff(feeling.trace);
  }
  EXPECT_GE(stuck, 5);
  EXPECT_GE(arrived, 4);
}

INSTANTIATE_TEST_SUITE_P(Fidelities, BlindRover, testing::Values("multibody", "quasi_static"));

// Smooth hills as steep as 40 degrees: a rover that feels its tilt turns back before.
TEST(TiltSensorTest, KeepsTheRoverFromTippingOver) {
  const Overrides hills = kQuasiStatic + Overrides{"terrain.ground.roughness_rms_m=0.3",
                                                   "terrain.ground.roughness_wavelength_m=3",
                                                   "terrain.ground.hurst_exponent=1",
                                                   "terrain.ground.soil.friction_angle_deg=56",
                                                   "referee.tip_over_deg=40"};
  int saved = 0;
  int lost = 0;
  for (std::uint32_t index = 0; index < 60; ++index) {
    const auto tips = [&](const Overrides& overrides) {
      return RunTrial(Pathfinder("level_sand", overrides), {1, index}).outcome ==
             TrialOutcome::kTipOver;
    };
    const bool without = tips(hills);
    const bool feeling = tips(hills + kTilt);
    saved += without && !feeling ? 1 : 0;
    lost += feeling && !without ? 1 : 0;
  }
  // Sign test on the pairs that differ, alpha = 0.001: 10 of 10, 15 of 17, 20 of 24.
  EXPECT_GE(saved, 10);
  EXPECT_GE(saved - lost, 3.1 * std::sqrt(saved + lost));
}

TEST(TiltSensorTest, SlopeAboveTheThresholdIsFelt) {
  const auto felt = [](const std::string& slope_deg) {
    return RunTrial(Pathfinder("level_sand", kQuasiStatic + kTilt +
                                                 Overrides{"terrain.ground.slope_deg=" + slope_deg,
                                                           "referee.time_limit_s=60"}),
                    {1, 0})
        .record.tilt_hazards;
  };
  EXPECT_EQ(felt("15"), 0.0);
  EXPECT_GE(felt("30"), 1.0);
}

// A back-off across a mirror line ends on this side of it as well: a rover that drives, either way,
// is at most one tick of driving beyond the line when it is turned. Turns in place and slip on the
// flank of a rock may add to that before it drives.
TEST(MirrorLineTest, BackingOffDoesNotLeadAcross) {
  constexpr double kLine_m = 1.1;
  constexpr double kTick_m = 0.15 / 20.0;
  constexpr double kSlip_m = 0.02;
  const DriveParams drive = Pathfinder(
      "nominal",
      kQuasiStatic + kContact + kBlind +
          Overrides{"terrain.rocks.k_per_m2=0.013", "terrain.ground.soil.law=bekker",
                    "sensors.gyro.level_sand_gain=1.25", "sensors.encoders.level_sand_gain=0.9201",
                    "sensors.encoders.physics_variance_m2_per_m="
                    "1.9e-6",
                    "perception.dead_reckoning.distance_scale="
                    "0.9201"});
  double farthest_m = 0.0;
  for (const std::uint32_t index : {7U, 29U}) {
    for (const truth::TraceSample& sample : RunTraced(drive, index).trace.samples) {
      farthest_m = std::max(farthest_m, std::abs(sample.pose.y_m));
    }
  }
  EXPECT_GE(farthest_m, kLine_m);  // the line was reached
  EXPECT_LT(farthest_m, kLine_m + kTick_m + kSlip_m);
}

// A blind rover that backs off from rocks that it touches believes in none that it met.
TEST(FeltHazardTest, IsNoHazardThatWasBelieved) {
  const DriveParams drive = Pathfinder(
      "obstacles_0.57", kQuasiStatic + kContact + kBlind + Overrides{"terrain.arena.kind=open"});
  for (const std::uint32_t index : {4U, 19U, 22U, 24U, 26U, 36U}) {
    const truth::DriveRecord record = RunTrial(drive, {1, index}).record;
    EXPECT_GE(record.safeguard_stops, 1.0);
    EXPECT_GE(record.turns_in_place, 1.0);
    EXPECT_EQ(record.hazards_believed, 0.0);
    EXPECT_GE(record.hazards_met, 1.0);
  }
}

// Sensors that are off are not there, whatever their parameters say.
TEST(VehicleSensorsTest, ParametersOfSensorsThatAreOffChangeNothing) {
  const DriveParams plain = Pathfinder("obstacles_0.85", kQuasiStatic);
  const DriveParams other =
      Pathfinder("obstacles_0.85",
                 kQuasiStatic + Overrides{"sensors.vehicle.contact.min_force_N=0",
                                          "sensors.vehicle.accelerometers.noise_m_s2=5",
                                          "perception.vehicle_hazard.max_tilt_deg=1",
                                          "navigation.pathfinder.vehicle_reaction.turn_deg=9"});
  for (std::uint32_t index = 0; index < 3; ++index) {
    EXPECT_THAT(Differences(RunTrial(plain, {1, index}), RunTrial(other, {1, index})),
                testing::IsEmpty());
  }
}

// On level ground without rocks there is nothing to feel: the drive is the same, but for the power
// that the accelerometers draw.
TEST(VehicleSensorsTest, NothingIsFeltOnLevelSand) {
  const Overrides slow = {"rover.drive.speed_m_s=0.05"};
  const DriveResult without = RunTrial(Pathfinder("level_sand", kQuasiStatic + slow), {1, 0});
  const DriveResult with = RunTrial(Pathfinder("level_sand", kQuasiStatic + slow + kAll), {1, 0});
  EXPECT_THAT(Differences(without, with), testing::ElementsAre("energy_wh", "active_energy_wh"));
  EXPECT_NEAR(with.record.energy_wh - without.record.energy_wh,
              0.82 * with.record.sim_time_s / 3600.0, 1e-9);
}

TEST(VehicleSensorsTest, TrialsRepeatBitForBit) {
  const DriveParams drive = Pathfinder("obstacles_2.0", kQuasiStatic + kAll + kBlind);
  double felt = 0.0;
  for (std::uint32_t index = 0; index < 3; ++index) {
    const DriveResult first = RunTrial(drive, {1, index});
    EXPECT_THAT(Differences(first, RunTrial(drive, {1, index})), testing::IsEmpty());
    const truth::DriveRecord& record = first.record;
    felt += record.contact_hazards + record.tilt_hazards + record.articulation_hazards +
            record.current_hazards;
  }
  EXPECT_GT(felt, 0.0);
}

TEST(HazardCountsTest, MissesAreAmongTheMet) {
  const DriveParams blind = Pathfinder("obstacles_2.0", kQuasiStatic + kBlind);
  const DriveParams seeing = Pathfinder("obstacles_2.0", kQuasiStatic);
  double missed_blind = 0.0;
  double missed_seeing = 0.0;
  for (std::uint32_t index = 0; index < 10; ++index) {
    const truth::DriveRecord a = RunTrial(blind, {1, index}).record;
    const truth::DriveRecord b = RunTrial(seeing, {1, index}).record;
    EXPECT_LE(a.hazards_missed, a.hazards_met);
    EXPECT_LE(b.hazards_missed, b.hazards_met);
    EXPECT_EQ(a.scan_energy_wh, 0.0);
    EXPECT_NEAR(b.scan_energy_wh, 7.33 * b.scan_time_s / 3600.0, 1e-9);
    missed_blind += a.hazards_missed;
    missed_seeing += b.hazards_missed;
  }
  EXPECT_GT(missed_blind, 5.0);
  EXPECT_LT(missed_seeing, 0.5 * missed_blind);
}

// What a rover must not call an obstacle: gravel that no wheel notices, and single rocks that it is
// allowed to drive over.

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
