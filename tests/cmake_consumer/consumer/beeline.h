// A navigator that rockyard does not know.
#pragma once

#include "core/fields.h"
#include "navigation/navigator_set_params.h"

struct BeelineParams {
  double tolerance_m = 0.1;

  void Visit(rockyard::core::FieldVisitor& v);
};

rockyard::navigation::NavigatorDescription<BeelineParams> DescribeBeeline();
