// How long a look at the terrain takes, and what of it the computer of the scenario takes (Goldberg
// 2002 sections 5 and 6, Howard 2012 section 3, Matthies 1995 section 8). Drives spend these times,
// visual odometry is ready by them, and doubts about scenarios reckon with them. The printed times
// stand in compute_tables.h. Records of drives depend on the last bit of these times.
#pragma once

#include "sensing/stripe_layout_params.h"
#include "trial/clock/clock_params.h"
#include "trial/clock/compute_params.h"
#include "trial/drive_params.h"

namespace rockyard::trial {

// The grid of a map-based navigator.
struct GridSize {
  double cell_m = 0.2;  // side of a square of the same area as a cell
  double area_m2 = 100.0;
};

// Width of the images that are matched where no sensor says another, px: that of MER's images.
inline constexpr double kStereoWidth_px = 256.0;

// Times of computing, s. Every look takes those parts, but start_up_s, that it has a use for.
struct ComputeTimes {
  double start_up_s = 0.0;  // once, before the first move
  double acquisition_s = 0.0;
  double stereo_s = 0.0;
  double navigation_s = 0.0;  // map and votes
};

// Returns the times of a computer for a grid and a width of images; all are zero with computer
// none. The times of the computers of Goldberg 2002 are sums of the rows of its table 2 or 3.
// Between cells of 50, 20 and 10 cm the times of a row follow a straight line in the logarithms of
// time and size. For other sizes the line of the two nearest sizes goes on for map and votes, while
// rows of images keep the time of the nearest size; where a table has 0 the line is straight in
// time. Rows of cells are scaled by the area of the grid over the area of the table's grid (9 m x 9
// m, or 10 m x 10 m); path votes are not, as paths are as long in any grid.
//
// Table 2 has cells of 20 cm alone. For other cells its times of planes, traversability and path
// votes are assumed to grow as the geometric mean of table 3's machines does; its adding of
// disparities to the grid does not depend on the cells, as table 3's XYZ map does not.
//
// Stereo of tables 2 and 3 takes the time of the images that the tables name, whatever
// `stereo_width_px` > 0. Stereo of the other computers goes with the width. In software it goes as
// the cube of the width, pixels times disparities, eightfold a level of a pyramid (Goldberg 2002
// section 2); the Sparc 10's pyramid on top takes a fixed time. In gates it follows a straight line
// in the logarithms through the printed widths, and on beyond them: between the widths it goes with
// the pixels alone, within 5 % (all disparities at once). Where a range is printed, its middle is
// taken.
//
// Start-up and navigation of the other computers are not published. MER's RAD6000 and the RAD6000
// beside the FPGA are taken to have those of table 3's RAD6000, MSL's computer the same by
// instructions a second, and the Sparc 10 those of table 3's Sparc of 300 MHz, which are a lower
// bound. The PowerPCs of section 6 take a tenth and a hundredth of MER's times, in everything but
// imaging.
//
// Athena of 2012 has stereo in a Virtex 4, whose times are taken to be those of the Virtex 5 (times
// virtex_4_time_factor), and map and votes of table 3's Pentium III by clock, 500 over 1600 MHz.
// The Pentium M of 1.6 GHz moves the rover (Howard 2012 figure 5); navigation runs beside the
// gates, on a processor that is called "Pentium-class" and no more, and is taken to be as fast.
//
// On the core of 2026 stereo follows lines through the widths of compute_tables.h, a cycle of the
// map goes with the size of the cells, and start-up is not timed.
ComputeTimes MakeComputeTimes(const ComputeParams& params, const GridSize& grid,
                              double stereo_width_px = kStereoWidth_px);

// What a pair of images of visual odometry takes, s.
struct VisualTime {
  double imaging_s = 0.0;
  double computing_s = 0.0;  // features, matches, selection and motion
};

// Returns the times of a pair of images on a computer; all are zero with computer none. Published
// are MER's 160 s, MSL's 8.8 s by instructions a second, and the FPGA's 16 ms for features and
// matches of images 512 px wide (Howard 2012 section 3, table 3), to which visual_cpu_s is added
// for the rest. Athena of 2012 takes as long as the FPGA, with virtex_4_time_factor on the 16 ms;
// the PowerPCs take a tenth and a hundredth of MER's time, the core of 2026 what was measured. The
// other computers are assumed to take MER's time times their stereo of section 5 (Goldberg 2002)
// over the RAD6000's there. Width and number of features do not matter, as no times by them are
// published.
VisualTime VisualTimeOf(const ComputeParams& params);

// How long a look at the terrain takes, by what the rover does meanwhile.
struct LookTime {
  double scanning_s = 0.0;
  double imaging_s = 0.0;
  double computing_s = 0.0;

  double total_s() const { return scanning_s + imaging_s + computing_s; }
};

// Returns the time of one look of a drive:
//   light stripe: ScanTime; with a map, navigation on top;
//   stereo: acquisition, stereo, and navigation or the judgement of elevations; without stereo
//   where the navigator reads images alone.
// Times of stereo and navigation are those of MakeComputeTimes.
LookTime MakeLookTime(const DriveParams& drive);

// Returns what the computer takes before the first look, s.
double StartUpTime(const DriveParams& drive);

// Groups of lasers of the published scan: five lasers, two at a time.
inline constexpr int kPublishedLaserGroups = 3;

// Returns the time of one scan of the light stripe, s:
//   T = fixed + (published - fixed) groups / 3 / speed factor,
// as images with each group of lasers on and off have to be taken, clocked out and averaged. The
// published sensor takes 20 s (Matthies 1995, section 6); how the time divides is an assumption
// (clock.scan_fixed_s).
inline double ScanTime(const ClockParams& clock, const sensing::LightStripeParams& sensor) {
  const double share = static_cast<double>(sensing::LaserGroups(sensor)) / kPublishedLaserGroups;
  return clock.scan_fixed_s +
         (clock.scan_time_s - clock.scan_fixed_s) * share / clock.scan_speed_factor;
}

}  // namespace rockyard::trial
