#include "trial/energy_params.h"

namespace rockyard::trial {
namespace {

using core::Origin;

// Of table 1 but the motors.
void VisitInstruments(EnergyParams& p, core::FieldVisitor& v) {
  v.Real("cpu_W", p.cpu_W,
         {.doc = "computer and I/O",
          .min = 0.0,
          .max = 1e4,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 table 1 (MFEX)"});
  v.Real("gyro_W", p.gyro_W,
         {.doc = "turn rate sensor",
          .min = 0.0,
          .max = 1e4,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 table 1 (MFEX)"});
  v.Real("accelerometers_W", p.accelerometers_W,
         {.doc = "accelerometers, while the rover moves and where it has them",
          .min = 0.0,
          .max = 1e4,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 table 1 (MFEX)"});
  v.Real("imaging_W", p.imaging_W,
         {.doc = "CCDs and clocks, during a scan",
          .min = 0.0,
          .max = 1e4,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 table 1 (MFEX)"});
}

// What a look takes, by which instruments it has.
void VisitLooks(EnergyParams& p, core::FieldVisitor& v) {
  v.Real("cmos_imaging_share", p.cmos_imaging_share,
         {.doc = "power of CMOS imagers over that of CCDs",
          .min = 0.0,
          .max = 10.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 6: potentially a factor of ten for imaging alone"});
  v.Real("laser_supply_efficiency", p.laser_supply_efficiency,
         {.doc = "electrical power of the lasers over what their voltage conversion draws",
          .min = 0.01,
          .max = 1.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 table 3 and sec. 6: 0.66 W each, 2.01 W for two with losses"});
  v.Real("stereo_imaging_W", p.stereo_imaging_W,
         {.doc = "a pair of stereo cameras while they take images",
          .min = 0.0,
          .max = 1e4,
          .origin = Origin::kAssumed,
          .source = "as the two CCDs of the light stripe sensor (Matthies 1995 table 1)",
          .study_low = 0.5,
          .study_high = 10.0});
  v.Real("computing_W", p.computing_W,
         {.doc = "drawn beyond cpu_W while the rover computes stereo, map and votes",
          .min = 0.0,
          .max = 1e4,
          .origin = Origin::kAssumed,
          .source = "a computer that draws the same idle and busy; that of the Athena SDM is not "
                    "published",
          .study_low = 0.0,
          .study_high = 10.0});
}

void VisitMotors(EnergyParams& p, core::FieldVisitor& v) {
  v.Real("driving_W", p.driving_W,
         {.doc = "drive motors in extreme terrain; drawn by every motion and by a stall",
          .min = 0.01,
          .max = 1e4,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 table 1 (MFEX, -40 C, extreme terrain)"});
  v.Real("steering_W", p.steering_W,
         {.doc = "steering motors",
          .min = 0.0,
          .max = 1e4,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 table 1 (MFEX, -40 C, extreme terrain)"});
}

}  // namespace

void EnergyParams::Visit(core::FieldVisitor& v) {
  VisitInstruments(*this, v);
  VisitLooks(*this, v);
  VisitMotors(*this, v);
  v.Real("battery_wh", battery_wh,
         {.doc = "energy in the batteries at the start; 0: they are never empty",
          .min = 0.0,
          .max = 1e5,
          .origin = Origin::kSetting,
          .source = "whether batteries end runs; by default ten times what a nominal run draws, as "
                    "the capacity of Rocky 3.2 is not published"});
}

}  // namespace rockyard::trial
