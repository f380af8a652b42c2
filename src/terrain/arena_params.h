// Parameters of the arena: what bounds the terrain sideways.
#pragma once

#include <array>
#include <cstdint>

#include "core/fields.h"

namespace rockyard::terrain {

enum class ArenaKind {
  kOpen,             // the rock field goes on beyond the arena
  kWalled,           // vertical walls at the arena's edges
  kVirtualUnfolded,  // layout mirrored about the mirror lines again and again; nothing at the lines
  kVirtualReflected,  // layout mirrored once, up to the edges; the trial reflects the rover
};

// The arena is the rectangle x_min_m <= x <= x_min_m + length_m, |y| <= width_m / 2.
struct ArenaParams {
  ArenaKind kind = ArenaKind::kVirtualReflected;
  double x_min_m = -2.0;
  double length_m = 12.0;
  double width_m = 4.0;
  double mirror_margin_m = 0.9;
  double open_margin_m = 4.0;
  std::int64_t unfolded_strips = 2;

  bool IsVirtual() const {
    return kind == ArenaKind::kVirtualUnfolded || kind == ArenaKind::kVirtualReflected;
  }
  // The mirror lines of the virtual arenas are y = +-this.
  double MirrorLine() const { return 0.5 * width_m - mirror_margin_m; }
  // Returns whether a course may start or end there: in the arena and, where virtual, between the
  // mirror lines.
  bool HoldsCoursePoint(double x_m, double y_m) const {
    const double half_width_m = IsVirtual() ? MirrorLine() : 0.5 * width_m;
    return x_m >= x_min_m && x_m <= x_min_m + length_m && y_m >= -half_width_m &&
           y_m <= half_width_m;
  }

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::terrain

template <>
struct rockyard::core::EnumNames<rockyard::terrain::ArenaKind> {
  static constexpr std::array<std::string_view, 4> kNames{"open", "walled", "virtual_unfolded",
                                                          "virtual_reflected"};
};
