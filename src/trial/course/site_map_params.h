// The map of a site that is made before the drive, as from orbit, and handed to the navigator at
// its start. Records of navigators that read it depend on it; rockyard's own read none.
#pragma once

#include <array>
#include <string_view>

#include "core/fields.h"

namespace rockyard::trial {

// What the map holds. Must stay: the names in scenarios have this order.
enum class SiteMapKind { kNone, kElevation, kRocks, kBoth };

struct SiteMapParams {
  SiteMapKind kind = SiteMapKind::kNone;
  double cell_m = 1.0;
  double height_sd_m = 0.2;
  double shift_sd_m = 0.5;
  double margin_m = 10.0;
  double min_rock_m = 0.0;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::trial

template <>
struct rockyard::core::EnumNames<rockyard::trial::SiteMapKind> {
  static constexpr std::array<std::string_view, 4> kNames{"none", "elevation", "rocks", "both"};
};
