#include "terrain/listed_rocks_params.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace rockyard::terrain {

namespace {

using core::Origin;

// Most rocks of a list; about 10 MB of JSON.
constexpr std::size_t kMostRocks = 100000;

void RequireLength(std::string_view name, const std::vector<double>& list, std::size_t rocks,
                   core::FieldVisitor& v) {
  v.Require(
      name, list.size() == rocks,
      "has " + std::to_string(list.size()) + " entries where x_m has " + std::to_string(rocks),
      "give every rock one entry of each list");
}

}  // namespace

void ListedRocksParams::Visit(core::FieldVisitor& v) {
  v.Reals("x_m", x_m,
          {.doc = "listed: x of every centre",
           .min = -1000.0,
           .max = 1000.0,
           .origin = Origin::kSetting,
           .max_entries = kMostRocks});
  v.Reals("y_m", y_m,
          {.doc = "listed: y of every centre",
           .min = -1000.0,
           .max = 1000.0,
           .origin = Origin::kSetting,
           .max_entries = kMostRocks});
  v.Reals("diameter_m", diameter_m,
          {.doc = "listed: diameter of every rock",
           .min = 0.02,
           .max = 5.0,
           .origin = Origin::kSetting,
           .max_entries = kMostRocks});
  v.Reals("height_m", height_m,
          {.doc = "listed: height of every rock above the ground",
           .min = 0.01,
           .max = 5.0,
           .origin = Origin::kSetting,
           .max_entries = kMostRocks});
  RequireLength("y_m", y_m, x_m.size(), v);
  RequireLength("diameter_m", diameter_m, x_m.size(), v);
  RequireLength("height_m", height_m, x_m.size(), v);
}

}  // namespace rockyard::terrain
