// Keys that had another name in earlier versions: files and settings with the former names go on
// working, and stored scenarios are compared by the names of today. Who renames a key of a group of
// the top level adds it.
#pragma once

#include <string>
#include <string_view>

#include "core/json_value.h"

namespace rockyard::scenario {

// The name of today: "localization.estimator" for "sensors.localization"; any other path is
// returned as it is.
std::string_view CurrentPath(std::string_view path);

// Moves the values of former keys to where they stand today. Throws core::UserError where both are
// there with different values.
void RenameFormerKeys(core::JsonValue& document);

// Applies "PATH=VALUE" to a document, either of which may have former keys; what is assigned
// counts.
void Override(core::JsonValue& document, std::string_view assignment);

}  // namespace rockyard::scenario
