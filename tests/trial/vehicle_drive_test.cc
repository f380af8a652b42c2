// Whole drives of a rover that feels: the sensors change what it does, and nothing where they are
// off.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

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
      "nominal", kQuasiStatic + kContact + kBlind + Overrides{"terrain.rocks.k_per_m2=0.013"});
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

}  // namespace
}  // namespace rockyard::trial
