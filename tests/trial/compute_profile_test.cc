// The timing tables of Goldberg 2002 against what the paper prints of them, and what is made of
// them for other grids against closed forms.

#include "trial/clock/compute_profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "core/json_file.h"
#include "trial/clock/compute_tables.h"

namespace rockyard::trial {
namespace {

using Column = std::array<double, 3>;

const Table3Row& RowOf(const std::string& name) {
  for (const Table3Row& row : kTable3Rows) {
    if (row.name == name) return row;
  }
  throw std::logic_error("no row " + name);
}

ComputeTimes TimesOn(Computer computer, const GridSize& grid) {
  return MakeComputeTimes({.computer = computer, .acquisition_s = 0.0}, grid);
}

// Navigation on the 9 m x 9 m of table 3.
double NavigationOn(Computer computer, double cell_m) {
  return TimesOn(computer, {cell_m, kTable3Area_m2}).navigation_s;
}

TEST(Table2Test, RowsSumToThePrintedTotal) {
  double sum_s = 0.0;
  for (const AthenaRow& row : kAthenaRows) sum_s += row.time_s;
  EXPECT_NEAR(sum_s, 42.0, 0.5);  // printed without decimals
}

TEST(Table2Test, BlocksSumAsPrinted) {
  const ComputeTimes times = TimesOn(Computer::kR3000, {kAthenaCell_m, kAthenaArea_m2});
  EXPECT_NEAR(times.start_up_s, 0.006 + 0.016 + 0.009 + 0.013 + 0.017 + 0.095, 1e-12);
  EXPECT_NEAR(times.acquisition_s, 0.97 + 0.013 + 7.7 + 0.16 + 0.014 + 0.117, 1e-12);
  EXPECT_NEAR(times.stereo_s, 0.277 + 0.83 + 0.013 + 0.013 + 3.34 + 0.161, 1e-12);
  EXPECT_NEAR(times.navigation_s, 2.6 + 5.2 + 2.34 + 0.014 + 3.0, 1e-12);
}

// 154 image sets for 105 moves: (8.974 + 4.634 + 13.154) s x 154 / 105 + 15 s = 54.25 s.
TEST(Table2Test, AMoveTakesFiftyFourSecondsOfWhichFifteenAreDriving) {
  const ComputeTimes times = TimesOn(Computer::kR3000, {kAthenaCell_m, kAthenaArea_m2});
  const double look_s = times.acquisition_s + times.stereo_s + times.navigation_s;
  const double driving_s = kAthenaRows.back().time_s;
  EXPECT_EQ(driving_s, 15.0);
  EXPECT_NEAR(look_s * kAthenaImageSets / kAthenaMoves + driving_s, 54.25, 0.005);
}

// Rows are rounded to three digits or fewer; "Fit planes" at 10 cm on the Pentium III is printed as
// 1, a full digit, which alone may be off by half a percent of the total.
TEST(Table3Test, RowsSumToThePrintedTotals) {
  const auto expect = [](Column Table3Row::*machine, const Column& printed_s) {
    for (std::size_t size = 0; size < printed_s.size(); ++size) {
      const double sum_s = std::accumulate(
          kTable3Rows.begin(), kTable3Rows.end(), 0.0,
          [&](double sum, const Table3Row& row) { return sum + (row.*machine)[size]; });
      EXPECT_NEAR(sum_s / printed_s[size], 1.0, 0.005) << size;
    }
  };
  expect(&Table3Row::pentium_3_s, kPentium3Totals_s);
  expect(&Table3Row::sparc_s, kSparcTotals_s);
  expect(&Table3Row::rad6000_s, kRad6000Totals_s);
}

TEST(ComputeTimesTest, PrintedGridsTakeThePrintedTimes) {
  const std::array machines = {std::pair(Computer::kPentium3, &Table3Row::pentium_3_s),
                               std::pair(Computer::kSparc, &Table3Row::sparc_s),
                               std::pair(Computer::kRad6000, &Table3Row::rad6000_s)};
  for (const auto& [computer, machine] : machines) {
    for (std::size_t size = 0; size < kTable3Cells_m.size(); ++size) {
      ComputeTimes sum;
      for (const Table3Row& row : kTable3Rows) {
        const double time_s = (row.*machine)[size];
        if (row.phase == Phase::kStartUp) sum.start_up_s += time_s;
        if (row.phase == Phase::kStereo) sum.stereo_s += time_s;
        if (row.phase == Phase::kNavigation) sum.navigation_s += time_s;
      }
      const ComputeTimes times = TimesOn(computer, {kTable3Cells_m[size], kTable3Area_m2});
      EXPECT_NEAR(times.start_up_s, sum.start_up_s, 1e-12);
      EXPECT_NEAR(times.stereo_s, sum.stereo_s, 1e-12);
      EXPECT_NEAR(times.navigation_s, sum.navigation_s, 1e-12);
    }
  }
}

// Halfway between two sizes in the logarithm lies the geometric mean of the times.
TEST(ComputeTimesTest, TimesBetweenThePrintedSizesAreStraightInTheLogarithm) {
  double expected_s = 0.0;
  for (const Table3Row& row : kTable3Rows) {
    if (row.phase != Phase::kNavigation) continue;
    expected_s += std::sqrt(row.sparc_s[0] * row.sparc_s[1]);
  }
  EXPECT_NEAR(NavigationOn(Computer::kSparc, std::sqrt(0.5 * 0.2)), expected_s, 1e-12);
}

// Half of 10 cm: once more the growth from 20 to 10 cm, t(5) = t(10)^2 / t(20); images stay.
TEST(ComputeTimesTest, GrowthGoesOnBeyondThePrintedSizes) {
  const auto next = [](const char* row) {
    const Column& t = RowOf(row).pentium_3_s;
    return t[2] * t[2] / t[1];
  };
  const double expected_s = next("Fit planes") + next("Traversability analysis") +
                            next("Path votes") +
                            RowOf("Generating float range XYZ map").pentium_3_s[2];
  EXPECT_NEAR(NavigationOn(Computer::kPentium3, 0.05), expected_s, 1e-12);
  EXPECT_EQ(TimesOn(Computer::kPentium3, {0.05, kTable3Area_m2}).stereo_s,
            TimesOn(Computer::kPentium3, {0.1, kTable3Area_m2}).stereo_s);
}

TEST(ComputeTimesTest, TwiceTheAreaIsTwiceTheCellsAndAsLongPaths) {
  const double once_s = NavigationOn(Computer::kRad6000, 0.2);
  const double twice_s = TimesOn(Computer::kRad6000, {0.2, 2.0 * kTable3Area_m2}).navigation_s;
  EXPECT_NEAR(twice_s - once_s, 4.21 + 0.685, 1e-12);  // planes and traversability
}

TEST(ComputeTimesTest, TheR3000GrowsAsTheMachinesOfTable3DoOnAverage) {
  const auto growth = [](const char* name) {
    const Table3Row& row = RowOf(name);
    return std::cbrt(row.pentium_3_s[2] / row.pentium_3_s[1] * row.sparc_s[2] / row.sparc_s[1] *
                     row.rad6000_s[2] / row.rad6000_s[1]);
  };
  const double expected_s = 2.6 + 5.2 * growth("Fit planes") +
                            2.34 * growth("Traversability analysis") + 0.014 +
                            3.0 * growth("Path votes");
  EXPECT_NEAR(TimesOn(Computer::kR3000, {0.1, kAthenaArea_m2}).navigation_s, expected_s, 1e-9);
}

TEST(ComputeTimesTest, WithoutAComputerNothingTakesTime) {
  const ComputeTimes times = MakeComputeTimes(
      {.computer = Computer::kNone, .acquisition_s = 9.0, .stereo_time_factor = 2.0}, {});
  EXPECT_EQ(times.start_up_s + times.acquisition_s + times.stereo_s + times.navigation_s, 0.0);
}

TEST(ComputeTimesTest, AcquisitionOfTable3IsAParameterAndThatOfTable2IsNot) {
  EXPECT_EQ(
      MakeComputeTimes({.computer = Computer::kSparc, .acquisition_s = 3.0}, {}).acquisition_s,
      3.0);
  EXPECT_NEAR(
      MakeComputeTimes({.computer = Computer::kR3000, .acquisition_s = 3.0}, {}).acquisition_s,
      8.974, 1e-12);
}

// Computers of Goldberg 2002 section 6, Athena of 2012 (Howard 2012 section 3) and a core of today
// against printed numbers and closed forms.

constexpr GridSize kTable3Grid{.cell_m = 0.2, .area_m2 = kTable3Area_m2};

ComputeTimes TimesOn(const ComputeParams& params, const GridSize& grid = kTable3Grid,
                     double width_px = kStereoWidth_px) {
  return MakeComputeTimes(params, grid, width_px);
}

double VisualOn(const ComputeParams& params) { return VisualTimeOf(params).computing_s; }

void ExpectRatio(const ComputeTimes& slow, const ComputeTimes& fast, double ratio) {
  EXPECT_NEAR(slow.start_up_s / fast.start_up_s, ratio, 1e-9);
  EXPECT_NEAR(slow.stereo_s / fast.stereo_s, ratio, 1e-9);
  EXPECT_NEAR(slow.navigation_s / fast.navigation_s, ratio, 1e-9);
  EXPECT_EQ(slow.acquisition_s, fast.acquisition_s);
}

// "Which itself will be an order of magnitude faster than the MER flight processor", and "an order
// of magnitude speedup over a rad hard PPC 750".
TEST(PowerPcTest, EachIsAnOrderOfMagnitudeFaster) {
  const auto on = [](Computer computer) { return ComputeParams{.computer = computer}; };
  for (const double width_px : {128.0, 256.0, 512.0}) {
    const auto times = [&](Computer computer) {
      return TimesOn(on(computer), kTable3Grid, width_px);
    };
    ExpectRatio(times(Computer::kMer), times(Computer::kPowerPc750), 10.0);
    ExpectRatio(times(Computer::kPowerPc750), times(Computer::kPowerPcG4), 10.0);
  }
  EXPECT_NEAR(VisualOn(on(Computer::kPowerPc750)), 16.0, 1e-12);
  EXPECT_NEAR(VisualOn(on(Computer::kPowerPcG4)), 1.6, 1e-12);
}

// By clock MSL's PowerPC of 200 MHz would be 1.5 times that of 133 MHz, by instructions a second
// and orders of magnitude it is 1.8 times: both readings lie within the root of ten.
TEST(PowerPcTest, TheReadingsOfTwoPapersAgreeWithinTheirPrecision) {
  const double ratio = TimesOn({.computer = Computer::kPowerPc750}).stereo_s /
                       TimesOn({.computer = Computer::kMsl}).stereo_s;
  EXPECT_NEAR(ratio, 400.0 / 22.0 / 10.0, 1e-9);
  EXPECT_LT(ratio / (200.0 / 133.0), std::sqrt(10.0));
}

TEST(Athena2012Test, StereoIsThatOfTheVirtex5) {
  for (const PrintedTime& printed : kFpgaStereo) {
    EXPECT_EQ(TimesOn({.computer = Computer::kAthena2012}, kTable3Grid, printed.width_px).stereo_s,
              printed.middle_s());
  }
}

// Rows of table 3 for cells of 20 cm, at 500 / 1600 of their time.
TEST(Athena2012Test, MapAndVotesAreThoseOfThePentium3ByClock) {
  const ComputeTimes times = TimesOn({.computer = Computer::kAthena2012});
  EXPECT_NEAR(times.navigation_s, (0.14 + 0.0192 + 0.0454 + 0.00659) / 3.2, 1e-12);
  EXPECT_NEAR(times.start_up_s, 0.00611 / 3.2, 1e-12);
}

TEST(Athena2012Test, PosesComeAtTenHertz) {
  EXPECT_NEAR(VisualOn({.computer = Computer::kAthena2012}), 0.1, 1e-12);
  EXPECT_NEAR(VisualOn({.computer = Computer::kAthena2012, .visual_cpu_s = 0.2}), 0.216, 1e-12);
}

TEST(Athena2012Test, TheVirtex4FactorChangesGatesAlone) {
  const ComputeParams once{.computer = Computer::kAthena2012};
  const ComputeParams twice{.computer = Computer::kAthena2012, .virtex_4_time_factor = 2.0};
  EXPECT_EQ(TimesOn(twice).stereo_s, 2.0 * TimesOn(once).stereo_s);
  EXPECT_EQ(TimesOn(twice).navigation_s, TimesOn(once).navigation_s);
  EXPECT_EQ(TimesOn(twice).start_up_s, TimesOn(once).start_up_s);
  EXPECT_NEAR(VisualOn(twice) - VisualOn(once), 0.016, 1e-12);
  // Negative control: the Virtex 5 of the tables keeps its times.
  const ComputeParams virtex_5{.computer = Computer::kFpga, .virtex_4_time_factor = 2.0};
  EXPECT_EQ(TimesOn(virtex_5).stereo_s, 0.005);
  EXPECT_NEAR(VisualOn(virtex_5), 0.1, 1e-12);
}

TEST(CoreOfTodayTest, TimesAreThoseOfTheStudies) {
  const std::string studies = ROCKYARD_SOURCE_DIR "/results/studies/";
  const core::JsonValue stereo = core::LoadJsonFile(studies + "stereo_speedup.json");
  int levels = 0;
  for (const core::JsonValue& level : stereo.Find("cases")->list()) {
    const std::string& name = level.Find("name")->text();
    if (!name.starts_with("level_")) continue;
    const double width_px = std::ldexp(512.0, -std::stoi(name.substr(6)));
    EXPECT_NEAR(TimesOn({.computer = Computer::kSapphireRapids}, kTable3Grid, width_px).stereo_s,
                1.0 / level.Find("sides")->list().back().Find("pairs_per_s")->number(), 0.5e-6)
        << name;
    ++levels;
  }
  EXPECT_EQ(levels, 4);
  const core::JsonValue odometry = core::LoadJsonFile(studies + "odometry_speed.json");
  EXPECT_NEAR(VisualOn({.computer = Computer::kSapphireRapids}),
              1e-3 * odometry.Find("step_ms")->number(), 0.5e-6);
}

TEST(CoreOfTodayTest, ACycleOfTheMapGoesWithTheCells) {
  const auto map_s = [](double cell_m) {
    return TimesOn({.computer = Computer::kSapphireRapids},
                   {.cell_m = cell_m, .area_m2 = kTable3Area_m2})
        .navigation_s;
  };
  for (std::size_t i = 0; i < kTable3Cells_m.size(); ++i) {
    EXPECT_NEAR(map_s(kTable3Cells_m[i]), kOwnCycles_s[i], 1e-15);
  }
  EXPECT_NEAR(map_s(std::sqrt(0.5 * 0.2)), std::sqrt(kOwnCycles_s[0] * kOwnCycles_s[1]), 1e-15);
  EXPECT_NEAR(map_s(0.05), kOwnCycles_s[2] * kOwnCycles_s[2] / kOwnCycles_s[1], 1e-15);
}

TEST(CoreOfTodayTest, StereoBetweenTheMeasuredWidthsIsStraightInTheLogarithm) {
  const auto stereo_s = [](double width_px) {
    return TimesOn({.computer = Computer::kSapphireRapids}, kTable3Grid, width_px).stereo_s;
  };
  for (std::size_t i = 0; i + 1 < kOwnStereo.size(); ++i) {
    EXPECT_NEAR(stereo_s(kOwnStereo[i].width_px * std::sqrt(2.0)),
                std::sqrt(kOwnStereo[i].low_s * kOwnStereo[i + 1].low_s), 1e-15);
  }
  EXPECT_NEAR(stereo_s(1024), 2.689e-3 * 2.689 / 0.862, 1e-12);
  EXPECT_NEAR(stereo_s(32), 0.120e-3 * 0.120 / 0.285, 1e-12);
}

// Lines of results/studies/compute_times.csv, which the study of a rover's speed reads.
TEST(ComputeTimesStudyTest, ItsFileIsTheProgramsTimes) {
  std::ifstream file(ROCKYARD_SOURCE_DIR "/results/studies/compute_times.csv");
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "computer,width_px,acquisition_s,stereo_s,navigation_s,visual_s");
  constexpr auto& kNames = core::EnumNames<Computer>::kNames;
  std::size_t lines = 0;
  for (; std::getline(file, line); ++lines) {
    std::istringstream cells(line);
    std::string name;
    std::getline(cells, name, ',');
    const auto found = std::find(kNames.begin(), kNames.end(), name);
    ASSERT_NE(found, kNames.end()) << name;
    ComputeParams params{.computer = static_cast<Computer>(found - kNames.begin())};
    params.acquisition_s = params.SuitedAcquisition_s();
    const auto number = [&] {
      std::string text;
      std::getline(cells, text, ',');
      return std::stod(text);
    };
    const ComputeTimes times = TimesOn(params, kTable3Grid, number());
    EXPECT_NEAR(number(), times.acquisition_s, 1e-8) << line;
    EXPECT_NEAR(number(), times.stereo_s, 1e-8) << line;
    EXPECT_NEAR(number(), times.navigation_s, 1e-8) << line;
    EXPECT_NEAR(number(), VisualOn(params), 1e-7) << line;
  }
  EXPECT_EQ(lines, 2 * (kNames.size() - 1));
}

TEST(NavigationFactorTest, ItChangesMapAndVotesAlone) {
  for (const Computer computer : {Computer::kR3000, Computer::kMer, Computer::kAthena2012}) {
    const ComputeTimes once = TimesOn({.computer = computer});
    const ComputeTimes thrice = TimesOn({.computer = computer, .navigation_time_factor = 3.0});
    EXPECT_EQ(thrice.navigation_s, 3.0 * once.navigation_s);
    EXPECT_EQ(thrice.stereo_s, once.stereo_s);
    EXPECT_EQ(thrice.start_up_s, once.start_up_s);
    EXPECT_EQ(thrice.acquisition_s, once.acquisition_s);
  }
}

}  // namespace
}  // namespace rockyard::trial
