// Everything that one drive needs to know: the parameters of every module below, and trial's own.
// A default decides the records of every scenario that leaves it out; each of them, and the order
// of the groups, is part of every fingerprint.
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

// The one list of them (drive/make_estimator.cc). The first one, dead_reckoning, is that of
// scenarios which name none.
localization::EstimatorSet StandardEstimators();

// Electrical power by activity and the batteries.
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

  void Visit(core::FieldVisitor& v);
};

// Which estimator it is; what all of them build on stands in `perception`: dead_reckoning,
// attitude.
struct LocalizationParams {
  localization::EstimatorSet estimators = StandardEstimators();

  void Visit(core::FieldVisitor& v) { estimators.Visit(v); }
};

struct NavigationParams {
  navigation::NavigatorSet navigators = navigation::StandardNavigators();
  navigation::StuckReactionParams on_board_stuck;
  navigation::SlipReactionParams on_slip;
  navigation::WheelDriverParams wheel_driver;

  void Visit(core::FieldVisitor& v);
};

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

  // Lists its groups in the group that is being visited: it has no name of its own in a file. What
  // holds across them is required by drive_checks_params.h, which asks for more or less by what the
  // experiment does with the drive.
  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::trial
