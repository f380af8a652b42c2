// Parameters of a terrain: ground, rocks and arena.
#pragma once

#include "core/fields.h"
#include "terrain/arena_params.h"
#include "terrain/ground_params.h"
#include "terrain/rock_params.h"

namespace rockyard::terrain {

// The whole of a scenario's `terrain` section.
struct TerrainParams {
  GroundParams ground;
  RockFieldParams rocks;
  ArenaParams arena;

  // Returns the area over which the rocks are laid out at random, before mirroring, m2.
  double LayoutArea() const;
  // Returns the expected number of rocks with all mirror images.
  double ExpectedRocks() const;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::terrain
