#include "vision/cylinder/colour_cylinder.h"

namespace rockyard::vision {

using core::Assumed;
using core::Published;

void ColourCylinder::Visit(core::FieldVisitor& v) {
  v.Real("diameter_m", diameter_m,
         Published("diameter of the cylinder", "Matthies 1995 sec. 5: 19.2 cm in diameter",
                   {0.01, 10.0}));
  v.Real("height_m", height_m,
         Published("height of the cylinder", "Matthies 1995 sec. 5: 10 cm high", {0.01, 10.0}));
  v.FixedReals("axis", axis_L,
               Assumed("direction of the cylinder's axis in the frame that the cameras are told in",
                       "z upwards, a rover on level ground; a lean to a side of the image is found "
                       "(robust.fit.roll_sd_deg)",
                       {-1.0, 1.0}));
  v.Require("axis", math::Vector3(axis_L.data()).norm() > 1e-3, "points nowhere",
            "give a direction such as [0, 0, 1]");
}

}  // namespace rockyard::vision
