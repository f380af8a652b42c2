#include "terrain/arena_params.h"

namespace rockyard::terrain {

void ArenaParams::Visit(core::FieldVisitor& v) {
  using core::Origin;
  v.Choice(
      "kind", kind,
      {.doc = "open: the field goes on; walled; virtual_unfolded: mirror-periodic plane; "
              "virtual_reflected: the rover and its estimate are reflected at the mirror lines",
       .origin = Origin::kPublished,
       .source = "Matthies 1995 sec. 7 used the reflected virtual arena"});
  v.Real("x_min_m", x_min_m,
         {.doc = "where the arena begins; the start is at 0 by default",
          .min = -1000.0,
          .max = 1000.0,
          .origin = Origin::kAssumed,
          .source = "splits the 12 m about the 7.6 m course, 2.0 m behind the start and 2.4 m "
                    "beyond the goal",
          .study_low = -3.4,
          .study_high = -1.0});
  v.Real("length_m", length_m,
         {.doc = "extent along the course",
          .min = 1.0,
          .max = 1000.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 3"});
  v.Real("width_m", width_m,
         {.doc = "extent across the course",
          .min = 1.0,
          .max = 1000.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 3"});
  v.Real("mirror_margin_m", mirror_margin_m,
         {.doc = "virtual arenas: distance of the mirror lines from the edges",
          .min = 0.0,
          .max = 50.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 7"});
  v.Require("mirror_margin_m", !IsVirtual() || MirrorLine() >= 0.25,
            "leaves less than 0.5 m between the mirror lines",
            "use a value below half the width less 0.25 m");
  v.Require("mirror_margin_m",
            kind != ArenaKind::kVirtualReflected || mirror_margin_m <= 2.0 * MirrorLine(),
            "is wider than the strip between the mirror lines, whose image is to fill it",
            "use a value of up to a third of the width");
  v.Real("open_margin_m", open_margin_m,
         {.doc = "open: how far the rock field goes on beyond the arena",
          .min = 0.0,
          .max = 50.0,
          .origin = Origin::kAssumed,
          .source = "more than any detour on a 7.6 m course",
          .study_low = 2.0,
          .study_high = 8.0});
  v.Integer("unfolded_strips", unfolded_strips,
            {.doc = "virtual_unfolded: mirror images on each side",
             .min = 1,
             .max = 20,
             .origin = Origin::kAssumed,
             .source = "wide enough for any detour on a 7.6 m course",
             .study_low = 1,
             .study_high = 4});
}

}  // namespace rockyard::terrain
