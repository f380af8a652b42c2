// What a look takes on the computer of the scenario (Goldberg 2002 sections 5 and 6, Howard 2012
// section 3, Matthies 1995 section 8).
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

// Width of the images that are matched where nothing else is said, px: that of MER's.
inline constexpr double kStereoWidth_px = 256.0;

// s. Every look takes all parts but the first, or those of them that it has a use for.
struct ComputeTimes {
  double start_up_s = 0.0;  // once, before the first move
  double acquisition_s = 0.0;
  double stereo_s = 0.0;
  double navigation_s = 0.0;  // map and votes
};

// Sums of the rows of table 2 or 3 for a grid, zero with computer none. Between cells of 50, 20 and
// 10 cm times follow a straight line in the logarithms of time and size, and outside of these sizes
// the line of the two nearest goes on for map and votes, while rows of images keep the nearest
// size's; where a table has 0 the line is straight in time. Rows of cells are scaled by the area of
// the grid over that of the table (9 m x 9 m, or 10 m x 10 m), path votes are not: paths are as
// long in any grid.
//
// Table 2 knows cells of 20 cm alone. Elsewhere its times of planes, traversability and path votes
// are assumed to grow as the geometric mean of table 3's machines does; its adding of disparities
// to the grid does not depend on the cells, as table 3's XYZ map does not.
//
// Stereo of tables 2 and 3 is of the images that they name, whatever `stereo_width_px` > 0. That of
// the other computers goes with it: in software as its cube, pixels times disparities, eightfold a
// level of a pyramid (Goldberg 2002 section 2), and the Sparc 10's pyramid on top does not; in
// gates on a straight line in the logarithms through the printed widths and on beyond them: between
// them pixels alone, within 5 % (all disparities at once). Where a range is printed it is the
// middle.
//
// The other computers' start-up and navigation are not published. MER's RAD6000 and the one beside
// the FPGA have those of table 3's, MSL's the same by instructions a second, and the Sparc 10 those
// of table 3's Sparc of 300 MHz, which are a lower bound. The PowerPCs of section 6 take a tenth
// and a hundredth of what MER's takes, in everything.
//
// Athena of 2012 has stereo in a Virtex 4, whose times are taken to be those of the Virtex 5 (times
// virtex_4_time_factor), and map and votes of table 3's Pentium III by clock, 500 over 1600 MHz.
// The Pentium M of 1.6 GHz moves the rover (Howard 2012 figure 5); navigation runs beside the
// gates, on a processor that is called "Pentium-class" and no more, and is taken to be as fast.
//
// Of the core of 2026 stereo is on lines through the widths of compute_tables.h, a cycle of the
// map goes with the cells, and start-up is not timed.
ComputeTimes MakeComputeTimes(const ComputeParams& params, const GridSize& grid,
                              double stereo_width_px = kStereoWidth_px);

// What a pair of images of visual odometry takes, s.
struct VisualTime {
  double imaging_s = 0.0;
  double computing_s = 0.0;  // features, matches, selection and motion
};

// With computer none nothing takes time. Published are MER's 160 s, MSL's 8.8 s by instructions a
// second, and the FPGA's 16 ms for features and matches of images 512 px wide (Howard 2012 section
// 3, table 3), to which visual_cpu_s is added for the rest. Athena of 2012 has the same with
// virtex_4_time_factor on the 16 ms, the PowerPCs a tenth and a hundredth of MER's, the core of
// 2026 what was measured. The others are assumed to take what MER's takes times their stereo of
// section 5 (Goldberg 2002) over that of the RAD6000 there. Width and number of features do not
// matter: none are published.
VisualTime VisualTimeOf(const ComputeParams& params);

// How long a look at the terrain takes, by what the rover does meanwhile.

struct LookTime {
  double scanning_s = 0.0;
  double imaging_s = 0.0;
  double computing_s = 0.0;

  double total_s() const { return scanning_s + imaging_s + computing_s; }
};

// Of one look:
//   light stripe: clock.scan_time_s and its parts; with a map, navigation on top;
//   stereo: acquisition, stereo, and navigation or the judgement of elevations.
// Times of stereo and navigation are those of clock.compute (compute_profile.h).
LookTime MakeLookTime(const DriveParams& drive);

// Of the computer before the first look, s.
double StartUpTime(const DriveParams& drive);

// The published scan: five lasers, two at a time.
inline constexpr int kPublishedLaserGroups = 3;

// T = fixed + (published - fixed) groups / 3 / speed factor: images on and off for each group of
// lasers have to be taken, clocked out and averaged. 20 s for the published sensor (Matthies 1995,
// section 6); how it divides is an assumption (clock.scan_fixed_s).
inline double ScanTime(const ClockParams& clock, const sensing::LightStripeParams& sensor) {
  const double share = static_cast<double>(sensing::LaserGroups(sensor)) / kPublishedLaserGroups;
  return clock.scan_fixed_s +
         (clock.scan_time_s - clock.scan_fixed_s) * share / clock.scan_speed_factor;
}

}  // namespace rockyard::trial
