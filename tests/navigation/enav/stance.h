// A rocker-bogie that stands on rigid ground, by its geometry in space: what ACE is held against.
// Nothing of it is taken from src/navigation/enav but the names of the states.
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <numbers>

#include "math/pose.h"
#include "navigation/enav/ace.h"
#include "navigation/fake_rover.h"

namespace rockyard::navigation {

using Stance = SuspensionState<double>;

// Perseverance by the coordinates of its public URDF; half the distance of its rocker joints is not
// in it (0.775 m assumed), the belly's place neither.
inline messages::RoverBelief PerseveranceLike() {
  messages::RoverBelief rover;
  rover.drive.wheel_radius_m = 0.263;
  rover.drive.wheel_x_m = {1.185, 0.0, -1.075, 1.185, 0.0, -1.075};
  rover.drive.wheel_y_m = {1.0625, 1.1845, 1.0625, -1.0625, -1.1845, -1.0625};
  rover.drive.max_wheel_speed_m_s = 0.042;
  rover.length_m = 2.786;
  rover.width_m = 2.7;
  rover.belly_clearance_m = 0.6;
  rover.wheel_width_m = 0.335;
  rover.max_rocker_rad = math::DegToRad(25.0);
  rover.max_bogie_rad = math::DegToRad(50.0);
  rover.max_tilt_rad = math::DegToRad(30.0);
  rover.suspension = {.bogies_at_front = false,
                      .rocker_pivot_x_m = 0.304,
                      .rocker_pivot_z_m = 0.893,
                      .bogie_pivot_x_m = -0.45,
                      .bogie_pivot_z_m = 0.663,
                      .pivot_y_m = 0.775,
                      .belly_length_m = 1.8,
                      .belly_width_m = 1.55};
  return rover;
}

// The same rover backwards: its bogies are in front.
inline messages::RoverBelief Reversed(messages::RoverBelief rover) {
  auto& drive = rover.drive;
  for (std::size_t i : {0, 3}) {
    const double front_m = drive.wheel_x_m[i];
    drive.wheel_x_m[i] = -drive.wheel_x_m[i + 2];
    drive.wheel_x_m[i + 1] = -drive.wheel_x_m[i + 1];
    drive.wheel_x_m[i + 2] = -front_m;
  }
  rover.suspension.bogies_at_front = true;
  rover.suspension.rocker_pivot_x_m = -rover.suspension.rocker_pivot_x_m;
  rover.suspension.bogie_pivot_x_m = -rover.suspension.bogie_pivot_x_m;
  return rover;
}

// Places of the wheels' lowest points in W for a pose of R's origin seen from above and a stance.
inline messages::PerWheel<math::Vector3> WheelsAt(const messages::RoverBelief& rover,
                                                  const math::Pose2& pose, const Stance& stance) {
  const messages::SuspensionBelief& s = rover.suspension;
  const double facing = s.bogies_at_front ? -1.0 : 1.0;
  const math::Transform X_WR =
      math::MakePose({pose.x_m, pose.y_m, -stance.origin_z_m}, pose.heading_rad,
                     -facing * stance.pitch_rad, stance.roll_rad);
  const math::Vector3 rocker(s.rocker_pivot_x_m, 0.0, s.rocker_pivot_z_m);
  const math::Vector3 bogie(s.bogie_pivot_x_m, 0.0, s.bogie_pivot_z_m);
  messages::PerWheel<math::Vector3> places;
  for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
    // Down at the rocker's end: the left rocker against its angle, the right one with it.
    const double rocker_rad = i < 3 ? -stance.rocker_rad : stance.rocker_rad;
    const double bogie_rad = rocker_rad - stance.bogie_rad[i / 3];
    const auto turned = [&](double angle_rad, const math::Vector3& v) -> math::Vector3 {
      return math::RotationAbout(facing * angle_rad, math::Vector3::UnitY()) * v;
    };
    const math::Vector3 wheel(rover.drive.wheel_x_m[i], 0.0, rover.drive.wheel_radius_m);
    const bool on_rocker = i % 3 == (s.bogies_at_front ? 2u : 0u);
    math::Vector3 p_R = rocker + turned(rocker_rad, (on_rocker ? wheel : bogie) - rocker);
    if (!on_rocker) p_R += turned(bogie_rad, wheel - bogie);
    p_R.y() = rover.drive.wheel_y_m[i];
    places[i] = X_WR * p_R;
    places[i].z() -= rover.drive.wheel_radius_m;
  }
  return places;
}

using Ground = std::function<double(double x_m, double y_m)>;  // height, up

// The kinematics of ACE by circles that meet, in the frame of linkage.h: heights in, stance out.
inline Stance StandByCircles(const messages::RoverBelief& rover,
                             const messages::PerWheel<double>& ground_m) {
  struct Point {
    double x, z;  // z up
  };
  const messages::SuspensionBelief& s = rover.suspension;
  const double facing = s.bogies_at_front ? -1.0 : 1.0;
  const double radius_m = rover.drive.wheel_radius_m;
  const auto distance = [](Point p, Point q) { return std::hypot(p.x - q.x, p.z - q.z); };
  // The upper point at those distances from p and q.
  const auto meet = [&](Point p, double from_p, Point q, double from_q) -> Point {
    const double d = distance(p, q);
    const double along = (from_p * from_p - from_q * from_q + d * d) / (2.0 * d);
    const double across = std::sqrt(from_p * from_p - along * along);
    const Point u{(q.x - p.x) / d, (q.z - p.z) / d};  // q lies towards -x
    return {p.x + along * u.x + across * u.z, p.z + along * u.z - across * u.x};
  };
  const auto angle = [](Point from, Point to) { return std::atan2(to.z - from.z, from.x - to.x); };
  const Point b0{facing * s.bogie_pivot_x_m, s.bogie_pivot_z_m};
  const Point d0{facing * s.rocker_pivot_x_m, s.rocker_pivot_z_m};
  std::array<double, 2> rocker_rad, bogie_rad, pivot_m;
  double rest_rocker_rad = 0.0, rest_bogie_rad = 0.0;
  for (std::size_t side = 0; side < 2; ++side) {
    const auto wheel = [&](std::size_t place) -> std::size_t {
      return 3 * side + (s.bogies_at_front ? 2 - place : place);
    };
    const auto rest = [&](std::size_t place) -> Point {
      return {facing * rover.drive.wheel_x_m[wheel(place)], radius_m};
    };
    const auto height = [&](std::size_t place) { return ground_m[wheel(place)] + radius_m; };
    const Point f0 = rest(0), m0 = rest(1), r0 = rest(2);
    // m anywhere, r behind it; then f somewhere before the bogie joint.
    const Point m{0.0, height(1)};
    const double mr = distance(m0, r0);
    const Point r{-std::sqrt(mr * mr - std::pow(height(1) - height(2), 2)), height(2)};
    const Point b = meet(m, distance(b0, m0), r, distance(b0, r0));
    const double fb = distance(f0, b0);
    const Point f{b.x + std::sqrt(fb * fb - std::pow(height(0) - b.z, 2)), height(0)};
    const Point d = meet(f, distance(d0, f0), b, distance(d0, b0));
    rocker_rad[side] = angle(f, d);
    bogie_rad[side] = angle(m, b);
    rest_rocker_rad = angle(f0, d0);
    rest_bogie_rad = angle(m0, b0);
    pivot_m[side] = d.z;
  }
  Stance stance;
  stance.roll_rad = std::asin((pivot_m[0] - pivot_m[1]) / (2.0 * s.pivot_y_m));
  stance.pitch_rad = rest_rocker_rad - 0.5 * (rocker_rad[0] + rocker_rad[1]);
  stance.rocker_rad = 0.5 * (rocker_rad[1] - rocker_rad[0]);
  for (std::size_t side = 0; side < 2; ++side) {
    stance.bogie_rad[side] =
        (rocker_rad[side] - rest_rocker_rad) - (bogie_rad[side] - rest_bogie_rad);
  }
  // Pitch about the rover's axis, then roll about a level one.
  const double above_m = d0.x * std::sin(stance.pitch_rad) + d0.z * std::cos(stance.pitch_rad);
  stance.origin_z_m = above_m * std::cos(stance.roll_rad) - 0.5 * (pivot_m[0] + pivot_m[1]);
  return stance;
}

// Where the rover comes to stand by those kinematics, each wheel on the ground under its place.
struct Settled {
  Stance stance;
  messages::PerWheel<math::Vector3> places;
};

inline Settled SettleByCircles(const messages::RoverBelief& rover, const math::Pose2& pose,
                               const Ground& ground) {
  Settled settled;
  settled.places = WheelsAt(rover, pose, {});
  for (int round = 0; round < 8; ++round) {
    messages::PerWheel<double> heights_m;
    for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
      heights_m[i] = ground(settled.places[i].x(), settled.places[i].y());
    }
    settled.stance = StandByCircles(rover, heights_m);
    if (round < 7) settled.places = WheelsAt(rover, pose, settled.stance);
  }
  return settled;
}

// Where it comes to stand in space, each wheel sunk in by so much: Newton's method on the six gaps
// between wheels and ground. Nothing where that finds no stance.
inline std::optional<Stance> SettleInSpace(const messages::RoverBelief& rover,
                                           const math::Pose2& pose, const Ground& ground,
                                           const messages::PerWheel<double>& sunk_m = {}) {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  const auto stance_of = [](const Vector6& q) {
    return Stance{q[0], q[1], q[2], {q[3], q[4]}, q[5]};
  };
  const auto gaps = [&](const Vector6& q) {
    const auto places = WheelsAt(rover, pose, stance_of(q));
    Vector6 gap;
    for (int i = 0; i < 6; ++i) {
      const math::Vector3& p = places[static_cast<std::size_t>(i)];
      gap[i] = p.z() + sunk_m[static_cast<std::size_t>(i)] - ground(p.x(), p.y());
    }
    return gap;
  };
  Vector6 q = Vector6::Zero();
  q[5] = -ground(pose.x_m, pose.y_m);
  for (int round = 0; round < 30; ++round) {
    const Vector6 gap = gaps(q);
    if (gap.norm() < 1e-9) return stance_of(q);
    Eigen::Matrix<double, 6, 6> slopes;
    for (int k = 0; k < 6; ++k) {
      Vector6 moved = q;
      moved[k] += 1e-6;
      slopes.col(k) = 1e6 * (gaps(moved) - gap);
    }
    Vector6 step = slopes.partialPivLu().solve(-gap);
    const double most = step.head<5>().cwiseAbs().maxCoeff();
    if (most > 0.2) step *= 0.2 / most;
    q += step;
  }
  return std::nullopt;
}

// Heights of cells, and the ground that is linear between their middles: every place lies between
// the heights of the four around it.
inline Ground BetweenMiddles(const HeightMap& map) {
  return [&map](double x_m, double y_m) {
    const double u = x_m / map.cell_m() - 0.5;
    const double v = y_m / map.cell_m() - 0.5;
    const auto i = static_cast<std::int64_t>(std::floor(u));
    const auto j = static_cast<std::int64_t>(std::floor(v));
    const double a = u - static_cast<double>(i);
    const double b = v - static_cast<double>(j);
    const auto h = [&](std::int64_t x, std::int64_t y) { return map.At({x, y}).Height_m(); };
    return (1 - b) * ((1 - a) * h(i, j) + a * h(i + 1, j)) +
           b * ((1 - a) * h(i, j + 1) + a * h(i + 1, j + 1));
  };
}

// A slope of up to 10 deg with waves of half a metre to three, and half balls as rocks, `rocks` a
// m2 and up to `rock_m` high.
inline HeightMap RandomGround(Draws& draws, double cell_m, double side_m, double rocks,
                              double rock_m) {
  HeightMap map(cell_m, side_m);
  const double slope_x = draws.Between(-0.12, 0.12), slope_y = draws.Between(-0.12, 0.12);
  struct Wave {
    double kx, ky, phase, height_m;
  };
  std::vector<Wave> waves;
  for (int i = 0; i < 4; ++i) {
    const double length_m = draws.Between(0.5, 3.0), to = draws.Between(0.0, 6.283);
    const double k = 2.0 * std::numbers::pi / length_m;
    waves.push_back({k * std::cos(to), k * std::sin(to), draws.Between(0.0, 6.283),
                     0.02 * length_m * draws.Between(0.0, 1.0)});
  }
  struct Ball {
    double x, y, r;
  };
  std::vector<Ball> balls;
  const int count = static_cast<int>(rocks * side_m * side_m);
  for (int i = 0; i < count; ++i) {
    balls.push_back({draws.Between(-0.5, 0.5) * side_m, draws.Between(-0.5, 0.5) * side_m,
                     draws.Between(0.2, 1.0) * rock_m});
  }
  map.ForEach([&](const LatticeCell& at, HeightCell& cell) {
    const double x = map.MiddleX_m(at), y = map.MiddleY_m(at);
    double height = slope_x * x + slope_y * y;
    for (const Wave& w : waves) height += w.height_m * std::sin(w.kx * x + w.ky * y + w.phase);
    double rock = 0.0;
    for (const Ball& ball : balls) {
      const double left = ball.r * ball.r - std::pow(x - ball.x, 2) - std::pow(y - ball.y, 2);
      if (left > 0.0) rock = std::max(rock, std::sqrt(left));
    }
    cell.Add(height + rock);
  });
  return map;
}

// What came of holding ACE's bounds against stances.
struct BoundsHeld {
  std::int64_t poses = 0;     // that have bounds
  std::int64_t left_box = 0;  // with a wheel that left its box
  std::int64_t violations = 0;
  double worst_excess = 0.0;  // rad, or m
  // Sums over poses, of roll, pitch, rocker, both bogies, origin; then of clearance less its bound.
  std::array<double, 6> width{};
  double clearance_gap_m = 0.0;
};

// Holds the bounds of `ace` against stances by circles, on `grounds` random grounds with `poses`
// poses each. Boxes of `half_x_m` by `half_y_m` are those of the parameters less a cell, as the
// ground between two middles has the heights of both.
inline BoundsHeld HoldBounds(const AceParams& params, const messages::RoverBelief& rover,
                             std::uint64_t seed, int grounds, int poses) {
  const Ace ace(params, rover);
  const double half_x_m = params.wheel_box_diameters * rover.drive.wheel_radius_m;
  const double half_y_m = 0.5 * params.wheel_box_widths * rover.wheel_width_m;
  BoundsHeld held;
  for (int g = 0; g < grounds; ++g) {
    Draws draws({seed, static_cast<std::uint32_t>(g)}, 0);
    const double cell_m = 0.1;
    const HeightMap map = RandomGround(draws, cell_m, 8.0, draws.Between(0.0, 0.6), 0.3);
    const Ground ground = BetweenMiddles(map);
    for (int p = 0; p < poses; ++p) {
      const math::Pose2 pose{draws.Between(-1.5, 1.5), draws.Between(-1.5, 1.5),
                             draws.Between(-std::numbers::pi, std::numbers::pi)};
      const AceVerdict verdict = ace.Check(map, pose);
      if (verdict.failure == AceFailure::kLinkage) continue;
      const auto [stance, places] = SettleByCircles(rover, pose, ground);
      ++held.poses;
      for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
        const math::Pose2 at_R =
            math::SeenFrom(pose, {places[i].x(), places[i].y(), pose.heading_rad});
        if (std::abs(at_R.x_m - rover.drive.wheel_x_m[i]) > half_x_m - cell_m ||
            std::abs(at_R.y_m - rover.drive.wheel_y_m[i]) > half_y_m - cell_m) {
          ++held.left_box;
          break;
        }
      }
      const SuspensionState<Interval>& bound = verdict.state;
      const std::array<std::pair<Interval, double>, 6> states{
          {{bound.roll_rad, stance.roll_rad},
           {bound.pitch_rad, stance.pitch_rad},
           {bound.rocker_rad, stance.rocker_rad},
           {bound.bogie_rad[0], stance.bogie_rad[0]},
           {bound.bogie_rad[1], stance.bogie_rad[1]},
           {bound.origin_z_m, stance.origin_z_m}}};
      double excess = 0.0;
      for (std::size_t k = 0; k < states.size(); ++k) {
        const auto& [interval, value] = states[k];
        held.width[k] += interval.Width();
        excess = std::max({excess, interval.low - value, value - interval.high});
      }
      // The belly's plane, over the middles of the cells under it.
      const double tan_pitch = std::tan(stance.pitch_rad), tan_roll = std::tan(stance.roll_rad);
      const double level_m =
          rover.belly_clearance_m * std::sqrt(1 + tan_pitch * tan_pitch + tan_roll * tan_roll);
      const double facing = rover.suspension.bogies_at_front ? -1.0 : 1.0;
      double clearance_m = std::numeric_limits<double>::infinity();
      map.VisitBox(pose, {}, 0.5 * rover.suspension.belly_length_m,
                   0.5 * rover.suspension.belly_width_m,
                   [&](const HeightCell* cell, double x, double y) {
                     const double belly_m =
                         -stance.origin_z_m + facing * x * tan_pitch + y * tan_roll + level_m;
                     clearance_m = std::min(clearance_m, belly_m - cell->Height_m());
                   });
      excess = std::max(excess, verdict.clearance_m - clearance_m);
      held.clearance_gap_m += clearance_m - verdict.clearance_m;
      held.violations += excess > 1e-9;
      held.worst_excess = std::max(held.worst_excess, excess);
    }
  }
  return held;
}

inline HeightMap Map(const Ground& ground) {
  HeightMap map(0.1, 12.0);
  map.ForEach([&](const LatticeCell& at, HeightCell& cell) {
    cell.Add(ground(map.MiddleX_m(at), map.MiddleY_m(at)));
  });
  return map;
}

}  // namespace rockyard::navigation
