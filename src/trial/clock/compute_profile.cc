#include "trial/clock/compute_profile.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <variant>

#include "core/check.h"
#include "math/functions.h"
#include "trial/clock/compute_tables.h"

namespace rockyard::trial {
namespace {

using Column = std::array<double, 3>;
using Machine = Column Table3Row::*;

constexpr std::array<Machine, 3> kMachines{&Table3Row::pentium_3_s, &Table3Row::sparc_s,
                                           &Table3Row::rad6000_s};

// Returns the time of a row for cells of a size, on the grid of table 3.
double TimeAt(const Column& times_s, Growth growth, double cell_m) {
  const std::size_t first = cell_m > kTable3Cells_m[1] ? 0 : 1;  // of the two nearest sizes
  double share = math::Log(cell_m / kTable3Cells_m[first]) /
                 math::Log(kTable3Cells_m[first + 1] / kTable3Cells_m[first]);
  if (growth == Growth::kNone) share = std::clamp(share, 0.0, 1.0);
  const double from_s = times_s[first];
  const double to_s = times_s[first + 1];
  if (from_s <= 0.0 || to_s <= 0.0) return std::max(0.0, from_s + share * (to_s - from_s));
  return from_s * math::Pow(to_s / from_s, share);
}

// Returns the time of a row of table 3 for cells of that size over the time for the cells of table
// 2: the geometric mean of the machines.
double AthenaGrowth(std::string_view table3_row, double cell_m) {
  const auto row = std::find_if(kTable3Rows.begin(), kTable3Rows.end(),
                                [&](const Table3Row& other) { return other.name == table3_row; });
  EXPECT(row != kTable3Rows.end());
  double sum = 0.0;
  for (const Machine machine : kMachines) {
    const Column& times_s = (*row).*machine;
    sum += math::Log(TimeAt(times_s, row->growth, cell_m) /
                     TimeAt(times_s, row->growth, kAthenaCell_m));
  }
  return math::Exp(sum / static_cast<double>(kMachines.size()));
}

void Add(Phase phase, double time_s, ComputeTimes& times) {
  switch (phase) {
    case Phase::kStartUp:
      times.start_up_s += time_s;
      return;
    case Phase::kAcquisition:
      times.acquisition_s += time_s;
      return;
    case Phase::kStereo:
      times.stereo_s += time_s;
      return;
    case Phase::kNavigation:
      times.navigation_s += time_s;
      return;
    case Phase::kDriving:
      return;
  }
}

ComputeTimes AthenaTimes(const GridSize& grid) {
  ComputeTimes times;
  for (const AthenaRow& row : kAthenaRows) {
    double time_s = row.time_s;
    if (row.growth == Growth::kCells) time_s *= grid.area_m2 / kAthenaArea_m2;
    if (!row.grows_as.empty()) time_s *= AthenaGrowth(row.grows_as, grid.cell_m);
    Add(row.phase, time_s, times);
  }
  return times;
}

ComputeTimes Table3Times(Machine machine, double acquisition_s, const GridSize& grid) {
  ComputeTimes times;
  times.acquisition_s = acquisition_s;
  for (const Table3Row& row : kTable3Rows) {
    double time_s = TimeAt(row.*machine, row.growth, grid.cell_m);
    if (row.growth == Growth::kCells) time_s *= grid.area_m2 / kTable3Area_m2;
    Add(row.phase, time_s, times);
  }
  return times;
}

// Returns the time of stereo in software for images of another width than the printed one: it goes
// with pixels times disparities.
double SoftwareStereo(const PrintedTime& printed, double width_px) {
  const double ratio = width_px / printed.width_px;
  return printed.middle_s() * ratio * ratio * ratio;
}

// Returns the time at a width, on straight lines in the logarithms of time and width through
// `times` and on beyond the outermost two.
template <std::size_t kCount>
double AlongTheLogarithm(const std::array<PrintedTime, kCount>& times, double width_px) {
  static_assert(kCount >= 2);
  std::size_t first = 0;
  while (first + 2 < kCount && width_px >= times[first + 1].width_px) ++first;
  const PrintedTime& from = times[first];
  const PrintedTime& to = times[first + 1];
  const double share = math::Log(width_px / from.width_px) / math::Log(to.width_px / from.width_px);
  return from.middle_s() * math::Pow(to.middle_s() / from.middle_s(), share);
}

ComputeTimes WithStereo(ComputeTimes times, double stereo_s) {
  times.stereo_s = stereo_s;
  return times;
}

// Times of other computers over those of MER's: by instructions a second, and by section 6 of
// Goldberg 2002.
constexpr double kMslShare = kMerMips / kMslMips;
constexpr double kPowerPc750Share = 1.0 / kPowerPc750OverMer;
constexpr double kPowerPcG4Share = kPowerPc750Share / kPowerPcG4OverPowerPc750;

// Returns the times of a computer that takes a share of `times`; the cameras are the same.
ComputeTimes InAShare(const ComputeTimes& times, double share) {
  return {times.start_up_s * share, times.acquisition_s, times.stereo_s * share,
          times.navigation_s * share};
}

// Stereo is the FPGA's; map and votes go by clock from the Pentium III to the Pentium M.
ComputeTimes AthenaTimes2012(const ComputeParams& params, const GridSize& grid, double width_px) {
  const ComputeTimes pentium_3 = Table3Times(&Table3Row::pentium_3_s, params.acquisition_s, grid);
  return WithStereo(InAShare(pentium_3, kPentium3Clock_MHz / kPentiumMClock_MHz),
                    AlongTheLogarithm(kFpgaStereo, width_px) * params.virtex_4_time_factor);
}

// Points take most of a cycle of the map, so that the area of the grid does not matter.
ComputeTimes OwnTimes(const ComputeParams& params, const GridSize& grid, double width_px) {
  return {.acquisition_s = params.acquisition_s,
          .stereo_s = AlongTheLogarithm(kOwnStereo, width_px),
          .navigation_s = TimeAt(kOwnCycles_s, Growth::kPaths, grid.cell_m)};
}

ComputeTimes PublishedTimes(const ComputeParams& params, const GridSize& grid, double width_px) {
  const auto table_3 = [&](Machine machine) {
    return Table3Times(machine, params.acquisition_s, grid);
  };
  const auto mer = [&] {
    return WithStereo(table_3(&Table3Row::rad6000_s), SoftwareStereo(kMerStereo, width_px));
  };
  switch (params.computer) {
    case Computer::kNone:
      return {};
    case Computer::kR3000:
      return AthenaTimes(grid);
    case Computer::kPentium3:
      return table_3(&Table3Row::pentium_3_s);
    case Computer::kSparc:
      return table_3(&Table3Row::sparc_s);
    case Computer::kRad6000:
      return table_3(&Table3Row::rad6000_s);
    case Computer::kMer:
      return mer();
    case Computer::kMsl:
      return InAShare(mer(), kMslShare);
    case Computer::kPowerPc750:
      return InAShare(mer(), kPowerPc750Share);
    case Computer::kPowerPcG4:
      return InAShare(mer(), kPowerPcG4Share);
    case Computer::kFpga:
      return WithStereo(table_3(&Table3Row::rad6000_s), AlongTheLogarithm(kFpgaStereo, width_px));
    case Computer::kAthena2012:
      return AthenaTimes2012(params, grid, width_px);
    case Computer::kSapphireRapids:
      return OwnTimes(params, grid, width_px);
    case Computer::kSparc10:
      return WithStereo(table_3(&Table3Row::sparc_s),
                        kSparc10Pyramid_s + SoftwareStereo(kSparc10Scanlines, width_px));
  }
  return {};
}

// Returns the time of a computer's stereo in section 5 of Goldberg 2002, or in Matthies 1995.
double SectionStereo(const ComputeParams& params, Computer computer) {
  ComputeParams other = params;
  other.computer = computer;
  return PublishedTimes(other, {}, kStereoWidth_px).stereo_s;
}

double VisualComputing(const ComputeParams& params) {
  switch (params.computer) {
    case Computer::kNone:
      return 0.0;
    case Computer::kMer:
    case Computer::kRad6000:
      return kMerVisualOdometry_s;
    case Computer::kMsl:
      return kMerVisualOdometry_s * kMerMips / kMslMips;
    case Computer::kPowerPc750:
      return kMerVisualOdometry_s * kPowerPc750Share;
    case Computer::kPowerPcG4:
      return kMerVisualOdometry_s * kPowerPcG4Share;
    case Computer::kFpga:
      return kFpgaFeaturesAndMatches_s + params.visual_cpu_s;
    case Computer::kAthena2012:
      return kFpgaFeaturesAndMatches_s * params.virtex_4_time_factor + params.visual_cpu_s;
    case Computer::kSapphireRapids:
      return kOwnVisualOdometry_s;
    case Computer::kR3000:
    case Computer::kPentium3:
    case Computer::kSparc:
    case Computer::kSparc10:
      break;
  }
  return kMerVisualOdometry_s * SectionStereo(params, params.computer) /
         SectionStereo(params, Computer::kRad6000);
}

}  // namespace

ComputeTimes MakeComputeTimes(const ComputeParams& params, const GridSize& grid,
                              double stereo_width_px) {
  EXPECT(grid.cell_m > 0.0 && grid.area_m2 > 0.0 && stereo_width_px > 0.0);
  ComputeTimes times = PublishedTimes(params, grid, stereo_width_px);
  times.stereo_s *= params.stereo_time_factor;
  times.navigation_s *= params.navigation_time_factor;
  return times;
}

VisualTime VisualTimeOf(const ComputeParams& params) {
  return {PublishedTimes(params, {}, kStereoWidth_px).acquisition_s,
          VisualComputing(params) * params.visual_time_factor};
}

namespace {

using navigation::CostOfJudgement;
using navigation::CostOfLook;
using navigation::CostOfMap;
using navigation::DecisionCost;

DecisionCost CostOf(const DriveParams& drive) {
  return drive.navigation.navigators.chosen().traits().cost;
}

// Returns the grid of the map that the computer sets up when it starts: the map of the navigator,
// or where it keeps none, of the first navigator that keeps one, whose software is on board whoever
// decides.
GridSize GridOf(const DriveParams& drive) {
  const auto grid_of = [](const DecisionCost& cost) -> std::optional<GridSize> {
    const auto* map = std::get_if<CostOfMap>(&cost);
    if (map == nullptr) return std::nullopt;
    return GridSize{.cell_m = map->cell_m, .area_m2 = map->area_m2};
  };
  if (const auto own = grid_of(CostOf(drive))) return *own;
  for (const auto& kind : drive.navigation.navigators.kinds()) {
    if (const auto other = grid_of(kind->traits().cost)) return *other;
  }
  return {};
}

ComputeTimes ComputeTimesOf(const DriveParams& drive) {
  const sensing::StereoParams* cameras = drive.sensors.terrain_sensors.chosen().cameras(drive);
  const double width_px =
      cameras == nullptr ? kStereoWidth_px : static_cast<double>(cameras->columns);
  return MakeComputeTimes(drive.clock.compute, GridOf(drive), width_px);
}

bool UsesNavigationSoftware(const DriveParams& drive) {
  return std::holds_alternative<CostOfMap>(CostOf(drive));
}

bool JudgesElevations(const DriveParams& drive) {
  return drive.clock.compute.computer != Computer::kNone &&
         std::holds_alternative<CostOfJudgement>(CostOf(drive));
}

}  // namespace

LookTime MakeLookTime(const DriveParams& drive) {
  const ComputeTimes times = ComputeTimesOf(drive);
  LookTime look;
  if (UsesNavigationSoftware(drive)) look.computing_s += times.navigation_s;
  const DecisionCost cost = CostOf(drive);
  if (const auto* own = std::get_if<CostOfLook>(&cost)) look.computing_s += own->time_s;
  const TerrainSensorKind& sensor = drive.sensors.terrain_sensors.chosen();
  const LookTime sensing = sensor.look_time(drive, times);
  look.scanning_s = sensing.scanning_s;
  look.imaging_s = sensing.imaging_s;
  look.computing_s += sensing.computing_s;
  if (sensor.uses_computer() && JudgesElevations(drive)) {
    look.computing_s += drive.clock.compute.behaviour_s;
  }
  return look;
}

double StartUpTime(const DriveParams& drive) {
  const bool computes = drive.sensors.terrain_sensors.chosen().uses_computer();
  return computes || UsesNavigationSoftware(drive) ? ComputeTimesOf(drive).start_up_s : 0.0;
}

}  // namespace rockyard::trial
