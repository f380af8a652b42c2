// Which cell of GESTALT's map each point of a cloud falls into, for many points side by side. Each
// operation rounds as its scalar form does and none is fused, so that maps are the same on every
// processor.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "math/pose.h"

namespace rockyard::navigation {

// One axis of the map: cell i of the endless lattice goes from origin + i step on.
struct SieveAxis {
  double origin_m = 0.0;
  double step_m = 1.0;
  double rover_m = 0.0;
  double first = 0.0;  // the window's first cell, a whole number
  double cells = 0.0;  // of the window
  double wrap = 0.0;   // the slot of the window's first cell, see CellWindow
};

// Which points a map takes: those with |x| and |y| up to largest_xy_m, |z| up to largest_z_m, no
// farther above or below the origin of R than largest_height_m, in a cell of the window whose
// centre lies within sqrt(largest_square_m2) of the rover.
struct PointSieve {
  SieveAxis x, y;
  double largest_xy_m = 0.0;
  double largest_z_m = 0.0;
  double largest_height_m = 0.0;
  double largest_square_m2 = 0.0;
};

// Points, and which of them a map takes.
struct SiftedPoints {
  static constexpr std::size_t kMost = 128;
  static constexpr std::size_t kRoom = kMost + 8;  // whole vectors are written

  // Points up to kMost, of those that are not taken anything: row times cells of a row plus column,
  // both as slots; coordinates in moment units, see math/point_moments.h.
  std::array<std::int64_t, kRoom> slots{}, x{}, y{}, z{};
  // The numbers of those that are taken, ascending.
  std::size_t count = 0;
  std::array<std::uint8_t, kRoom> taken{};
  // The least and largest column and row of the window among these; of none, infinities.
  double first_x = 0.0, last_x = 0.0, first_y = 0.0, last_y = 0.0;
};

// Sifts up to kMost points, which X_WR takes into the map's frame.
void Sift(const PointSieve& sieve, std::span<const math::Vector3> points_R,
          const math::Transform& X_WR, SiftedPoints& sifted);

}  // namespace rockyard::navigation
