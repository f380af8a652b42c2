#include "trial/drive_params.h"

namespace rockyard::trial {
namespace {

using core::Assumed;
using core::Published;
using core::Setting;

// Visits the power of the instruments of table 1 (Matthies 1995).
void VisitInstruments(EnergyParams& p, core::FieldVisitor& v) {
  v.Real("cpu_W", p.cpu_W,
         Published("computer and I/O", "Matthies 1995 table 1 (MFEX)", {0.0, 1e4}));
  v.Real("gyro_W", p.gyro_W,
         Published("turn rate sensor", "Matthies 1995 table 1 (MFEX)", {0.0, 1e4}));
  v.Real("accelerometers_W", p.accelerometers_W,
         Published("accelerometers, while the rover moves and where it has them",
                   "Matthies 1995 table 1 (MFEX)", {0.0, 1e4}));
  v.Real("imaging_W", p.imaging_W,
         Published("CCDs and clocks, during a scan", "Matthies 1995 table 1 (MFEX)", {0.0, 1e4}));
}

// Visits what a look draws, by the instruments that take it.
void VisitLooks(EnergyParams& p, core::FieldVisitor& v) {
  v.Real("cmos_imaging_share", p.cmos_imaging_share,
         Published("power of CMOS imagers over that of CCDs",
                   "Matthies 1995 sec. 6: potentially a factor of ten for imaging alone",
                   {0.0, 10.0}));
  v.Real("laser_supply_efficiency", p.laser_supply_efficiency,
         Published("electrical power of the lasers over what their voltage conversion draws",
                   "Matthies 1995 table 3 and sec. 6: 0.66 W each, 2.01 W for two with losses",
                   {0.01, 1.0}));
  v.Real("stereo_imaging_W", p.stereo_imaging_W,
         Assumed("a pair of stereo cameras while they take images",
                 "as the two CCDs of the light stripe sensor (Matthies 1995 table 1)", {0.0, 1e4},
                 {0.5, 10.0}));
  v.Real(
      "computing_W", p.computing_W,
      Assumed(
          "drawn beyond cpu_W while the rover computes stereo, map and votes",
          "a computer that draws the same idle and busy; that of the Athena SDM is not published",
          {0.0, 1e4}, {0.0, 10.0}));
}

void VisitMotors(EnergyParams& p, core::FieldVisitor& v) {
  v.Real("driving_W", p.driving_W,
         Published("drive motors in extreme terrain; drawn by every motion and by a stall",
                   "Matthies 1995 table 1 (MFEX, -40 C, extreme terrain)", {0.01, 1e4}));
  v.Real("steering_W", p.steering_W,
         Published("steering motors", "Matthies 1995 table 1 (MFEX, -40 C, extreme terrain)",
                   {0.0, 1e4}));
}

}  // namespace

void EnergyParams::Visit(core::FieldVisitor& v) {
  VisitInstruments(*this, v);
  VisitLooks(*this, v);
  VisitMotors(*this, v);
  v.Real("battery_wh", battery_wh,
         Setting("energy in the batteries at the start; 0: they are never empty", {0.0, 1e5},
                 "whether batteries end runs; by default ten times what a nominal run draws, as "
                 "the capacity of Rocky 3.2 is not published"));
}

void SensorParams::Visit(core::FieldVisitor& v) {
  terrain_sensors.Visit(v);
  v.Group("light_stripe", light_stripe, "light stripe hazard sensor");
  v.Group("stereo", stereo, "stereo cameras ahead and behind");
  v.Group("sun", sun,
          "sunlight on the terrain and how bright it is; the images of a sensor see it");
  v.Group("look", look, "what soil and rocks look like; stereo images see it");
  v.Group("gyro", gyro, "turn rate sensor");
  v.Group("encoders", encoders, "wheel encoders");
  v.Group("tracker", tracker, "overhead tracker that reports the true pose in experiments");
  v.Group("vehicle", vehicle, "what the rover feels of itself: touch, tilt, joints, motors");
  v.Group("aids", aids, "what tells the rover where it is, beside its wheels and gyro");
  v.Group("visual_odometry", visual_odometry, "how the rover moves, as its cameras see it");
}

void PerceptionParams::Visit(core::FieldVisitor& v) {
  v.Group(
      "stripe_finder", stripe_finder,
      "light stripes found in images; where the light stripe sensor is simulated down to images");
  v.Group("stereo", stereo, "matching of stereo images (sensors.stereo.fidelity image)");
  v.Group("hazard", hazard, "hazard criteria and the two-scan rule");
  v.Group("vehicle_hazard", vehicle_hazard, "hazards that the rover feels (sensors.vehicle)");
  v.Group("stuck_detector", stuck_detector,
          "when the rover takes itself for stuck (navigation.on_board_stuck)");
  v.Group("dead_reckoning", dead_reckoning, "pose from wheel encoders and gyro");
  v.Group("calibration", calibration,
          "how wrong the rover is about its own geometry: believed less true");
  v.Group("attitude", attitude, "roll, pitch and height from accelerometers and odometry");
  v.Group("cloud_elevations", cloud_elevations,
          "elevation array that the behaviour controller makes of stereo's points");
  v.Group("visual_odometry", visual_odometry,
          "what the rover makes of motions that it sees (sensors.visual_odometry)");
  readers.Visit(v);
}

void NavigationParams::Visit(core::FieldVisitor& v) {
  navigators.Visit(v);
  v.Group("on_board_stuck", on_board_stuck,
          "what a rover does that notices that it is stuck, whichever its navigator");
  v.Group("on_slip", on_slip, "what a rover does whose check of slip raises an alarm");
  v.Group("wheel_driver", wheel_driver, "from motions to wheel and steering set points");
  v.Group("limits", limits, "what a plugin or the process of a navigator may use");
}

void DriveParams::Visit(core::FieldVisitor& v) {
  v.Group("terrain", terrain, "ground, rocks and arena");
  v.Group("rover", rover, "the vehicle");
  v.Group("sensors", sensors, "what the rover measures");
  v.Group("perception", perception, "what the rover makes of its measurements");
  v.Group("localization", localization, "where the rover believes to be");
  v.Group("navigation", navigation, "what the rover decides");
  v.Group("course", course, "start and goal");
  v.Group("referee", referee, "when a trial is over");
  v.Group("clock", clock, "simulated time");
  v.Group("energy", energy, "electrical power and batteries");
}

}  // namespace rockyard::trial
