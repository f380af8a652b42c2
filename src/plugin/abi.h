/// @file
/// The C interface between the rockyard command and the shared library of a plugin. Plain structs
/// and functions, so that a plugin built by another compiler or against another standard library
/// works. navigator_plugin.h, estimator_plugin.h and reader_plugin.h are layers above it in C++;
/// write to this file directly only from another language.
///
/// A library exports one function, rockyard_plugin(). Texts are UTF-8 and end with 0. Units are SI
/// and radians; frames are those of messages/estimates.h. A pointer that is handed over is valid
/// during the call alone, unless it says otherwise. No function may let an exception out.
///
/// Must stay, for plugins that are built: the order and types of all members. Another layout has
/// another ROCKYARD_PLUGIN_ABI, and the command refuses plugins of other versions. Version 1 is
/// that of rockyard 0.1.0 and may change until its release: build plugins with the headers at hand.
#ifndef ROCKYARD_PLUGIN_ABI_H
#define ROCKYARD_PLUGIN_ABI_H

/// C has its own names and headers.
/// NOLINTBEGIN(readability-identifier-naming, modernize-deprecated-headers, modernize-use-using)
#include <stddef.h>
#include <stdint.h>

/// The version of this interface.
#define ROCKYARD_PLUGIN_ABI 1

#ifdef __cplusplus
extern "C" {
#endif

/// What went wrong in a plugin, for people. Every function that may fail returns 0, or 1 with a
/// text here. A failure ends the drive as a fault of its navigator or estimator.
struct rockyard_error {
  char text[512];
};

/// messages::PoseEstimate.
struct rockyard_pose {
  double x_m, y_m, heading_rad, distance_m;
};

/// A place in the frame in which goals are told, m.
struct rockyard_place {
  double x_m, y_m;
};

/// messages::AttitudeEstimate.
struct rockyard_attitude {
  double roll_rad, pitch_rad, z_m;
};

/// The value of one parameter; which members count follows from its type.
struct rockyard_value {
  double real;              ///< "real"; "angle", in rad
  int64_t integer;          ///< "integer"; "boolean", 0 or 1; "choice", the place of the name
  const char* text;         ///< "text"
  const double* reals;      ///< "reals"
  const int64_t* integers;  ///< "integers"
  size_t count;             ///< of reals or integers
};

/// messages::RoverBelief; wheels in the order of messages::Wheel.
struct rockyard_rover {
  double length_m, width_m, belly_clearance_m, wheel_width_m;
  double max_rocker_rad, max_bogie_rad, max_tilt_rad;
  double wheel_radius_m, max_wheel_speed_m_s, max_steer_rad, steering_offset_rad;
  double wheel_x_m[6], wheel_y_m[6], radius_ratio[6];
  int32_t steered[6];  ///< 0 or 1
};

/// messages::SiteMap; lists are null where the map has none.
struct rockyard_site_map {
  double x0_m, y0_m, step_m;
  int32_t nx, ny;
  const double* height_m;
  double height_sd_m;
  const double* rock_share;
};

/// navigation::NavigatorSetup.
struct rockyard_setup {
  struct rockyard_place goal;
  const struct rockyard_place* places;  ///< in the order of driving; the first is the goal
  size_t place_count;
  int32_t judges_hazards;
  double full_speed_m_s, control_period_s, operations_per_s;
  uint64_t random_seed;
  struct rockyard_rover rover;
  const struct rockyard_site_map* site_map;  ///< null: none
};

/// messages::HazardReport.
struct rockyard_report {
  int64_t scan_number;
  size_t stripes;
  const uint8_t* hazard;  ///< of each stripe, left to right, 0 or 1
};

/// messages::PointCloud.
struct rockyard_cloud {
  int64_t number;
  int32_t behind;  ///< 0: looked ahead
  size_t count;
  const double* points_R;  ///< x, y, z of each point, m
};

/// messages::LookMoment.
struct rockyard_look {
  int64_t number;
  double time_s;
  struct rockyard_pose estimate, odometry;
  struct rockyard_attitude attitude;
};

/// messages::VehicleHazard, kinds and sides by their places in the enumerations.
struct rockyard_hazard {
  int32_t kind, side;
};

/// messages::VehicleState; a list is null where the rover has no such sensor.
struct rockyard_felt {
  const double* articulation_rad;  ///< left and right rocker, left and right bogie
  const double* specific_force_R;  ///< x, y, z, m/s2
  const double* motor_current_A;   ///< of six wheels
  const uint8_t* contact;          ///< of seven strips, 0 or 1
};

/// messages::LookImage.
struct rockyard_image {
  int32_t width, height;
  const uint8_t* grey;                    ///< width times height, row by row from the upper left
  double C_R[3], A_R[3], H_R[3], V_R[3];  ///< messages::LinearCamera; C in m, the others in pixels
};

/// messages::LookImages.
struct rockyard_images {
  int64_t number;
  int32_t behind;  ///< 0: looked ahead
  struct rockyard_image left, right;
};

/// navigation::NavigatorInput.
struct rockyard_input {
  double time_s;
  uint32_t events;  ///< bits of navigation::Event
  struct rockyard_pose estimate, odometry;
  struct rockyard_attitude attitude;
  const struct rockyard_report* report;  ///< null: none, as the next four
  const struct rockyard_cloud* cloud;
  const struct rockyard_look* look;
  const struct rockyard_hazard* hazard;
  const struct rockyard_felt* felt;
  int32_t touches_behind, notices_stuck;
  const double* covariance;  ///< 6 x 6, in the order of messages::PoseCoordinate; null: none
  const struct rockyard_images* images;  ///< null: none; where the traits ask for them
};

/// navigation::NavigatorDecision. Enumerations by their places.
struct rockyard_decision {
  int32_t status;  ///< navigation::NavigatorStatus
  int32_t look;    ///< 0: none, 1: ahead, 2: behind
  int32_t looks_on_the_move;
  int32_t motion;     ///< messages::MotionKind
  int32_t direction;  ///< +1 or -1
  double curvature_per_m, curvature_rate_per_m2, speed_share, end_m;
  int64_t move;
  double until_period_s, until_distance_m, until_turn_rad, until_near_goal_m;
  double work_ops;
};

/// messages::OverlayLine and messages::OverlayGrid.
struct rockyard_overlay_line {
  const char* name;
  const struct rockyard_place* points;
  size_t count;
};
struct rockyard_overlay_grid {
  const char* name;
  double x0_m, y0_m, step_m;
  int32_t nx, ny;
  const double* values;
};
/// messages::Overlay; valid until the next call of the navigator.
struct rockyard_overlay {
  const struct rockyard_overlay_line* lines;
  size_t line_count;
  const struct rockyard_overlay_grid* grids;
  size_t grid_count;
};

/// How a text is handed to the command: it copies it. `to` is what the function was given.
typedef void (*rockyard_take_text)(void* to, const char* text, size_t bytes);

/// Parameters, in the order in which describe() lists them.
struct rockyard_values {
  const struct rockyard_value* values;
  size_t count;
};

/// One kind of navigator. Functions may be called from several threads at once, for different
/// navigators; all calls for one navigator come from one thread after the other, in order of time.
struct rockyard_navigator_type {
  /// Hands over the description as JSON (docs/navigators.md, "describe").
  int (*describe)(rockyard_take_text take, void* to, struct rockyard_error* error);
  /// Hands over what a trial has to know with these parameters, as JSON ("traits").
  int (*traits)(const struct rockyard_values* values, rockyard_take_text take, void* to,
                struct rockyard_error* error);
  /// Makes the navigator of one drive; `setup` is valid during the call.
  int (*create)(const struct rockyard_values* values, const struct rockyard_setup* setup,
                void** navigator, struct rockyard_error* error);
  int (*decide)(void* navigator, const struct rockyard_input* input,
                struct rockyard_decision* decision, struct rockyard_error* error);
  /// Operators moved the rover (`corrected` 0), or a measurement corrected its estimate (1).
  int (*on_jump)(void* navigator, int corrected, const struct rockyard_pose* before,
                 const struct rockyard_pose* after, struct rockyard_error* error);
  /// The goal is another one: the next (`moved` 0), or the same, seen elsewhere (1).
  int (*set_goal)(void* navigator, const struct rockyard_place* goal, int moved,
                  struct rockyard_error* error);
  /// Copies its own values; `count` is the declared number.
  int (*own_values)(void* navigator, double* values, size_t count, struct rockyard_error* error);
  /// Sets `overlay` to what it shows, or leaves it empty.
  int (*overlay)(void* navigator, struct rockyard_overlay* overlay, struct rockyard_error* error);
  void (*destroy)(void* navigator);
};

/// messages::MotionMeasurement; wheels in the order of messages::Wheel.
struct rockyard_motion {
  double duration_s;
  double wheel_turn_rad[6], steer_rad[6];
  double turn_rad;
};

/// messages::PoseUpdate.
struct rockyard_update {
  double x_m, y_m, heading_rad;
  int32_t mirrored;
};

/// messages::PoseFix. Coordinates in the order of messages::PoseCoordinate; covariances are
/// symmetric.
struct rockyard_fix {
  int64_t capture;
  int32_t measured[6];  ///< 0 or 1
  double pose[6];
  double covariance[36];
  int32_t in_lander_frame;
};

/// messages::RelativeMotion.
struct rockyard_relative_motion {
  int64_t from, to;
  double motion_F[6];
  double covariance[36];
};

/// messages::LocalizationEstimate.
struct rockyard_estimate {
  struct rockyard_pose pose;
  struct rockyard_attitude attitude;
  struct rockyard_pose odometry;
  int32_t has_covariance, has_world;  ///< 0: what follows of them counts for nothing
  double covariance[36];
  struct rockyard_pose world;
  double world_covariance[36];
};

/// localization::EstimatorMemory; the covariance is 10 x 10, in the order of
/// localization/error_state.h.
struct rockyard_memory {
  double x_m, y_m, heading_rad;
  double gyro_scale, wheel_scale, pan_rad;
  int32_t has_covariance;
  double covariance[100];
};

/// localization::LanderFrame.
struct rockyard_lander {
  double x_m, y_m, pan_sd_rad;
};

/// localization::EstimatorSetup; enumerations by their places.
struct rockyard_estimator_setup {
  double wheel_radius_m, max_wheel_speed_m_s, max_steer_rad, steering_offset_rad;
  double wheel_x_m[6], wheel_y_m[6], radius_ratio[6];
  int32_t steered[6];               ///< 0 or 1
  double distance_scale;            ///< DeadReckoningParams
  int32_t wheels, step_heading;     ///< OdometryWheels, StepHeading
  int32_t attitude_source, height;  ///< AttitudeSource, HeightSource
  double attitude_filter_s;         ///< AttitudeParams
  double start_x_m, start_y_m, start_heading_rad;
  const struct rockyard_lander* lander;  ///< null: goals are told in the world frame
  const struct rockyard_memory* memory;  ///< null: operators put the rover down
};

/// One kind of estimator, called as navigators are. estimate() follows each of the functions that
/// may change what is believed.
struct rockyard_estimator_type {
  /// Hands over the description as JSON (docs/estimators.md).
  int (*describe)(rockyard_take_text take, void* to, struct rockyard_error* error);
  /// Hands over what is wrong with these parameters, as JSON.
  int (*check)(const struct rockyard_values* values, rockyard_take_text take, void* to,
               struct rockyard_error* error);
  /// Makes the estimator of one drive; `setup` is valid during the call.
  int (*create)(const struct rockyard_values* values, const struct rockyard_estimator_setup* setup,
                void** estimator, struct rockyard_error* error);
  int (*propagate)(void* estimator, const struct rockyard_motion* motion,
                   struct rockyard_error* error);
  int (*feel)(void* estimator, const struct rockyard_felt* felt, double duration_s,
              struct rockyard_error* error);
  int (*place)(void* estimator, const struct rockyard_update* update, struct rockyard_error* error);
  int (*capture)(void* estimator, int64_t capture, struct rockyard_error* error);
  int (*forget)(void* estimator, int64_t capture, struct rockyard_error* error);
  /// Correct what is believed; `use` is a localization::AidUse by its place.
  int (*fix)(void* estimator, const struct rockyard_fix* fix, int32_t* use,
             struct rockyard_error* error);
  int (*motion)(void* estimator, const struct rockyard_relative_motion* motion, int32_t* use,
                struct rockyard_error* error);
  int (*estimate)(void* estimator, struct rockyard_estimate* estimate,
                  struct rockyard_error* error);
  int (*remember)(void* estimator, struct rockyard_memory* memory, struct rockyard_error* error);
  /// Copies its own values; `count` is the declared number.
  int (*own_values)(void* estimator, double* values, size_t count, struct rockyard_error* error);
  void (*destroy)(void* estimator);
};

/// perception::PointReaderSetup.
struct rockyard_reader_setup {
  struct rockyard_rover rover;
  double max_range_m;
};

/// One kind of reader of images (perception::PointReader), called as navigators are.
struct rockyard_reader_type {
  /// Hands over the description as JSON (docs/navigators.md): name, doc, parameters.
  int (*describe)(rockyard_take_text take, void* to, struct rockyard_error* error);
  /// Hands over what is wrong with these parameters, as JSON.
  int (*check)(const struct rockyard_values* values, rockyard_take_text take, void* to,
               struct rockyard_error* error);
  /// Makes the reader of one drive; `setup` is valid during the call.
  int (*create)(const struct rockyard_values* values, const struct rockyard_reader_setup* setup,
                void** reader, struct rockyard_error* error);
  /// Sets `points_R` to x, y, z of each point, m, and `count` to how many points there are. The
  /// list is valid until the next call of the reader.
  int (*points)(void* reader, const struct rockyard_images* images, const double** points_R,
                size_t* count, struct rockyard_error* error);
  void (*destroy)(void* reader);
};

/// What a library holds; a list may be null where its count is 0.
struct rockyard_plugin_info {
  uint32_t abi;       ///< ROCKYARD_PLUGIN_ABI of the header that it was built with
  uint32_t reserved;  ///< 0
  const struct rockyard_navigator_type* const* navigators;
  size_t navigator_count;
  const struct rockyard_estimator_type* const* estimators;
  size_t estimator_count;
  const struct rockyard_reader_type* const* readers;
  size_t reader_count;
};

/// The one function that a library exports. What it returns is valid while the library is loaded.
typedef const struct rockyard_plugin_info* (*rockyard_plugin_function)(void);
#define ROCKYARD_PLUGIN_FUNCTION "rockyard_plugin"

#ifdef __cplusplus
}
#endif

/// NOLINTEND(readability-identifier-naming, modernize-deprecated-headers, modernize-use-using)
#endif
