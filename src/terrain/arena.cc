#include "terrain/arena.h"

#include <cmath>

namespace rockyard::terrain {
namespace {

Rectangle Expanded(const Rectangle& r, double margin_m) {
  return {r.x_min_m - margin_m, r.x_max_m + margin_m, r.y_min_m - margin_m, r.y_max_m + margin_m};
}

// The rectangle with the arena's extent along the course and |y| <= half_width_m.
Rectangle Lane(const ArenaParams& arena, double half_width_m) {
  return {arena.x_min_m, arena.x_min_m + arena.length_m, -half_width_m, half_width_m};
}

Rock Image(const Rock& rock, double mirror_line_m, int strip) {
  // y_n = (-1)^n y + 2 n h; a reflection turns the yaw's sign, a shift keeps it.
  const double sign = strip % 2 == 0 ? 1.0 : -1.0;
  Rock image = rock;
  image.center_W.y() = sign * rock.center_W.y() + 2.0 * strip * mirror_line_m;
  image.yaw_rad = sign * rock.yaw_rad;
  return image;
}

}  // namespace

Rectangle ArenaBounds(const ArenaParams& arena) { return Lane(arena, 0.5 * arena.width_m); }

Rectangle DrivableBounds(const ArenaParams& arena) {
  switch (arena.kind) {
    case ArenaKind::kOpen:
      return Expanded(ArenaBounds(arena), arena.open_margin_m);
    case ArenaKind::kVirtualUnfolded: {
      // The strip itself and as many on both sides.
      const double strips = 1.0 + 2.0 * static_cast<double>(arena.unfolded_strips);
      return Lane(arena, strips * arena.MirrorLine());
    }
    case ArenaKind::kWalled:
    case ArenaKind::kVirtualReflected:
      break;
  }
  return ArenaBounds(arena);
}

Rectangle CountArea(const RockFieldParams& rocks) {
  const double half_width_m = 0.5 * rocks.count_area_width_m;
  return {rocks.count_area_x_m, rocks.count_area_x_m + rocks.count_area_length_m, -half_width_m,
          half_width_m};
}

Rectangle LayoutBounds(const TerrainParams& params) {
  if (!params.arena.IsVirtual()) return DrivableBounds(params.arena);
  // In virtual arenas only the strip between the mirror lines is laid out, or the count area in it.
  if (params.rocks.kind == RockFieldKind::kUniformCount) return CountArea(params.rocks);
  return Lane(params.arena, params.arena.MirrorLine());
}

std::vector<Wall> ArenaWalls(const ArenaParams& arena) {
  if (arena.kind != ArenaKind::kWalled) return {};
  const Rectangle bounds = ArenaBounds(arena);
  // Walls as half spaces normal . p < offset.
  return {{math::Vector3::UnitX(), bounds.x_max_m},
          {-math::Vector3::UnitX(), -bounds.x_min_m},
          {math::Vector3::UnitY(), bounds.y_max_m},
          {-math::Vector3::UnitY(), -bounds.y_min_m}};
}

std::vector<Rock> MirrorImages(const ArenaParams& arena, const Rock& rock) {
  if (!arena.IsVirtual()) return {};
  const bool unfolded = arena.kind == ArenaKind::kVirtualUnfolded;
  // One strip on each side fills virtual_reflected, whose margin is no wider than a strip.
  const int strips = unfolded ? static_cast<int>(arena.unfolded_strips) : 1;
  std::vector<Rock> images;
  for (int strip = -strips; strip <= strips; ++strip) {
    if (strip == 0) continue;
    Rock image = Image(rock, arena.MirrorLine(), strip);
    // virtual_reflected ends at the edges of the arena.
    if (unfolded || std::abs(image.center_W.y()) <= 0.5 * arena.width_m) {
      images.push_back(image);
    }
  }
  return images;
}

}  // namespace rockyard::terrain
