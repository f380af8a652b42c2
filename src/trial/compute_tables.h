// Tables 2 and 3 of Goldberg 2002 as data: mean times of every step of a navigation cycle. The
// clock of a trial and the benchmark of GESTALT read them here.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace rockyard::trial {

// The part of a cycle that a row belongs to; the blocks of table 2.
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
  kCells,  // with the number of cells, and as table 3 has it with their size
  kPaths,  // as table 3 has it with the size of cells: as long a path crosses more of them
};

// Table 2, R3000 at 12 MHz, 10 m x 10 m in cells of 20 cm; s, mean over all samples.
struct AthenaRow {
  std::string_view name;
  Phase phase;
  Growth growth;
  double time_s;
  std::string_view grows_as = {};  // row of table 3; empty: whatever the cells
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

// Table 3: one pair of images, 9 m x 9 m, cells of 50, 20 and 10 cm; s, mean of ten runs.
inline constexpr std::array<double, 3> kTable3Cells_m{0.5, 0.2, 0.1};
inline constexpr double kTable3Area_m2 = 81.0;
inline constexpr std::size_t kTable3RowCount = 10;

struct Table3Row {
  std::string_view name;
  Phase phase;
  Growth growth;
  std::array<double, 3> pentium_3_s;
  std::array<double, 3> sparc_s;
  std::array<double, 3> rad6000_s;  // in ticks of 1/60 s; the last row is not available (0 here)
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

// Section 6, of computers that were to be measured: a PowerPC 750 of 133 MHz would be "an order of
// magnitude faster than the MER flight processor", a PowerPC G4 of 500 MHz as a co-processor "an
// order of magnitude" faster than that. Known to a factor of the root of ten.
inline constexpr double kPowerPc750OverMer = 10.0;
inline constexpr double kPowerPcG4OverPowerPc750 = 10.0;

// The totals as printed, by computer and size of cells.
inline constexpr std::array<double, 3> kPentium3Totals_s{0.421, 0.584, 1.61};
inline constexpr std::array<double, 3> kSparcTotals_s{1.48, 2.0, 4.82};
inline constexpr std::array<double, 3> kRad6000Totals_s{11.5, 15.4, 42.2};

}  // namespace rockyard::trial
