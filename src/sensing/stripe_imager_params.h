// The imager of the light stripe sensor, and what of its images is read.
#pragma once

#include <cstdint>

#include "core/fields.h"
#include "rendering/imager_params.h"

namespace rockyard::sensing {

struct StripeImagerParams : rendering::ImagerParams {
  std::int64_t averaging_rows = 5;
  std::int64_t margin_rows = 0;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::sensing
