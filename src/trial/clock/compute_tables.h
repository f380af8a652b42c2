// Times of computing as data. Every step of a navigation cycle: tables 2 and 3 of Goldberg 2002.
// Stereo by the width of the matched images, and what a stereo unit in gates takes: tables 1 and 2
// of Howard 2012 with their text, and Matthies 1995 section 8. Rockyard's own stages on one core of
// today: its benchmarks (results/). compute_profile.cc, the benchmark of GESTALT and tests of
// published values read the tables.
//
// Must stay: published numbers as they are printed. Names of rows in kAthenaRows refer to those of
// kTable3Rows (AthenaRow::grows_as).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace rockyard::trial {

// A time as printed, from one end to the other; both are the same where one number is printed.
struct PrintedTime {
  double width_px;  // of either image as it is matched
  double low_s;
  double high_s;

  constexpr double middle_s() const { return 0.5 * (low_s + high_s); }
};

// Howard 2012 table 2, and section 3: "24 to 30 seconds [...] from a pair of 256 pixel wide images"
// on MER.
inline constexpr PrintedTime kMerStereo{256.0, 24.0, 30.0};

// Howard 2012 table 2, Virtex 5: one number for each width.
inline constexpr std::array kFpgaStereo = {
    PrintedTime{256.0, 0.005, 0.005},
    PrintedTime{512.0, 0.019, 0.019},
    PrintedTime{1024.0, 0.082, 0.082},
};

// Howard 2012 sections 1 and 3: million instructions a second of the RAD6000 of MER and the RAD750
// of MSL, whose ratio makes MSL's 1.32 to 1.65 s of MER's time. The ratio includes the clocks of
// 200 MHz against 20 MHz.
inline constexpr double kMerMips = 22.0;
inline constexpr double kMslMips = 400.0;

// Matthies 1995 section 8, Sparc 10: images of 512 x 480 by a pyramid to 64 x 60, then a time for
// each scanline: for all of the 60 at most, and for the 45 that have range at least.
inline constexpr double kSparc10Pyramid_s = 0.100;
inline constexpr double kSparc10Scanline_s = 0.003;
inline constexpr PrintedTime kSparc10Scanlines{64.0, 45 * kSparc10Scanline_s,
                                               60 * kSparc10Scanline_s};

// Howard 2012 section 3 and Goldberg 2002 table 3: clocks of Athena's Pentium M of 2012 and of the
// Pentium III whose map and votes are printed.
inline constexpr double kPentiumMClock_MHz = 1600.0;
inline constexpr double kPentium3Clock_MHz = 500.0;

// Visual odometry: Howard 2012 table 3 and section 3. MSL's 8.8 s are MER's time times 22 / 400.
inline constexpr double kMerVisualOdometry_s = 160.0;       // images 256 px wide
inline constexpr double kFpgaFeaturesAndMatches_s = 0.016;  // 512 px wide; "+ CPU"

// How the memory or slices of a module in the FPGA grow with the width of the images (Howard 2012
// section 3). The height does not matter (section 2).
enum class WidthGrowth {
  kNotStated,
  kLinear,
  kSquare,
};

// A row of Howard 2012 table 1: blocks of memory and slices of a Virtex 5 for images 512 px wide.
struct FpgaModule {
  std::string_view name;
  int blocks;
  int slices;
  WidthGrowth blocks_growth;
  WidthGrowth slices_growth;
};

inline constexpr double kFpgaTableWidth_px = 512.0;
inline constexpr int kFpgaBlocks = 576;    // of the device
inline constexpr int kFpgaSlices = 40960;  // of the device
inline constexpr int kFpgaBlocksUsed = 136;
inline constexpr int kFpgaSlicesUsed = 29963;

inline constexpr std::array kFpgaModules = {
    FpgaModule{"Stereo Rectification", 2, 1186, WidthGrowth::kLinear, WidthGrowth::kNotStated},
    FpgaModule{"Stereo Filter", 32, 3556, WidthGrowth::kLinear, WidthGrowth::kNotStated},
    FpgaModule{"Stereo Disparity", 36, 13275, WidthGrowth::kSquare, WidthGrowth::kLinear},
    FpgaModule{"VO Harris Feature Detector", 2, 10567, WidthGrowth::kLinear,
               WidthGrowth::kNotStated},
    FpgaModule{"VO SAD Operator", 64, 1379, WidthGrowth::kNotStated, WidthGrowth::kNotStated},
};

// Returns a number of table 1 for images of another width; nothing where the paper states no growth
// and the width is not the table's.
constexpr std::optional<double> AtWidth(int printed, WidthGrowth growth, double width_px) {
  const double ratio = width_px / kFpgaTableWidth_px;
  switch (growth) {
    case WidthGrowth::kLinear:
      return printed * ratio;
    case WidthGrowth::kSquare:
      return printed * ratio * ratio;
    case WidthGrowth::kNotStated:
      break;
  }
  if (width_px == kFpgaTableWidth_px) return printed;
  return std::nullopt;
}

// Rockyard's dense stereo on one core of today, by the width of square images with disparities of
// an eighth of the width, with vectors of 512 bits: levels 3 to 0 of
// results/studies/stereo_speedup.json.
inline constexpr std::array kOwnStereo = {
    PrintedTime{64.0, 0.120e-3, 0.120e-3},
    PrintedTime{128.0, 0.285e-3, 0.285e-3},
    PrintedTime{256.0, 0.862e-3, 0.862e-3},
    PrintedTime{512.0, 2.689e-3, 2.689e-3},
};

// A whole cycle of rockyard's map of GESTALT with 16384 points, 9 m x 9 m in cells of 50, 20 and
// 10 cm (results/gestalt.md): points, planes, traversability and votes.
inline constexpr std::array<double, 3> kOwnCycles_s{0.325e-3, 0.372e-3, 0.541e-3};

// A step of rockyard's visual odometry on images of 512 x 384 pixels with 400 features
// (results/studies/odometry_speed.json).
inline constexpr double kOwnVisualOdometry_s = 2.349e-3;

// The part of a cycle that a row of Goldberg 2002 belongs to: the blocks of its table 2.
enum class Phase {
  kStartUp,      // once a trial
  kAcquisition,  // every pair of images
  kStereo,       // every pair of images
  kNavigation,   // map and votes, every pair of images
  kDriving,      // every move; the rover of the trial takes its own time
};

// How a row's time goes with the grid.
enum class Growth {
  kNone,   // depends on images alone
  kCells,  // with the number of cells, and with their size as in table 3
  kPaths,  // with the size of cells as in table 3: a path of one length crosses more small cells
};

// A row of Goldberg 2002 table 2, R3000 at 12 MHz, 10 m x 10 m in cells of 20 cm; s, mean over all
// samples.
struct AthenaRow {
  std::string_view name;
  Phase phase;
  Growth growth;
  double time_s;
  std::string_view grows_as = {};  // row of table 3; empty: it does not depend on the cells
};

inline constexpr double kAthenaCell_m = 0.2;
inline constexpr double kAthenaArea_m2 = 100.0;
inline constexpr int kAthenaImageSets = 154;
inline constexpr int kAthenaMoves = 105;

inline constexpr std::array kAthenaRows = {
    AthenaRow{"Initializing Images", Phase::kStartUp, Growth::kNone, 0.006},
    AthenaRow{"Initializing JPLStereo", Phase::kStartUp, Growth::kNone, 0.016},
    AthenaRow{"Loading camera models", Phase::kStartUp, Growth::kNone, 0.009},
    AthenaRow{"Initializing BW Votes", Phase::kStartUp, Growth::kNone, 0.013},
    AthenaRow{"Initializing FW Votes", Phase::kStartUp, Growth::kNone, 0.017},
    AthenaRow{"Initializing NavRover", Phase::kStartUp, Growth::kNone, 0.095},
    AthenaRow{"Time for Camera selection", Phase::kAcquisition, Growth::kNone, 0.97},
    AthenaRow{"Time for Exposure setting", Phase::kAcquisition, Growth::kNone, 0.013},
    AthenaRow{"Time for Image grab", Phase::kAcquisition, Growth::kNone, 7.7},
    AthenaRow{"Beginning to process image pair", Phase::kAcquisition, Growth::kNone, 0.16},
    AthenaRow{"About to load images from memory", Phase::kAcquisition, Growth::kNone, 0.014},
    AthenaRow{"Images loaded, now Calling MatchStereo", Phase::kAcquisition, Growth::kNone, 0.117},
    AthenaRow{"Pyramid level box filter", Phase::kStereo, Growth::kNone, 0.277},
    AthenaRow{"Time for DoG and pyrlevel 0 downsample", Phase::kStereo, Growth::kNone, 0.83},
    AthenaRow{"Time for rectification", Phase::kStereo, Growth::kNone, 0.013},
    AthenaRow{"Time for pre-processing", Phase::kStereo, Growth::kNone, 0.013},
    AthenaRow{"Time for correl, minim, subpix, lrlos", Phase::kStereo, Growth::kNone, 3.34},
    AthenaRow{"Time for blob filtering", Phase::kStereo, Growth::kNone, 0.161},
    AthenaRow{"Time to add disparity map to grid", Phase::kNavigation, Growth::kNone, 2.6},
    AthenaRow{"Time to generate planes at useful cell", Phase::kNavigation, Growth::kCells, 5.2,
              "Fit planes"},
    AthenaRow{"Time for traversability analysis", Phase::kNavigation, Growth::kCells, 2.34,
              "Traversability analysis"},
    AthenaRow{"Time for arc creation", Phase::kNavigation, Growth::kNone, 0.014},
    AthenaRow{"Time for path votes", Phase::kNavigation, Growth::kPaths, 3.0, "Path votes"},
    AthenaRow{"Done driving commanded arc", Phase::kDriving, Growth::kNone, 15.0},
};

// Goldberg 2002 table 3: one pair of images, 9 m x 9 m, cells of 50, 20 and 10 cm; s, mean of ten
// runs.
inline constexpr std::array<double, 3> kTable3Cells_m{0.5, 0.2, 0.1};
inline constexpr double kTable3Area_m2 = 81.0;
inline constexpr std::size_t kTable3RowCount = 10;

struct Table3Row {
  std::string_view name;
  Phase phase;
  Growth growth;
  std::array<double, 3> pentium_3_s;
  std::array<double, 3> sparc_s;
  std::array<double, 3> rad6000_s;  // timed in ticks of 1/60 s; 0 in the last row: not available
};

inline constexpr std::array<Table3Row, kTable3RowCount> kTable3Rows = {{
    {"Rover and grid initialization",
     Phase::kStartUp,
     Growth::kCells,
     {0.00218, 0.00611, 0.021},
     {0.022, 0.0258, 0.0789},
     {2.42, 2.37, 2.02}},
    {"DoG and pyrlevel 2 downsample",
     Phase::kStereo,
     Growth::kNone,
     {0.285, 0.283, 0.27},
     {1.06, 1.11, 1.06},
     {4.65, 4.63, 4.76}},
    {"Rectification",
     Phase::kStereo,
     Growth::kNone,
     {0.000104, 0.000105, 0.000104},
     {0.000241, 0.00301, 0.00025},
     {0.0, 0.0, 0.0}},
    {"Pre-processing",
     Phase::kStereo,
     Growth::kNone,
     {3.98e-05, 4.14e-05, 4.02e-05},
     {0.000104, 0.000113, 0.000108},
     {0.0, 0.00167, 0.0}},
    {"Correl, minim, subpix, lrlos",
     Phase::kStereo,
     Growth::kNone,
     {0.0729, 0.0813, 0.0742},
     {0.218, 0.246, 0.271},
     {1.69, 1.69, 1.71}},
    {"Blob filtering",
     Phase::kStereo,
     Growth::kNone,
     {0.00311, 0.0031, 0.00307},
     {0.0177, 0.0165, 0.0154},
     {0.0967, 0.095, 0.0967}},
    {"Fit planes",
     Phase::kNavigation,
     Growth::kCells,
     {0.0294, 0.14, 1.0},
     {0.0761, 0.404, 2.72},
     {1.4, 4.21, 25.1}},
    {"Traversability analysis",
     Phase::kNavigation,
     Growth::kCells,
     {0.00171, 0.0192, 0.144},
     {0.00351, 0.0579, 0.45},
     {0.0567, 0.685, 5.49}},
    {"Path votes",
     Phase::kNavigation,
     Growth::kPaths,
     {0.022, 0.0454, 0.0838},
     {0.0637, 0.126, 0.214},
     {1.15, 1.69, 3.06}},
    {"Generating float range XYZ map",
     Phase::kNavigation,
     Growth::kNone,
     {0.00436, 0.00659, 0.00649},
     {0.0156, 0.0131, 0.0154},
     {0.0, 0.0, 0.0}},
}};

// Goldberg 2002 section 6, on computers that were to be measured: a PowerPC 750 of 133 MHz would be
// "an order of magnitude faster than the MER flight processor", a PowerPC G4 of 500 MHz as a
// co-processor "an order of magnitude" faster than that. Both are known to a factor of the root of
// ten.
inline constexpr double kPowerPc750OverMer = 10.0;
inline constexpr double kPowerPcG4OverPowerPc750 = 10.0;

// The totals of table 3 as printed, by computer and size of cells.
inline constexpr std::array<double, 3> kPentium3Totals_s{0.421, 0.584, 1.61};
inline constexpr std::array<double, 3> kSparcTotals_s{1.48, 2.0, 4.82};
inline constexpr std::array<double, 3> kRad6000Totals_s{11.5, 15.4, 42.2};

}  // namespace rockyard::trial
