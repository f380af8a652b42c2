// The computer of the simulated clock: whose times of imaging, stereo and navigation a look takes
// (clock/compute_profile.h).
#pragma once

#include <array>
#include <string_view>

#include "core/fields.h"

namespace rockyard::trial {

// Computers whose times stand in clock/compute_tables.h: the four of Goldberg 2002, section 5 (one
// of table 2, three of table 3), and others whose stereo goes with the width of the images. Must
// stay: the names in scenarios (EnumNames<Computer>) have this order.
enum class Computer {
  kNone,        // images, stereo and navigation take no time
  kR3000,       // 12 MHz, on board of the Athena SDM (table 2)
  kPentium3,    // 500 MHz workstation (table 3)
  kSparc,       // 300 MHz workstation (table 3)
  kRad6000,     // 20 MHz, a desktop cage (table 3)
  kMer,         // RAD6000 of 20 MHz as flown by MER (Howard 2012 table 2)
  kMsl,         // RAD750 of 200 MHz of MSL, by instructions a second (Howard 2012 section 3)
  kFpga,        // Virtex 5 for stereo beside the RAD6000 (Howard 2012 table 2)
  kSparc10,     // workstation (Matthies 1995 section 8)
  kPowerPc750,  // 133 MHz, radiation hardened, ten times as fast as MER's (Goldberg 2002 sec. 6)
  kPowerPcG4,   // 500 MHz, commercial, ten times as fast as kPowerPc750 (Goldberg 2002 sec. 6)
  kAthena2012,  // Virtex 4 and a processor like the Pentium M (Howard 2012 section 3)
  kSapphireRapids,  // one core of 2026, by the benchmarks of rockyard's own stages
};

// Time of a pair of images where a scenario leaves acquisition_s open and the cameras feed gates or
// a processor of today, s; the help of acquisition_s states it. Howard 2012 section 3 has poses at
// some 5 Hz on the drive and 10 Hz at most; 10 Hz is assumed, and 5 to 15 Hz are the range of
// studies.
inline constexpr double kFastCameras_s = 0.1;

// The computer, and what it takes.
struct ComputeParams {
  Computer computer = Computer::kNone;
  double acquisition_s = 8.974;
  double stereo_time_factor = 1.0;
  double navigation_time_factor = 1.0;
  double virtex_4_time_factor = 1.0;
  double behaviour_s = 0.0;
  double move_overhead_s = 0.0;
  double visual_cpu_s = 0.084;
  double visual_time_factor = 1.0;
  double operations_per_s = 0.0;

  // Returns acquisition_s where a scenario leaves it open.
  double SuitedAcquisition_s() const {
    const bool fast = computer == Computer::kFpga || computer == Computer::kAthena2012 ||
                      computer == Computer::kSapphireRapids;
    return fast ? kFastCameras_s : acquisition_s;
  }

  void Visit(core::FieldVisitor& v) {
    v.Choice("computer", computer,
             core::Setting("whose times of stereo, map and votes a look takes; the time of light "
                           "stripe scans is clock.scan_time_s, whichever computer"));
    v.Real("acquisition_s", acquisition_s,
           core::Assumed("time to take a pair of stereo images; r3000_12mhz has its own in table "
                         "2, the tables of the others have no such row. Left open it is 0.1 s (10 "
                         "Hz) with virtex_5_fpga, athena_2012 and sapphire_rapids_core",
                         "as on the Athena SDM (Goldberg 2002 table 2, six rows): the grab of the "
                         "images takes most of it",
                         {0.0, 3600.0}, {0.5, 10.0}));
    v.Real("stereo_time_factor", stereo_time_factor,
           core::Assumed("time of stereo over that of the computer's profile",
                         "the middle of what is published: the 24 to 30 s of MER, and with them "
                         "MSL's 1.32 to 1.65 s (Howard 2012 section 3), are 0.89 to 1.11 of it",
                         {0.0, 100.0}, {0.89, 1.11}));
    v.Real("navigation_time_factor", navigation_time_factor,
           core::Assumed(
               "time of map and votes over that of the computer's profile",
               "profiles that go by clock, by instructions a second or by orders of magnitude are "
               "known to a factor of three (Goldberg 2002 section 6, Howard 2012 section 3)",
               {0.0, 100.0}, {0.316, 3.16}));
    v.Real("virtex_4_time_factor", virtex_4_time_factor,
           core::Assumed("with athena_2012, time of stereo, features and matches in its Virtex 4 "
                         "over that in the Virtex 5",
                         "Howard 2012 drove with a Virtex 4 and times a Virtex 5 (sec. 3); the "
                         "design is the same, the clock is not told",
                         {0.0, 100.0}, {1.0, 2.0}));
    v.Real(
        "behaviour_s", behaviour_s,
        core::Assumed(
            "time in which the behaviour controller judges the elevations of a stereo look, beyond "
            "stereo's own; not spent with computer none",
            "some tens of numbers against two thresholds, where table 2's shortest rows take 13 ms",
            {0.0, 3600.0}, {0.0, 1.0}));
    v.Real("move_overhead_s", move_overhead_s,
           core::Calibrated(
               "time at rest that every move takes beyond the motion of its wheels, whichever "
               "computer and navigator: command, brakes, settling; at the power of computing",
               "0 for a rover that moves on at once; 7.4 s for the Athena SDM: 15 s a move "
               "(Goldberg 2002 table 2) less the 7.62 s that the simulated rover's wheels turn for "
               "35 cm of level sand",
               {0.0, 3600.0}));
    v.Real("visual_cpu_s", visual_cpu_s,
           core::Assumed("with virtex_5_fpga and athena_2012, the computer's part of a step of "
                         "visual odometry: selection and motion",
                         "some 10 Hz on a Pentium-class computer (Howard 2012 sec. 3), 0.1 s, less "
                         "the 16 ms of the FPGA; a RAD6000 beside it is much slower",
                         {0.0, 3600.0}, {0.05, 10.0}));
    v.Real("visual_time_factor", visual_time_factor,
           core::Assumed(
               "time of a step of visual odometry over that of the computer's profile",
               "two to three minutes on MER (Howard 2012 sec. 1) are 0.75 to 1.125 of its 160 s",
               {0.0, 100.0}, {0.75, 1.125}));
    v.Real("operations_per_s", operations_per_s,
           core::Setting("operations a second for navigators that state the work of a decision "
                         "(plugins and processes): the rover rests, or computes beside the drive, "
                         "for work / operations_per_s; 0: that work takes no time. MER's RAD6000 "
                         "has some 2.2e7 instructions a second, MSL's RAD750 4e8",
                         {0.0, 1e15}));
  }
};

}  // namespace rockyard::trial

template <>
struct rockyard::core::EnumNames<rockyard::trial::Computer> {
  static constexpr std::array<std::string_view, 13> kNames{"none",
                                                           "r3000_12mhz",
                                                           "pentium_3_500mhz",
                                                           "sparc_300mhz",
                                                           "rad6000_20mhz",
                                                           "mer_rad6000",
                                                           "msl_rad750",
                                                           "virtex_5_fpga",
                                                           "sparc_10",
                                                           "powerpc_750_133mhz",
                                                           "powerpc_g4_500mhz",
                                                           "athena_2012",
                                                           "sapphire_rapids_core"};
};
