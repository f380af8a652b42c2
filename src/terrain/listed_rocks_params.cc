#include "terrain/listed_rocks_params.h"

#include <cstddef>

namespace rockyard::terrain {

using core::Origin;

void ListedRocksParams::Visit(core::FieldVisitor& v) {
  v.Reals("x_m", x_m,
          {.doc = "listed: x of every centre",
           .min = -1000.0,
           .max = 1000.0,
           .origin = Origin::kSetting});
  v.Reals("y_m", y_m,
          {.doc = "listed: y of every centre",
           .min = -1000.0,
           .max = 1000.0,
           .origin = Origin::kSetting});
  v.Reals("diameter_m", diameter_m,
          {.doc = "listed: diameter of every rock",
           .min = 0.02,
           .max = 5.0,
           .origin = Origin::kSetting});
  v.Reals("height_m", height_m,
          {.doc = "listed: height of every rock above the ground",
           .min = 0.01,
           .max = 5.0,
           .origin = Origin::kSetting});
  v.Require(
      "x_m",
      y_m.size() == x_m.size() && diameter_m.size() == x_m.size() && height_m.size() == x_m.size(),
      "names another number of rocks than y_m, diameter_m or height_m",
      "give every rock one entry of each list");
}

}  // namespace rockyard::terrain
