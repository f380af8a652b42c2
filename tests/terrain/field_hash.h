// A hash over every number of a field's rocks.
#pragma once

#include <cstdint>

#include "core/hash.h"
#include "terrain/terrain.h"

namespace rockyard::terrain {

inline std::uint64_t HashRocks(const Terrain& terrain) {
  core::Hasher hasher;
  for (const Rock& rock : terrain.rocks()) {
    for (int i = 0; i < 3; ++i) hasher.Real(rock.center_W[i]).Real(rock.semi_axes_m[i]);
    hasher.Real(rock.yaw_rad).Real(rock.diameter_m).Real(rock.height_m);
  }
  return hasher.value();
}

}  // namespace rockyard::terrain
