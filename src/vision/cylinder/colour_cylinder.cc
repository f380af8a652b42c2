#include "vision/cylinder/colour_cylinder.h"

namespace rockyard::vision {

void ColourCylinder::Visit(core::FieldVisitor& v) {
  using core::Origin;
  v.Real("diameter_m", diameter_m,
         {.doc = "diameter of the cylinder",
          .min = 0.01,
          .max = 10.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 5: 19.2 cm in diameter"});
  v.Real("height_m", height_m,
         {.doc = "height of the cylinder",
          .min = 0.01,
          .max = 10.0,
          .origin = Origin::kPublished,
          .source = "Matthies 1995 sec. 5: 10 cm high"});
  v.FixedReals("axis", axis_L,
               {.doc = "direction of the cylinder's axis in the frame that the cameras are told in",
                .min = -1.0,
                .max = 1.0,
                .origin = Origin::kAssumed,
                .source = "z upwards, a rover on level ground; a lean to a side of the image is "
                          "found (robust.fit.roll_sd_deg)"});
  v.Require("axis", math::Vector3(axis_L.data()).norm() > 1e-3, "points nowhere",
            "give a direction such as [0, 0, 1]");
}

}  // namespace rockyard::vision
