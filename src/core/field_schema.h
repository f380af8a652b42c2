// JSON Schema (draft 2020-12) of a parameter struct.
#pragma once

#include <string_view>

#include "core/field_table.h"
#include "core/json_value.h"

namespace rockyard::core {

// One property per field with description, bounds, default, and the annotations "x-unit",
// "x-origin", "x-source" and "x-study-range" where they are known. Unknown keys are not allowed
// ("additionalProperties": false). Conditions across fields have no place in a schema: the reader
// checks them. `table` must have visited default values.
JsonValue MakeSchema(const FieldTable& table, std::string_view title);

}  // namespace rockyard::core
