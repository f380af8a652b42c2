#include "sensing/stripe_imager_params.h"

namespace rockyard::sensing {

using core::Origin;

void StripeImagerParams::Visit(core::FieldVisitor& v) {
  VisitOptics(v);
  v.Integer("averaging_rows", averaging_rows,
            {.doc = "image lines that are read around each scanline for averaging; odd",
             .min = 1,
             .max = 63,
             .origin = Origin::kPublished,
             .source = "Matthies 1995 sec. 6: 5 x 5 averaging"});
  v.Require("averaging_rows", averaging_rows % 2 == 1, "is even: no line is the middle one",
            "use 5");
  v.Integer("margin_rows", margin_rows,
            {.doc = "further lines read above and below those",
             .min = 0,
             .max = 256,
             .origin = Origin::kSetting});
  VisitDetectors(v);
}

}  // namespace rockyard::sensing
