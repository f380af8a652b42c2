// The areas that an arena consists of, its walls and its mirror images. Fields are laid out by
// them. Drives end where a rover leaves them; the route planner, drawings and replays are bounded
// by them. Records depend on bounds and walls, and on the order of images, from the rightmost strip
// to the leftmost: it is the order of rocks.
#pragma once

#include <vector>

#include "terrain/rock.h"
#include "terrain/terrain.h"
#include "terrain/terrain_params.h"

namespace rockyard::terrain {

// A rectangle along the axes of W, m.
struct Rectangle {
  double x_min_m = 0.0;
  double x_max_m = 0.0;
  double y_min_m = 0.0;
  double y_max_m = 0.0;

  double Area() const { return (x_max_m - x_min_m) * (y_max_m - y_min_m); }
  bool Contains(double x_m, double y_m) const {
    return x_m >= x_min_m && x_m <= x_max_m && y_m >= y_min_m && y_m <= y_max_m;
  }
};

// Returns the arena itself.
Rectangle ArenaBounds(const ArenaParams& arena);
// Returns where rocks exist, mirror images included: a rover that leaves this area has left the
// arena.
Rectangle DrivableBounds(const ArenaParams& arena);
// Returns the area in which a field of kind uniform_count has exactly `count` rocks.
Rectangle CountArea(const RockFieldParams& rocks);
// Returns where rocks are laid out at random, before mirroring. Its area must be
// params.LayoutArea().
Rectangle LayoutBounds(const TerrainParams& params);

// Returns four vertical walls where the arena is walled, otherwise none.
std::vector<Wall> ArenaWalls(const ArenaParams& arena);

// Returns the images of a rock of the central strip in the virtual arenas, without the rock itself;
// none for other arenas. Strip n is centred on y = 2 n h for mirror lines at y = +-h and holds an
// image of the central strip, reflected where n is odd: y_n = (-1)^n y + 2 n h. virtual_reflected
// keeps the images whose centres lie in the arena.
std::vector<Rock> MirrorImages(const ArenaParams& arena, const Rock& rock);

}  // namespace rockyard::terrain
