// Times of stereo by image width and what stereo takes of an FPGA, against what Howard 2012 and
// Matthies 1995 print, and against what they say of how it grows.

#include <cmath>
#include <map>

#include "core/json_file.h"
#include "core/refusals.h"
#include "scenario/load.h"
#include "trial/clock/compute_profile.h"
#include "trial/clock/compute_tables.h"
#include "trial/clock/power.h"
#include "trial/shipped_trials.h"

namespace rockyard::trial {
namespace {

constexpr GridSize kGrid{0.2, 81.0};  // of table 3 of Goldberg 2002

double StereoOn(Computer computer, double width_px) {
  return MakeComputeTimes({.computer = computer}, kGrid, width_px).stereo_s;
}

ComputeTimes TimesOn(Computer computer) {
  return MakeComputeTimes({.computer = computer, .acquisition_s = 1.5}, kGrid);
}

TEST(StereoTimeTest, PublishedWidthsTakeThePublishedTimes) {
  EXPECT_DOUBLE_EQ(StereoOn(Computer::kMer, 256), 27.0);                // between 24 and 30 s
  EXPECT_NEAR(StereoOn(Computer::kMsl, 256), (1.32 + 1.65) / 2, 1e-9);  // printed
  EXPECT_NEAR(StereoOn(Computer::kFpga, 256), 0.005, 1e-12);
  EXPECT_NEAR(StereoOn(Computer::kFpga, 512), 0.019, 1e-12);
  EXPECT_NEAR(StereoOn(Computer::kFpga, 1024), 0.082, 1e-12);
  // 100 ms, and 3 ms for each of 45 to 60 scanlines.
  EXPECT_NEAR(StereoOn(Computer::kSparc10, 64), 0.100 + (0.135 + 0.180) / 2, 1e-12);
}

TEST(StereoTimeTest, TheFactorReachesEitherEndOfWhatIsPublished) {
  const auto with = [](Computer computer, double factor) {
    return MakeComputeTimes({.computer = computer, .stereo_time_factor = factor}, kGrid).stereo_s;
  };
  EXPECT_NEAR(with(Computer::kMer, 0.89), 24.0, 0.1);
  EXPECT_NEAR(with(Computer::kMer, 1.11), 30.0, 0.1);
  EXPECT_NEAR(with(Computer::kMsl, 0.89), 1.32, 0.005);
  EXPECT_NEAR(with(Computer::kMsl, 1.11), 1.65, 0.005);
  EXPECT_NEAR(with(Computer::kRad6000, 0.5), (4.63 + 0.00167 + 1.69 + 0.095) / 2, 1e-9);
}

TEST(StereoTimeTest, TheFactorChangesStereoAlone) {
  const ComputeTimes once = TimesOn(Computer::kMer);
  const ComputeTimes thrice = MakeComputeTimes(
      {.computer = Computer::kMer, .acquisition_s = 1.5, .stereo_time_factor = 3.0}, kGrid);
  EXPECT_DOUBLE_EQ(thrice.stereo_s, 3.0 * once.stereo_s);
  EXPECT_EQ(thrice.start_up_s, once.start_up_s);
  EXPECT_EQ(thrice.acquisition_s, once.acquisition_s);
  EXPECT_EQ(thrice.navigation_s, once.navigation_s);
}

// Goldberg 2002 section 2: "an 8-fold decrease in computation" a level.
TEST(StereoTimeTest, ALevelOfAPyramidIsAnEighthOfTheTimeInSoftware) {
  EXPECT_NEAR(StereoOn(Computer::kMer, 256) / StereoOn(Computer::kMer, 128), 8.0, 1e-12);
  EXPECT_NEAR(StereoOn(Computer::kMsl, 1024) / StereoOn(Computer::kMsl, 512), 8.0, 1e-12);
  // The pyramid of the Sparc 10 starts from the same images.
  EXPECT_NEAR((StereoOn(Computer::kSparc10, 128) - 0.1) / (StereoOn(Computer::kSparc10, 64) - 0.1),
              8.0, 1e-9);
}

// The published times of the FPGA go with the number of pixels alone.
TEST(StereoTimeTest, TheFpgaIsLinearInPixels) {
  const double a_pixel_s =  // of square images; geometric mean
      std::cbrt(0.005 * 0.019 * 0.082 / std::pow(256.0 * 512.0 * 1024.0, 2));
  for (const double width_px : {256.0, 300.0, 512.0, 700.0, 1024.0}) {
    EXPECT_NEAR(StereoOn(Computer::kFpga, width_px) / (a_pixel_s * width_px * width_px), 1.0, 0.05)
        << width_px;
  }
  // Negative control: not in pixels times disparities.
  EXPECT_GT(8.0 * 0.019 / 0.082, 1.5);
}

TEST(StereoTimeTest, BetweenPrintedWidthsTheFpgaIsStraightInTheLogarithm) {
  EXPECT_NEAR(StereoOn(Computer::kFpga, 256 * std::sqrt(2)), std::sqrt(0.005 * 0.019), 1e-12);
  EXPECT_NEAR(StereoOn(Computer::kFpga, 512 * std::sqrt(2)), std::sqrt(0.019 * 0.082), 1e-12);
  EXPECT_NEAR(StereoOn(Computer::kFpga, 128), 0.005 * 0.005 / 0.019, 1e-12);
  EXPECT_NEAR(StereoOn(Computer::kFpga, 2048), 0.082 * 0.082 / 0.019, 1e-12);
}

// Howard 2012: "an improvement of several orders of magnitude".
TEST(StereoTimeTest, TheFpgaIsThousandsOfTimesAsFastAsMer) {
  const double ratio = StereoOn(Computer::kMer, 256) / StereoOn(Computer::kFpga, 256);
  EXPECT_GT(ratio, 24.0 / 0.005 - 1e-6);
  EXPECT_LT(ratio, 30.0 / 0.005 + 1e-6);
}

// The map keeps table 3: rows of the RAD6000, of 20 cm cells on 81 m^2.
TEST(StereoTimeTest, MapsOfOtherComputersAreThoseOfTable3) {
  const double map_s = 4.21 + 0.685 + 1.69;
  EXPECT_NEAR(TimesOn(Computer::kMer).navigation_s, map_s, 1e-12);
  EXPECT_NEAR(TimesOn(Computer::kFpga).navigation_s, map_s, 1e-12);
  EXPECT_NEAR(TimesOn(Computer::kMsl).navigation_s, map_s * 22 / 400, 1e-12);
  EXPECT_NEAR(TimesOn(Computer::kMer).start_up_s, 2.37, 1e-12);
  EXPECT_NEAR(TimesOn(Computer::kMsl).start_up_s, 2.37 * 22 / 400, 1e-12);
  EXPECT_EQ(TimesOn(Computer::kSparc10).navigation_s, TimesOn(Computer::kSparc).navigation_s);
  EXPECT_EQ(TimesOn(Computer::kSparc10).start_up_s, TimesOn(Computer::kSparc).start_up_s);
  for (const Computer computer :
       {Computer::kMer, Computer::kMsl, Computer::kFpga, Computer::kSparc10}) {
    EXPECT_EQ(TimesOn(computer).acquisition_s, 1.5);
  }
}

TEST(StereoTimeTest, TablesOfGoldbergHoldForTheirImagesAlone) {
  for (const Computer computer :
       {Computer::kR3000, Computer::kPentium3, Computer::kSparc, Computer::kRad6000}) {
    EXPECT_EQ(StereoOn(computer, 64), StereoOn(computer, 1024));
  }
}

TEST(StereoTimeTest, ALookTakesTheTimeOfTheSensorsImages) {
  const auto computing_s = [](const char* computer, const char* columns) {
    return MakeLookTime(Gestalt("abundance", {"clock.compute.computer=" + std::string(computer),
                                              "sensors.stereo.columns=" + std::string(columns)}))
        .computing_s;
  };
  EXPECT_NEAR(computing_s("mer_rad6000", "256") - computing_s("mer_rad6000", "128"),
              27.0 * 7.0 / 8.0, 1e-9);
  EXPECT_NEAR(computing_s("virtex_5_fpga", "256") - computing_s("mer_rad6000", "256"), 0.005 - 27.0,
              1e-9);
  EXPECT_EQ(computing_s("rad6000_20mhz", "256"), computing_s("rad6000_20mhz", "128"));
}

TEST(FpgaTableTest, ModulesSumToThePrintedTotals) {
  int blocks = 0;
  int slices = 0;
  for (const FpgaModule& module : kFpgaModules) {
    blocks += module.blocks;
    slices += module.slices;
  }
  EXPECT_EQ(blocks, kFpgaBlocksUsed);
  EXPECT_EQ(slices, kFpgaSlicesUsed);
  EXPECT_NEAR(100.0 * slices / kFpgaSlices, 73.0, 0.5);
  // Printed as 27 %; 136 of 576 are 23.6 %.
  EXPECT_NEAR(100.0 * blocks / kFpgaBlocks, 23.6, 0.05);
}

TEST(FpgaTableTest, MemoryOfDisparityGoesWithTheSquareOfTheWidth) {
  const FpgaModule& disparity = kFpgaModules[2];
  ASSERT_EQ(disparity.name, "Stereo Disparity");
  const auto at = [&](double width_px) {
    return AtWidth(disparity.blocks, disparity.blocks_growth, width_px).value();
  };
  EXPECT_EQ(at(512), 36);
  EXPECT_EQ(at(1024), 4 * 36);
  EXPECT_EQ(at(256), 36 / 4);
  EXPECT_EQ(AtWidth(disparity.slices, disparity.slices_growth, 1024).value(), 2 * 13275);
}

TEST(FpgaTableTest, MemoryOfRectificationFilterAndHarrisGoesWithTheWidth) {
  int linear = 0;
  for (const FpgaModule& module : kFpgaModules) {
    const auto blocks = AtWidth(module.blocks, module.blocks_growth, 1024);
    if (module.name == "Stereo Rectification" || module.name == "Stereo Filter" ||
        module.name == "VO Harris Feature Detector") {
      EXPECT_EQ(blocks.value(), 2 * module.blocks) << module.name;
      ++linear;
    }
  }
  EXPECT_EQ(linear, 3);
}

TEST(FpgaTableTest, NothingIsSaidOfTheRest) {
  for (const FpgaModule& module : kFpgaModules) {
    const bool disparity = module.name == "Stereo Disparity";
    EXPECT_EQ(AtWidth(module.slices, module.slices_growth, 256).has_value(), disparity)
        << module.name;
    EXPECT_EQ(AtWidth(module.slices, module.slices_growth, 512).value(), module.slices);
    EXPECT_EQ(AtWidth(module.blocks, module.blocks_growth, 512).value(), module.blocks);
  }
  EXPECT_FALSE(AtWidth(64, kFpgaModules[4].blocks_growth, 256).has_value());
}

// Inputs of a row of the published values.
std::vector<double> InputsOf(const std::string& id) {
  const core::JsonValue document =
      core::LoadJsonFile(ROCKYARD_SOURCE_DIR "/results/reference/howard2012.json");
  std::vector<double> inputs;
  for (const core::JsonValue& row : document.Find("values")->list()) {
    if (row.Find("id")->text() != id) continue;
    for (const core::JsonValue& input : row.Find("inputs")->list()) {
      inputs.push_back(input.number());
    }
  }
  return inputs;
}

// Rows of the published values compute with the numbers that the program has.
TEST(FpgaTableTest, PublishedValuesAreTheProgramsNumbers) {
  std::vector<double> blocks;
  std::vector<double> slices;
  for (const FpgaModule& module : kFpgaModules) {
    blocks.push_back(module.blocks);
    slices.push_back(module.slices);
  }
  EXPECT_EQ(InputsOf("fpga.blocks"), blocks);
  EXPECT_EQ(InputsOf("fpga.slices"), slices);
  EXPECT_EQ(InputsOf("fpga.blocks_share"),
            (std::vector<double>{100.0 * kFpgaBlocksUsed, kFpgaBlocks}));
  EXPECT_EQ(InputsOf("fpga.slices_share"),
            (std::vector<double>{100.0 * kFpgaSlicesUsed, kFpgaSlices}));
  EXPECT_EQ(InputsOf("stereo.mer_256").at(0), StereoOn(Computer::kMer, 256));
  const std::vector<double> msl = InputsOf("stereo.msl_256");
  EXPECT_NEAR(msl.at(0) * msl.at(1) * msl.at(2), StereoOn(Computer::kMsl, 256), 1e-9);
  for (const PrintedTime& at : kFpgaStereo) {
    const std::vector<double> row =
        InputsOf("stereo.fpga_" + std::to_string(static_cast<int>(at.width_px)));
    EXPECT_EQ(row.at(1), at.width_px);
    EXPECT_NEAR(row.at(0) * row.at(1) * row.at(2) / at.middle_s(), 1.0, 0.05);
  }
}

// The computer and sensor profiles: what a scan takes with each, and that a scenario can name one.

const std::filesystem::path kScenarios = std::filesystem::path(ROCKYARD_SOURCE_DIR) / "scenarios";

DriveParams With(const std::string& profile) {
  return scenario::ParseScenario(R"({"extends": ["mars/mfex_nominal.json", "sensors/profile_)" +
                                     profile + R"(.json"]})",
                                 {}, kScenarios)
      .drive;
}

TEST(SensorProfileTest, ScansTakeWhatTheirPartsTake) {
  struct Scan {
    double time_s, power_W;
  };
  constexpr double kLaser_W = 2.01 / 2.0;
  constexpr double kRest_W = 7.33 - 2.01;
  // T = 2 + 18 groups / 3 / speed; nine stripes two at a time are five groups.
  const std::map<std::string, Scan> expected{
      {"mfex_8085", {20.0, 7.33}},
      {"cmos", {2.0 + 18.0 / 10.0, 7.33 - 0.9 * 0.75}},
      {"all_lasers_at_once", {2.0 + 18.0 / 3.0, kRest_W + 5.0 * kLaser_W}},
      {"three_scanline_fan", {2.0 + 18.0 / 3.0, kRest_W + 20.0 * 0.01 * kLaser_W}},
      {"dense_array", {2.0 + 18.0 * 5.0 / 3.0, 7.33}}};
  for (const auto& [profile, scan] : expected) {
    const DriveParams drive = With(profile);
    EXPECT_NEAR(ScanTime(drive.clock, drive.sensors.light_stripe), scan.time_s, 1e-12) << profile;
    EXPECT_NEAR(MakePowerBudget(drive).Power(Activity::kScanning), scan.power_W, 1e-12) << profile;
  }
}

TEST(SensorProfileTest, EveryStripeOfADenserArrayNeedsASide) {
  // Nine stripes, five of them named.
  EXPECT_THAT(
      core::ProblemsIn([] {
        scenario::ParseScenario(R"({"sensors": {"light_stripe": {"stripe_subdivision": 2}}})");
      }),
      core::OneProblem("navigation.pathfinder.left_stripes", "another number of stripes"));
}

TEST(SensorProfileTest, WrongTimesAndPowersAreNamed) {
  const std::map<std::string, std::string> wrong{
      {"clock.scan_fixed_s", "21"},
      {"clock.scan_speed_factor", "0"},
      {"energy.laser_supply_efficiency", "0"},
      {"energy.imaging_W", "-1"},
      {"perception.vehicle_hazard.max_tilt_deg", "0"},
      {"perception.vehicle_hazard.tilt_ticks", "0"},
      {"navigation.pathfinder.vehicle_reaction.back_off_m", "0"},
      {"referee.hazard_height_m", "-0.1"}};
  for (const auto& [path, value] : wrong) {
    const std::vector<std::string> overrides{path + "=" + value};
    EXPECT_THAT(core::ProblemsIn([&] { scenario::ParseScenario("{}", overrides); }),
                core::OneProblem(path, ""));
  }
}

}  // namespace
}  // namespace rockyard::trial
