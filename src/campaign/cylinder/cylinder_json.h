// cylinder.json, which `rockyard cylinder --json` prints.
#pragma once

#include "campaign/cylinder/cylinder_request.h"
#include "core/json_value.h"

namespace rockyard::campaign {

core::JsonValue CylinderJson(const CylinderRequest& request, const CylinderResult& result);

}  // namespace rockyard::campaign
