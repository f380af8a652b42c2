#include "navigation/enav/ace_params.h"

namespace rockyard::navigation {

using core::Assumed;

void AceParams::Visit(core::FieldVisitor& v) {
  v.Real("min_clearance_share", min_clearance_share,
         Assumed("least clearance under the belly at a pose, in shares of that on level ground",
                 "Ghosh 2018 fig. 4 draws 0.15 m, and what seems to be the nominal one at 0.30 m, "
                 "for Rocky 8; none is printed for flight",
                 {0.0, 1.0}, {0.25, 0.75}));
  v.Angle("max_tilt_deg", max_tilt_rad,
          Assumed("largest tilt at a pose; 0: none is checked",
                  "16 deg at the landing of Perseverance and more later, as others report of JPL's "
                  "talks; Curiosity's reactive limit is 30 (Rankin 2020)",
                  {0.0, 60.0}, {16.0, 30.0}));
  v.Angle("max_roll_deg", max_roll_rad,
          Assumed("largest roll at a pose, either way; 0: none is checked",
                  "Ghosh 2018 fig. 4 draws 30 deg for Rocky 8; flight checks tilt", {0.0, 60.0},
                  {0.0, 30.0}));
  v.Angle("max_pitch_deg", max_pitch_rad,
          Assumed("largest pitch at a pose, either way; 0: none is checked", "as max_roll_deg",
                  {0.0, 60.0}, {0.0, 30.0}));
  v.Real("stop_share", stop_share,
         Assumed("largest angle of a rocker or bogie, either way, in shares of its stop",
                 "no limit is printed; Ghosh 2018 fig. 4 draws 20 and 44 deg for Rocky 8, "
                 "Curiosity's reactive ones are 7 and 17 (Rankin 2020)",
                 {0.05, 1.0}, {0.3, 1.0}));
  v.Real("max_wheel_drop_radii", max_wheel_drop_radii,
         Assumed("largest span of the ground's heights under a wheel, in wheel radii; 0: none is "
                 "checked",
                 "PIA26073 shows drops of more than 0.35 m as hazards: 1.33 radii of Perseverance",
                 {0.0, 10.0}, {0.7, 2.0}));
  v.Real("wheel_box_diameters", wheel_box_diameters,
         Assumed("length along the rover of the box in which a wheel may meet the ground, in wheel "
                 "diameters",
                 "a footprint of half a diameter and as much again for where attitude and "
                 "suspension put the wheel; no size is published",
                 {0.1, 5.0}, {0.5, 2.0}));
  v.Real("wheel_box_widths", wheel_box_widths,
         Assumed("its width across the rover, in wheel widths",
                 "the wheel, and a tenth of it to either side; no size is published", {0.1, 5.0},
                 {1.0, 2.0}));
  v.Real("min_seen_share", min_seen_share,
         Assumed("share of the cells of a wheel's box, and of those under the belly, that have to "
                 "be seen; unseen ones say nothing",
                 "what flight makes of holes is not published; 1 trusts none, 0 all", {0.0, 1.0},
                 {0.0, 1.0}));
  v.Real("risk", risk,
         Assumed("p-ACE: a pose passes where its chance to break a limit is below; 0: ACE, which "
                 "passes what breaks none anywhere in its bounds",
                 "Ghosh 2018 fig. 9 compares 1e-8, 1e-6, 1e-4 and 1e-3; flight uses ACE",
                 {0.0, 1.0}, {0.0, 1e-3}));
  v.Boolean("both_rockers", both_rockers,
            Assumed("p-ACE: both rockers count, as if they were independent",
                    "Ghosh 2018 names both among its states, though one has the negative of the "
                    "other's angle"));
}

}  // namespace rockyard::navigation
