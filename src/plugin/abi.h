/// @file
/// The C interface between the rockyard command and the shared library of a plugin. Plain structs
/// and functions, so that a plugin built by another compiler or against another standard library
/// works. navigator_plugin.h is a layer above it in C++; write to this file directly only from
/// another language.
///
/// A library exports one function, rockyard_plugin(). Texts are UTF-8 and end with 0. Units are SI
/// and radians; frames are those of messages/estimates.h. A pointer that is handed over is valid
/// during the call alone, unless it says otherwise. No function may let an exception out.
///
/// Must stay, for plugins that are built: the order and types of all members. Another layout has
/// another ROCKYARD_PLUGIN_ABI, and the command refuses plugins of other versions.
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
/// text here. A failure ends the drive as a fault of its navigator.
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

/// What a library holds.
struct rockyard_plugin_info {
  uint32_t abi;       ///< ROCKYARD_PLUGIN_ABI of the header that it was built with
  uint32_t reserved;  ///< 0
  const struct rockyard_navigator_type* const* navigators;
  size_t navigator_count;
};

/// The one function that a library exports. What it returns is valid while the library is loaded.
typedef const struct rockyard_plugin_info* (*rockyard_plugin_function)(void);
#define ROCKYARD_PLUGIN_FUNCTION "rockyard_plugin"

#ifdef __cplusplus
}
#endif

/// NOLINTEND(readability-identifier-naming, modernize-deprecated-headers, modernize-use-using)
#endif
