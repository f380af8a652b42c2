// Everything that one drive needs to know: the parameters of every module below, and trial's own.
// Scenarios hold one of these; every experiment, and all parts of a drive, take their parameters
// from it. Meanings and sources of trial's own stand in the .cc. Records depend on a default in
// every scenario that leaves its parameter out. Fingerprints depend on every value and on the order
// of the groups.
#pragma once

#include "core/fields.h"
#include "localization/dead_reckoning_params.h"
#include "localization/estimator_set_params.h"
#include "navigation/navigator_set_params.h"
#include "navigation/reaction_params.h"
#include "navigation/wheel_driver_params.h"
#include "perception/calibration_params.h"
#include "perception/eyes_params.h"
#include "perception/hazard_params.h"
#include "perception/point_reader_set_params.h"
#include "perception/stripe_finder_params.h"
#include "perception/stuck_detector_params.h"
#include "rendering/picture/picture_params.h"
#include "rendering/sun_params.h"
#include "rover/rover_params.h"
#include "sensing/aid_params.h"
#include "sensing/light_stripe_params.h"
#include "sensing/motion_sensor_params.h"
#include "sensing/stereo_params.h"
#include "sensing/tracker_params.h"
#include "sensing/vehicle_sensor_params.h"
#include "sensing/visual_motion_params.h"
#include "terrain/terrain_params.h"
#include "trial/clock/clock_params.h"
#include "trial/course/course_params.h"
#include "trial/eyes/terrain_sensor_set_params.h"
#include "trial/referee/referee_params.h"

namespace rockyard::trial {

// Returns the estimators that scenarios can name, the one list of them (drive/make_estimator.cc).
// The first one, dead_reckoning, is the estimator of scenarios that name none.
localization::EstimatorSet StandardEstimators();

// Electrical power by activity, and the batteries.
struct EnergyParams {
  double cpu_W = 3.77;
  double gyro_W = 0.80;
  double accelerometers_W = 0.82;
  double imaging_W = 0.75;
  double cmos_imaging_share = 0.1;
  double laser_supply_efficiency = 1.32 / 2.01;
  double stereo_imaging_W = 0.75;
  double computing_W = 0.0;
  double driving_W = 8.28;
  double steering_W = 6.70;
  double battery_wh = 50.0;

  void Visit(core::FieldVisitor& v);
};

// What the rover measures.
struct SensorParams {
  TerrainSensorSet terrain_sensors = StandardTerrainSensors();
  sensing::LightStripeParams light_stripe;
  sensing::StereoParams stereo;
  rendering::SunParams sun;
  rendering::LookParams look;
  sensing::GyroParams gyro;
  sensing::EncoderParams encoders;
  sensing::TrackerParams tracker;
  sensing::VehicleSensorParams vehicle;
  sensing::AidParams aids;
  sensing::VisualMotionParams visual_odometry;

  void Visit(core::FieldVisitor& v);
};

// What the rover makes of its measurements.
struct PerceptionParams {
  perception::StripeFinderParams stripe_finder;
  perception::StereoMatchingParams stereo;
  perception::HazardParams hazard;
  perception::VehicleHazardParams vehicle_hazard;
  perception::StuckDetectorParams stuck_detector;
  localization::DeadReckoningParams dead_reckoning;
  perception::CalibrationErrorParams calibration;
  localization::AttitudeParams attitude;
  perception::CloudElevationParams cloud_elevations;
  perception::VisualMotionParams visual_odometry;
  perception::PointReaderSet readers;

  void Visit(core::FieldVisitor& v);
};

// Where the rover believes to be: the estimator. What all estimators build on stands in
// PerceptionParams: dead_reckoning and attitude.
struct LocalizationParams {
  localization::EstimatorSet estimators = StandardEstimators();

  void Visit(core::FieldVisitor& v) { estimators.Visit(v); }
};

// What the rover decides.
struct NavigationParams {
  navigation::NavigatorSet navigators = navigation::StandardNavigators();
  navigation::StuckReactionParams on_board_stuck;
  navigation::SlipReactionParams on_slip;
  navigation::WheelDriverParams wheel_driver;
  navigation::LimitParams limits;

  void Visit(core::FieldVisitor& v);
};

// The whole of one drive.
struct DriveParams {
  terrain::TerrainParams terrain;
  rover::RoverParams rover;
  SensorParams sensors;
  PerceptionParams perception;
  LocalizationParams localization;
  NavigationParams navigation;
  CourseParams course;
  RefereeParams referee;
  ClockParams clock;
  EnergyParams energy;

  // Lists the groups in the group that is being visited: a drive has no name of its own in a file.
  // drive_checks_params.h requires what must hold across groups, more or less of it by what the
  // experiment does with the drive.
  void Visit(core::FieldVisitor& v);

  // Returns whether a plugin or a process decides, estimates or reads images, which the program
  // does not answer for.
  bool foreign() const {
    return navigation.navigators.chosen().foreign() || localization.estimators.chosen().foreign() ||
           perception.readers.chosen().foreign();
  }
};

// Returns whether the images of a look are all that the navigator gets of it, so that nobody
// matches them.
inline bool ReadsImagesAlone(const DriveParams& drive) {
  const navigation::NavigatorTraits traits = drive.navigation.navigators.chosen().traits();
  return traits.images && traits.reads == navigation::LookReading::kNothing;
}

}  // namespace rockyard::trial
