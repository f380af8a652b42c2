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
}

}  // namespace rockyard::vision
