// All that is known of one recorded drive, and its JSON text for the replay page. `campaign` fills
// it; the command `replay` and pages of reports write it, and trace files (trace_npz.h,
// trace_mcap.h) hold parts of it. No record, hash or store depends on it, but pages and traces do.
// SI units; W is the world, R the rover. A moment is the rover at one time of its motion; a scan is
// what the light stripe takes, a step one decision of a map-based navigator, a look what stereo
// cameras take.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/provenance.h"
#include "math/pose.h"
#include "messages/estimates.h"
#include "messages/navigation_view.h"
#include "truth/record.h"
#include "truth/trace.h"

namespace rockyard::replay {

// A vertical plane that bounds the arena: the points p with normal_W . p = offset_m. The normal
// points out of the arena.
struct ReplayWall {
  math::Vector3 normal_W = math::Vector3::UnitY();
  double offset_m = 0.0;
};

// Where the drive leads.
struct ReplayCourse {
  math::Pose2 start;
  messages::Goal goal;
  double goal_radius_m = 0.0;
  messages::Goal told_goal;               // as operators designated it
  std::vector<messages::Goal> waypoints;  // true, in the order of driving
  double x_min_m = 0.0;                   // bounds of the area that holds terrain
  double x_max_m = 0.0;
  double y_min_m = 0.0;
  double y_max_m = 0.0;
  std::vector<ReplayWall> walls;
  // y of the lines at which operators reflect the rover (Matthies 1995 sec. 7); empty where they do
  // not.
  std::vector<double> mirror_lines_m;
};

// Where the drive takes place.
struct ReplayWorld {
  double gravity_m_s2 = 0.0;
  double sun_elevation_rad = 0.0;  // above the horizon (sensors.sun)
  double sun_azimuth_rad = 0.0;    // towards the sun, from x to the left
  std::string arena;               // its kind, as a scenario names it
  double x_min_m = 0.0;            // of the arena itself, without margins
  double x_max_m = 0.0;
  double y_min_m = 0.0;
  double y_max_m = 0.0;
  double mirror_line_m = 0.0;  // of virtual arenas: the layout is mirrored at y = +- this
};

// Heights of the ground without rocks on a grid, row-major, x fastest.
struct ReplayGround {
  double x0_m = 0.0;
  double y0_m = 0.0;
  double step_m = 0.1;
  std::size_t nx = 0;
  std::size_t ny = 0;
  std::vector<double> z_m;
};

// Where a rock lies at the start, and its shape (terrain/rock.h).
struct ReplayRock {
  math::Vector3 center_W = math::Vector3::Zero();
  math::Vector3 semi_axes_m = math::Vector3::Ones();
  double yaw_rad = 0.0;
  double height_m = 0.0;    // of its top above the ground
  double cap_growth = 0.0;  // as in terrain/rock.h
};

// Must agree: this order and that of the names in ShapeText (data_json.cc).
enum class ShapeKind { kBox, kWheel, kCapsule, kSphere };

// A shape of a link, in the frame of the link.
struct ReplayShape {
  ShapeKind kind = ShapeKind::kBox;
  std::string part;                           // "belly", "rocker", "hub", "panel", "wheel"
  math::Vector3 a_m = math::Vector3::Zero();  // centre; of a capsule one end
  math::Vector3 b_m = math::Vector3::Zero();  // size of a box; of a capsule the other end
  double radius_m = 0.0;
  double width_m = 0.0;  // of a wheel, along y
};

// A link of the rover, which turns about `axis` through `pivot_P`, both in the frame of its parent.
// Link 0 is the chassis, which has no parent and whose frame is R; link i turns by
// ReplayPose::joint_rad[i - 1].
struct ReplayLink {
  std::string name;
  int parent = -1;
  math::Vector3 pivot_P = math::Vector3::Zero();
  math::Vector3 axis = math::Vector3::UnitY();
  std::vector<ReplayShape> shapes;
};

// The light plane of one emitter, in R: the directions normal to normal_R within half_fan_rad of
// axis_R.
struct ReplayLaser {
  math::Vector3 emitter_R = math::Vector3::Zero();
  math::Vector3 normal_R = math::Vector3::UnitY();
  math::Vector3 axis_R = math::Vector3::UnitX();
  double half_fan_rad = 0.0;
};

// What one camera sees, in R: unit rays once around the edge of its image.
struct ReplayCamera {
  std::string name;
  math::Vector3 eye_R = math::Vector3::Zero();
  std::vector<math::Vector3> rim_R;
};

// The terrain sensor that the drive goes by.
struct ReplaySensor {
  std::string name;      // as a scenario names it: "light_stripe"
  double reach_m = 0.0;  // farthest range that it gives
  std::vector<ReplayLaser> lasers;
  std::vector<ReplayCamera> cameras;
};

// One moment of the motion.
struct ReplayPose {
  truth::TraceSample sample;
  std::vector<double> joint_rad;  // of each link but the chassis
  bool set_back = false;          // operators set the rover back: the path breaks before
};

// A point that the light stripe gave.
struct StripePoint {
  math::Vector3 p_W = math::Vector3::Zero();  // through the true pose
  std::size_t stripe = 0;
  double height_m = 0.0;  // as the rover believes
};

// A scan of the light stripe.
struct ReplayScan {
  double time_s = 0.0;
  math::Pose2 pose;  // true
  std::vector<StripePoint> points;
  messages::PerStripe<bool> hazards;  // of this scan alone
};

// A decision of a map-based navigator.
struct ReplayStep {
  double time_s = 0.0;
  double look_time_s = 0.0;   // when its points were taken, at most time_s
  math::Pose2 pose;           // true, at look_time_s
  math::Pose2 look_believed;  // as the rover believed at look_time_s
  messages::NavigationView view;
  std::vector<math::Vector3> points_W;  // through the true pose
};

// A look of stereo cameras that has images.
struct ReplayLook {
  double time_s = 0.0;
  std::int64_t number = 0;  // counts every look of the trial from 0
  bool behind = false;
  std::int64_t points = 0;          // how many it handed on
  double least_disparity_px = 0.0;  // violet in disparity_png
  double most_disparity_px = 0.0;   // yellow in it
  // Pictures of one size, PNG files in base64: the left image, and its disparities in colours.
  std::string left_png;
  std::string disparity_png;
};

// What the navigator shows from a moment on, until the next one of these.
struct ReplayOverlay {
  double time_s = 0.0;
  math::Pose2 pose;         // true, at time_s
  math::Pose2 believed;     // as the rover believed at time_s
  messages::Overlay shown;  // in the believed world; empty where it shows nothing any more
};

// One drive as its page shows it.
struct ReplayData {
  std::string title;
  std::string scenario;
  std::string cell;
  std::uint64_t seed = 1;
  std::optional<bool> repeats_stored;  // whether `record` is the stored one; absent: none is stored
  std::string record_hash;
  std::string command;  // that replays the trial
  core::Provenance provenance;
  truth::RecordSchema schema;
  truth::Record record;
  ReplayCourse course;
  ReplayWorld world;
  ReplayGround ground;
  std::vector<ReplayRock> rocks;
  std::vector<truth::RockMove> rock_moves;
  std::vector<ReplayLink> links;
  ReplaySensor sensor;
  std::vector<ReplayPose> poses;  // every moment, not thinned
  std::vector<ReplayScan> scans;
  std::vector<ReplayStep> steps;
  std::vector<ReplayLook> looks;
  std::vector<ReplayOverlay> overlays;
  std::size_t overlay_every = 1;  // one of so many of those that the drive had is in `overlays`
  std::vector<truth::TraceEvent> events;
};

// The most steps that have heights of the map, range points and all splines. Where there are more
// steps, only every second has them, or every third, ..., so that a page stays small. payload.ts
// names the number, too.
inline constexpr std::size_t kMaxDetailedSteps = 240;

// How many bytes of base64 the pictures of looks may take on a page. Where they would take more,
// only every second look ahead and every second look behind is there, or every third, ...
inline constexpr std::size_t kMaxLookBytes = 1'500'000;

// How many bytes of JSON the overlays of a page may take. Where they would take more, only every
// second one is there, or every third, ...; none where the first alone takes more.
inline constexpr std::size_t kMaxOverlayBytes = 1'500'000;

// Returns the drive as JSON on one line; `beside` is a second drive on the same page. Must agree:
// src/web/replay/payload.ts, by which the page reads it; a member that changes here changes there,
// too. Moments of little change are left out (motion.h),
// and lengths are rounded to 0.1 mm, but the last moment has every digit of its pose.
std::string ReplayJson(const ReplayData& data, const ReplayData* beside = nullptr);

}  // namespace rockyard::replay
