/// @file
/// Whether a rover can stand at a pose, after ACE, the approximate clearance evaluation of Otsu et
/// al. 2020 (J. Field Robotics): without settling it on the ground, from the heights that each of
/// its wheels may stand on follow bounds of what suspension, attitude and belly do. Each bound is
/// taken at its worse end: a false "unsafe" costs a detour, a false "safe" the rover.
///
/// Here, not in the paper: angles by levers between the wheels, as if all pivots were at axle
/// height, since navigators are told the places of wheels and not of pivots; what unseen ground is
/// taken for; a square of the wheel's diameter for its box; all between the wheels for the belly.
/// With the size of Perseverance and 0.1 m of doubt under all wheels, bounds of rockers are 5 %
/// narrower than those by its pivots, and those of bogies 3 %: what limit_share leaves covers it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "ground_map.h"
#include "messages/calibration.h"
#include "stop_and_look.h"

namespace examples {

/// How much of its limits a rover may use.
struct ClearanceParams {
  bool bogies_lead = true;
  double limit_share = 0.9;
  double drop_radii = 1.33;
  double min_clearance_share = 0.3;

  void Visit(core::FieldVisitor& v) {
    v.Boolean("bogies_lead", bogies_lead,
              core::Setting("whether the bogies are at the front, as those of Rocky 3.2", {},
                            "rover.geometry.bogie_end, which navigators are not told"));
    v.Real("limit_share", limit_share,
           core::Assumed("share that a pose may use of the limits of tilt, rockers and bogies",
                         "some room before the hazard is felt", {0.1, 1.0}, {0.6, 1.0}));
    v.Real("drop_radii", drop_radii,
           core::Published("largest range of heights under a wheel, in wheel radii",
                           "Perseverance: 0.35 m (PIA26073), wheels of 0.263 m", {0.1, 10.0}));
    v.Real("min_clearance_share", min_clearance_share,
           core::Assumed("least room below the belly, as a share of its clearance",
                         "the mean height of a cell lies below the top of a rock, and wheels sink",
                         {0.0, 1.0}, {0.1, 0.5}));
  }
};

/// From the lowest to the highest value.
struct Bounds {
  double low = 0.0;
  double high = 0.0;

  double Largest() const { return std::max(-low, high); }
};

/// What is known of a pose.
struct Judgement {
  double use = 0.0;    ///< of the limits, in the worst of the checks; above 1: unsafe
  bool known = false;  ///< false: too little of the ground was seen to judge it
};

/// Judges poses on a map.
class Clearance {
 public:
  Clearance(const ClearanceParams& params, const messages::RoverBelief& rover)
      : params_(params), rover_(rover) {
    const messages::DriveCalibration& drive = rover_.drive;
    track_m_ = drive.wheel_y_m[0] - drive.wheel_y_m[3];
    half_belly_x_m_ = 0.5 * (drive.wheel_x_m[0] - drive.wheel_x_m[2]);
    half_belly_y_m_ = 0.5 * (track_m_ - rover_.wheel_width_m);
  }

  /// Returns how many wheels were put on a map so far: what the work of a plan grows with.
  std::int64_t placements() const { return placements_; }

  /// Judges the rover at a pose, from the wheels up.
  Judgement Judge(const GroundMap& map, const Pose& at) {
    std::array<Bounds, 6> wheel;
    std::array<bool, 6> seen{};
    double sum_m = 0.0;
    int known = 0;
    double use = 0.0;
    for (std::size_t i = 0; i < 6; ++i) {
      seen[i] =
          Under(map, Beside(at, rover_.drive.wheel_x_m[i], rover_.drive.wheel_y_m[i]), wheel[i]);
      if (!seen[i]) continue;
      ++known;
      sum_m += 0.5 * (wheel[i].low + wheel[i].high);
      // A wheel may drop from the highest to the lowest place under it.
      const double limit_m = params_.drop_radii * rover_.drive.wheel_radius_m;
      use = std::max(use, (wheel[i].high - wheel[i].low) / limit_m);
    }
    if (known < 3) return {use, false};
    // Unseen ground is taken to be as high as what was seen of this pose.
    for (std::size_t i = 0; i < 6; ++i) {
      if (!seen[i]) wheel[i] = {sum_m / known, sum_m / known};
    }
    const Side left = SideOn(0, wheel, use), right = SideOn(3, wheel, use);
    // The differential: the chassis pitches by the mean of both rockers, each of which is bent
    // against it by half of their difference.
    const Bounds bent{0.5 * (left.rocker.low - right.rocker.high),
                      0.5 * (left.rocker.high - right.rocker.low)};
    use = std::max(use, bent.Largest() / (params_.limit_share * rover_.max_rocker_rad));
    const double pitch_rad = Middle(left.rocker, right.rocker).Largest();
    const Bounds across = Slope(right.height, left.height, track_m_);
    const double roll_rad = Angle(across).Largest();
    const double tilt_rad = std::sqrt(pitch_rad * pitch_rad + roll_rad * roll_rad);
    use = std::max(use, tilt_rad / (params_.limit_share * rover_.max_tilt_rad));
    if (use > 1.0) return {use, true};
    const Bounds along = Middle(left.slope, right.slope);
    const double room_m = Room_m(map, at, Middle(left.height, right.height).low, along, across);
    if (room_m < params_.min_clearance_share * rover_.belly_clearance_m) return {2.0, true};
    return {std::max(use, 1.0 - room_m / rover_.belly_clearance_m), true};
  }

 private:
  /// What the suspension of one side does.
  struct Side {
    Bounds slope;   // of the rocker: rise from its rear to its front end over their distance
    Bounds rocker;  // its angle, front up
    Bounds height;  // of its middle, above which the chassis hangs
  };

  static Bounds Middle(const Bounds& a, const Bounds& b) {
    return {0.5 * (a.low + b.low), 0.5 * (a.high + b.high)};
  }
  static Bounds Slope(const Bounds& rear, const Bounds& front, double way_m) {
    return {(front.low - rear.high) / way_m, (front.high - rear.low) / way_m};
  }
  static double Arcsine(double sine) { return std::asin(std::min(1.0, std::max(-1.0, sine))); }
  static Bounds Angle(const Bounds& slope) { return {Arcsine(slope.low), Arcsine(slope.high)}; }

  /// The bogie stands on two wheels, the rocker on its pivot and the third one. Raises `use` to
  /// what the bogie uses of its limit.
  Side SideOn(std::size_t first, const std::array<Bounds, 6>& wheel, double& use) const {
    const bool lead = params_.bogies_lead;
    const std::size_t front = lead ? first : first + 1, rear = front + 1;  // wheels of the bogie
    const double* x_m = rover_.drive.wheel_x_m.data();
    const Bounds pivot = Middle(wheel[front], wheel[rear]);
    const double pivot_x_m = 0.5 * (x_m[front] + x_m[rear]);
    const Bounds head = lead ? pivot : wheel[first], tail = lead ? wheel[first + 2] : pivot;
    const double head_x_m = lead ? pivot_x_m : x_m[first];
    const double tail_x_m = lead ? x_m[first + 2] : pivot_x_m;
    Side side;
    side.slope = Slope(tail, head, head_x_m - tail_x_m);
    side.rocker = Angle(side.slope);
    const Bounds bogie = Angle(Slope(wheel[rear], wheel[front], x_m[front] - x_m[rear]));
    const Bounds bent{bogie.low - side.rocker.high, bogie.high - side.rocker.low};
    use = std::max(use, bent.Largest() / (params_.limit_share * rover_.max_bogie_rad));
    const double share = (0.0 - tail_x_m) / (head_x_m - tail_x_m);
    side.height = {(1.0 - share) * tail.low + share * head.low,
                   (1.0 - share) * tail.high + share * head.high};
    return side;
  }

  /// Sets `heights` to those that a wheel may stand on: of all cells that a square of its diameter
  /// touches. Returns whether any is known.
  bool Under(const GroundMap& map, const Pose& wheel, Bounds& heights) {
    ++placements_;
    const double reach_m = rover_.drive.wheel_radius_m;
    const std::int64_t end_x = map.Index(wheel.x_m + reach_m);
    const std::int64_t end_y = map.Index(wheel.y_m + reach_m);
    bool any = false;
    for (std::int64_t iy = map.Index(wheel.y_m - reach_m); iy <= end_y; ++iy) {
      for (std::int64_t ix = map.Index(wheel.x_m - reach_m); ix <= end_x; ++ix) {
        const Cell* cell = map.Find(ix, iy);
        if (cell == nullptr) continue;
        const double height_m = Height_m(*cell);
        heights.low = any ? std::min(heights.low, height_m) : height_m;
        heights.high = any ? std::max(heights.high, height_m) : height_m;
        any = true;
      }
    }
    return any;
  }

  /// Returns the least room between the ground and the belly, a plane that hangs at its lowest.
  double Room_m(const GroundMap& map, const Pose& at, double low_m, const Bounds& along,
                const Bounds& across) const {
    const int nx = std::max(1, static_cast<int>(std::ceil(half_belly_x_m_ / map.cell_m())));
    const int ny = std::max(1, static_cast<int>(std::ceil(half_belly_y_m_ / map.cell_m())));
    double room_m = rover_.belly_clearance_m;
    for (int i = -nx; i <= nx; ++i) {
      const double x_m = half_belly_x_m_ * i / nx;
      for (int j = -ny; j <= ny; ++j) {
        const double y_m = half_belly_y_m_ * j / ny;
        const Pose place = Beside(at, x_m, y_m);
        const Cell* cell = map.Find(map.Index(place.x_m), map.Index(place.y_m));
        if (cell == nullptr) continue;
        const double belly_m = low_m + rover_.belly_clearance_m +
                               std::min(along.low * x_m, along.high * x_m) +
                               std::min(across.low * y_m, across.high * y_m);
        room_m = std::min(room_m, belly_m - Height_m(*cell));
      }
    }
    return room_m;
  }

  /// Where the rover felt a hazard stands something that it does not see.
  static double Height_m(const Cell& cell) {
    const double height_m = cell.look > 0 ? cell.Height_m() : 0.0;
    return cell.felt ? height_m + 1.0 : height_m;
  }

  const ClearanceParams params_;
  const messages::RoverBelief rover_;
  double track_m_ = 0.0;
  double half_belly_x_m_ = 0.0;
  double half_belly_y_m_ = 0.0;
  std::int64_t placements_ = 0;
};

}  // namespace examples
