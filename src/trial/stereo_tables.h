// Published times of stereo by the width of the matched images, and what a stereo unit in gates
// takes: Howard 2012 tables 1 and 2 with their text, and Matthies 1995 section 8 as data.
#pragma once

#include <array>
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

// Table 2, and section 3: "24 to 30 seconds [...] from a pair of 256 pixel wide images" on MER.
inline constexpr PrintedTime kMerStereo{256.0, 24.0, 30.0};

// Table 2, Virtex 5: one number a width.
inline constexpr std::array kFpgaStereo = {
    PrintedTime{256.0, 0.005, 0.005},
    PrintedTime{512.0, 0.019, 0.019},
    PrintedTime{1024.0, 0.082, 0.082},
};

// Sections 1 and 3: million instructions a second of the RAD6000 of MER and the RAD750 of MSL,
// whose ratio makes MSL's 1.32 to 1.65 s of MER's time. A clock of 200 MHz against 20 MHz is in it.
inline constexpr double kMerMips = 22.0;
inline constexpr double kMslMips = 400.0;

// Matthies 1995 section 8, Sparc 10: images of 512 x 480 by a pyramid to 64 x 60, then a time for
// each scanline. All of the 60 are computed at most, and the 45 with range at least.
inline constexpr double kSparc10Pyramid_s = 0.100;
inline constexpr double kSparc10Scanline_s = 0.003;
inline constexpr PrintedTime kSparc10Scanlines{64.0, 45 * kSparc10Scanline_s,
                                               60 * kSparc10Scanline_s};

// Howard 2012 section 3 and Goldberg 2002 table 3: clocks of Athena's Pentium M of 2012 and of the
// Pentium III whose map and votes are printed.
inline constexpr double kPentiumMClock_MHz = 1600.0;
inline constexpr double kPentium3Clock_MHz = 500.0;

// Visual odometry: table 3 and section 3. MSL's 8.8 s are MER's times 22 / 400.
inline constexpr double kMerVisualOdometry_s = 160.0;       // images 256 px wide
inline constexpr double kFpgaFeaturesAndMatches_s = 0.016;  // 512 px wide; "+ CPU"

// How what a module takes goes with the width of the images; section 3. The height does not matter
// (section 2).
enum class WidthGrowth {
  kNotStated,
  kLinear,
  kSquare,
};

// Table 1: blocks of memory and slices of a Virtex 5 for images 512 px wide.
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

// What a number of table 1 is for images of another width; nothing where the paper states no growth
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

}  // namespace rockyard::trial
