// Keys that had another name in earlier versions. Whoever reads or changes a scenario's document
// renames them, so that files and settings with the former names go on working, and stored
// scenarios are compared by the names of today. An entry must stay as long as such files and stores
// are read; no fingerprint of a stored scenario changes by it. Who renames a key of a group of the
// top level adds it here.
#pragma once

#include <string>
#include <string_view>

#include "core/json_value.h"

namespace rockyard::scenario {

// Returns the name of today: "localization.estimator" for "sensors.localization". Any other path is
// returned as it is.
std::string_view CurrentPath(std::string_view path);

// Moves the values of former keys to where they stand today. Throws core::UserError where both are
// there with different values.
void RenameFormerKeys(core::JsonValue& document);

// Applies "PATH=VALUE" to a document. Both may have former keys. The assigned value counts.
void Override(core::JsonValue& document, std::string_view assignment);

}  // namespace rockyard::scenario
