// The timing tables of Goldberg 2002 against what the paper prints of them, and what is made of
// them for other grids against closed forms.
#include "trial/eyes/compute_profile.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "trial/eyes/compute_tables.h"

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

}  // namespace
}  // namespace rockyard::trial
