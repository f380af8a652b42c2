// What a study of mobility says of a rover against closed forms, and what its bands are.
#include "campaign/mobility/mobility.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numeric>

#include "campaign/mobility/mobility_tables.h"
#include "campaign/mobility/step_drive.h"
#include "core/error.h"
#include "core/test_folder.h"
#include "math/angles.h"
#include "rover/soil_reference.h"

namespace rockyard::campaign {
namespace {

using terrain::SoilParams;

SoilParams BekkerOn(terrain::SoilPreset preset) {
  SoilParams soil = terrain::MakeSoil(preset);
  soil.law = terrain::WheelLaw::kBekker;
  return soil;
}

rover::RoverParams QuasiStatic() { return {.fidelity = rover::Fidelity::kQuasiStatic}; }

double Weight_N(const rover::RoverParams& params) {
  return params.mass.total_kg * params.physics.gravity_m_s2;
}

SlopePoint OnSlope(double slope_deg, SlopeWay way = SlopeWay::kUp,
                   const SoilParams& soil = BekkerOn(terrain::SoilPreset::kLandscapingSand),
                   const rover::RoverParams& params = QuasiStatic()) {
  return DriveSlope(params, soil, math::DegToRad(slope_deg), way);
}

// sum tau(u i) T_max = W sin(slope) + sum R, straight up and down.
TEST(SlopeDrive, SlipIsThatOfTheClosedForm) {
  const rover::SoilReference reference{BekkerOn(terrain::SoilPreset::kLandscapingSand)};
  for (const double slope_deg : {0.0, 5.0, 10.0, 15.0, 18.0}) {
    for (const SlopeWay way : {SlopeWay::kUp, SlopeWay::kDown}) {
      const SlopePoint point = OnSlope(slope_deg, way);
      const double rise = way == SlopeWay::kUp ? 1.0 : -1.0;
      const double pull_N = rise * Weight_N(QuasiStatic()) * std::sin(math::DegToRad(slope_deg)) +
                            reference.SumResistance(point.load_N);
      const double expected = reference.SlipForPull(pull_N, point.load_N);
      EXPECT_NEAR(point.slip, expected, 0.02 * std::abs(expected) + 5e-4) << slope_deg;
      EXPECT_EQ(point.state, SlopeState::kDrives);
    }
  }
}

// Work per way of the rims: the motors lift the rover, press the rut and shear the soil.
TEST(SlopeDrive, PowerIsThatOfTheForces) {
  const rover::SoilReference reference{BekkerOn(terrain::SoilPreset::kLandscapingSand)};
  const SlopePoint point = OnSlope(12.0);
  double power_W = 0.0;
  for (const double each : point.power_W) power_W += each;
  const double pull_N = Weight_N(QuasiStatic()) * std::sin(math::DegToRad(12.0)) +
                        reference.SumResistance(point.load_N);
  EXPECT_NEAR(power_W, pull_N * QuasiStatic().drive.speed_m_s, 0.03 * power_W);
}

TEST(SlopeDrive, ARoverThatDoesNotGetOnHasASlipOfOne) {
  const SlopePoint point = OnSlope(40.0);
  EXPECT_EQ(point.state, SlopeState::kSlides);
  EXPECT_EQ(point.slip, 1.0);
}

TEST(SlopeDrive, AWeakMotorStalls) {
  rover::RoverParams weak = QuasiStatic();
  weak.drive.stall_torque_Nm = 0.05;
  const SlopePoint point =
      OnSlope(15.0, SlopeWay::kUp, BekkerOn(terrain::SoilPreset::kLandscapingSand), weak);
  EXPECT_THAT(point.state, testing::AnyOf(SlopeState::kStalls, SlopeState::kSlides));
  EXPECT_EQ(point.slip, 1.0);
}

TEST(SlopeDrive, ATopHeavyRoverTips) {
  rover::RoverParams tall = QuasiStatic();
  tall.mass.chassis_com_z_m = 1.5;
  const SlopePoint point =
      OnSlope(25.0, SlopeWay::kAcross, BekkerOn(terrain::SoilPreset::kHardGround), tall);
  EXPECT_EQ(point.state, SlopeState::kTips);
  EXPECT_EQ(OnSlope(5.0, SlopeWay::kAcross, BekkerOn(terrain::SoilPreset::kHardGround), tall).state,
            SlopeState::kDrives);
}

// Across, the wheels' friction has to bear W sin(slope): its direction is that of the slip.
TEST(SlopeDrive, SideSlipBearsTheWeightAcross) {
  const rover::SoilReference reference{BekkerOn(terrain::SoilPreset::kLandscapingSand)};
  for (const double slope_deg : {5.0, 10.0, 15.0}) {
    const SlopePoint point = OnSlope(slope_deg, SlopeWay::kAcross);
    const double side = (1.0 - point.slip) * std::tan(point.side_slip_rad);
    const double whole = std::hypot(point.slip, side);
    EXPECT_NEAR(reference.Traction(whole, point.load_N) * side / whole,
                Weight_N(QuasiStatic()) * std::sin(math::DegToRad(slope_deg)),
                0.05 * Weight_N(QuasiStatic()) * std::sin(math::DegToRad(slope_deg)))
        << slope_deg;
    EXPECT_GT(point.side_slip_rad, 0.0);
  }
}

TEST(SlopeDrive, BothFidelitiesAgree) {
  rover::RoverParams multibody = QuasiStatic();
  multibody.fidelity = rover::Fidelity::kMultibody;
  const SoilParams soil = BekkerOn(terrain::SoilPreset::kLandscapingSand);
  const double slip = OnSlope(12.0).slip;
  EXPECT_NEAR(OnSlope(12.0, SlopeWay::kUp, soil, multibody).slip, slip, 0.02 * slip);
}

TEST(WheelCurve, IsThatOfTheLaw) {
  const SoilParams soil = BekkerOn(terrain::SoilPreset::kLandscapingSand);
  const rover::SoilReference reference{soil};
  const double load_N = Weight_N(QuasiStatic()) / 6.0;
  for (const WheelPoint& point : WheelCurve(QuasiStatic(), soil)) {
    const double traction_N =
        reference.Share(point.slip, load_N) * reference.LargestTraction(load_N);
    EXPECT_NEAR(point.forces.pull_N, traction_N - reference.Resistance(load_N), 1e-3 * load_N);
    EXPECT_NEAR(point.forces.torque_Nm, 0.065 * traction_N, 1e-4 * load_N);
    EXPECT_NEAR(point.forces.sinkage_m, reference.Sinkage(load_N), 1e-6);
  }
}

// Half the friction of rock does not lift a wheel at 4 cm; a step of a radius is climbed by the
// default rover on hard ground (README.md of src/rover has the heights of steps).
TEST(StepDrive, FrictionDecides) {
  const SoilParams hard = BekkerOn(terrain::SoilPreset::kHardGround);
  EXPECT_TRUE(ClimbsStep({}, hard, 0.065));
  rover::RoverParams slick;
  slick.contact.wheel_rock_friction = 0.1;
  EXPECT_FALSE(ClimbsStep(slick, hard, 0.065));
}

MobilityRequest SmallRequest() {
  MobilityRequest request;
  request.rover = std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/pathfinder/nominal.json";
  request.overrides = {"terrain.ground.soil.law=bekker"};
  request.soils = {"landscaping_sand"};
  request.slopes_deg = {0.0, 10.0, 20.0};
  request.draws = 3;
  request.steps = false;
  request.threads = 1;
  return request;
}

std::string CsvOf(const MobilityRequest& request) {
  const MobilityResult result = StudyMobility(request, {}, {});
  return SlopeTable(result).Csv() + WheelTable(result).Csv() + LimitTable(result).Csv();
}

TEST(Mobility, BandsOfNoSpreadAreTheLine) {
  MobilityRequest request = SmallRequest();
  for (const char* key : {"friction_angle_deg", "exponent", "log_modulus", "log_cohesion",
                          "log_shear_modulus", "log_density"}) {
    request.overrides.push_back(std::string("terrain.ground.soil.spread.") + key + "=0");
  }
  const MobilityTable none = SlopeTable(StudyMobility(request, {}, {}));
  const MobilityTable some = SlopeTable(StudyMobility(SmallRequest(), {}, {}));
  for (std::size_t row = 0; row < none.rows(); ++row) {
    for (const char* end : {"slip_low", "slip_high"}) {
      EXPECT_EQ(none.At(end).cells[row].number(), none.At("slip").cells[row].number());
    }
    EXPECT_LT(some.At("slip_low").cells[row].number(), some.At("slip_high").cells[row].number());
  }
}

TEST(Mobility, ComesOutTheSameWhateverTheThreads) {
  MobilityRequest request = SmallRequest();
  const std::string one = CsvOf(request);
  request.threads = 3;
  EXPECT_EQ(CsvOf(request), one);
  request.seed = 2;
  EXPECT_NE(CsvOf(request), one);
}

// The curve passes the limit of slip where the closed form does.
TEST(Mobility, SteepestSlopeIsThatOfTheClosedForm) {
  MobilityRequest request = SmallRequest();
  request.draws = 0;
  request.slip_limit = 0.5;
  request.slopes_deg = {0.0, 14.0};
  const MobilityCase of = StudyMobility(request, {}, {}).cases.front();
  const rover::SoilReference reference{of.values, of.rover.geometry.wheel_radius_m,
                                       of.rover.geometry.wheel_width_m};
  const auto& loads_N = of.curves.slopes[0][1].load_N;
  const double sine =
      (reference.Traction(0.5, loads_N) - reference.SumResistance(loads_N)) / Weight_N(of.rover);
  EXPECT_NEAR(of.curves.limit_deg, math::RadToDeg(std::asin(sine)), 0.2);
  EXPECT_GT(of.curves.climbs_deg, of.curves.limit_deg + 1.0);
}

// A load is more of everything.
TEST(Mobility, LoadsScaleTheMass) {
  MobilityRequest request = SmallRequest();
  request.draws = 0;
  request.loads = {1.0, 2.0};
  const MobilityResult result = StudyMobility(request, {}, {});
  const auto& one = result.cases[0].curves.slopes[0][1];
  const auto& two = result.cases[1].curves.slopes[0][1];
  const auto sum = [](const messages::PerWheel<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
  };
  const double across_N = Weight_N({}) * std::cos(math::DegToRad(10.0));
  EXPECT_NEAR(sum(one.load_N), across_N, 1e-3 * across_N);
  EXPECT_NEAR(sum(two.load_N), 2.0 * across_N, 1e-3 * across_N);
  EXPECT_GT(two.sinkage_m[0], one.sinkage_m[0]);
}

TEST(Mobility, PresetsKeepTheLawOfTheScenario) {
  MobilityRequest request = SmallRequest();
  request.draws = 0;
  request.soils = {"mars_drift", "own"};
  request.overrides = {"terrain.ground.soil.law=wong_reece",
                       "terrain.ground.soil.friction_angle_deg=35"};
  const MobilityResult result = StudyMobility(request, {}, {});
  const SoilParams& drift = result.cases[0].values;
  EXPECT_EQ(drift.preset, terrain::SoilPreset::kMarsDrift);
  EXPECT_EQ(drift.law, terrain::WheelLaw::kWongReece);
  EXPECT_EQ(drift.cohesion_Pa, terrain::MakeSoil(terrain::SoilPreset::kMarsDrift).cohesion_Pa);
  EXPECT_NEAR(drift.friction_angle_rad, math::DegToRad(35.0), 1e-12);
  EXPECT_EQ(result.cases[1].values.preset, terrain::SoilPreset::kLandscapingSand);
}

TEST(Mobility, AnEarlyEndIsInterrupted) {
  const MobilityResult result =
      StudyMobility(SmallRequest(), {}, {.wanted = [] { return true; }, .watch = {}});
  EXPECT_EQ(result.outcome, Outcome::kInterrupted);
}

std::string ProblemOf(const MobilityRequest& request) {
  try {
    StudyMobility(request, {}, {});
  } catch (const core::UserError& error) {
    return error.what();
  }
  return "";
}

TEST(Mobility, RefusesWhatCannotBeMeant) {
  using testing::HasSubstr;
  MobilityRequest request = SmallRequest();
  request.slopes_deg = {0.0, 75.0};
  EXPECT_THAT(ProblemOf(request), HasSubstr("has 75 deg"));
  request.slopes_deg = {10.0, 5.0};
  EXPECT_THAT(ProblemOf(request), HasSubstr("has 5 after 10 deg"));
  request = SmallRequest();
  request.soils = {"mars_drft"};
  EXPECT_THAT(ProblemOf(request), HasSubstr("did you mean \"mars_drift\"?"));
  request.soils = {"own", "own"};
  EXPECT_THAT(ProblemOf(request), HasSubstr("names own twice"));
  request = SmallRequest();
  request.overrides.push_back("terrain.ground.soil.preset=mars_drift");
  EXPECT_THAT(ProblemOf(request), HasSubstr("--soil own"));
}

class Points : public testing::Test {
 protected:
  std::vector<MeasuredPoint> Read(const std::string& text) const {
    const std::filesystem::path file = folder_.path() / "points.csv";
    std::ofstream(file) << text;
    return ReadPoints(file, std::vector<std::string>{"mars_drift"});
  }
  std::string Refused(const std::string& text) const {
    try {
      Read(text);
    } catch (const core::UserError& error) {
      return error.what();
    }
    return "";
  }
  core::TestFolder folder_;
};

TEST_F(Points, AreReadByTheNamesOfTheirColumns) {
  const auto points =
      Read("# of a test\nslope_deg,slip,soil,way\r\n10,0.2,mars_drift,across\r\n,0.3,,\n");
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].soil, "mars_drift");
  EXPECT_EQ(points[0].way, "across");
  EXPECT_EQ(points[0].values.at("slope_deg"), 10.0);
  EXPECT_EQ(points[1].way, "up");
  EXPECT_FALSE(points[1].values.contains("slope_deg"));
}

TEST_F(Points, AreRefusedWithTheirLine) {
  using testing::HasSubstr;
  EXPECT_THAT(Refused(""), HasSubstr("has no line of names"));
  EXPECT_THAT(Refused("slope_dg,slip\n"), HasSubstr("did you mean \"slope_deg\"?"));
  EXPECT_THAT(Refused("slip\nfast\n"), HasSubstr("line 2: has \"fast\" as slip"));
  EXPECT_THAT(Refused("slip,slope_deg\n0.5\n"), HasSubstr("has 1 fields, the line of names 2"));
  EXPECT_THAT(Refused("soil,slip\nmud,0.5\n"), HasSubstr("has the soil \"mud\""));
}

}  // namespace
}  // namespace rockyard::campaign
