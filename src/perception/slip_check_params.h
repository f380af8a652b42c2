// Parameters of the check of slip.
#pragma once

#include "core/fields.h"

namespace rockyard::perception {

struct SlipCheckParams {
  bool enabled = false;
  double limit = 0.5;
  double sigma = 2.0;
  double min_way_m = 0.2;

  void Visit(core::FieldVisitor& v);
};

}  // namespace rockyard::perception
