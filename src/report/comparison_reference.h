// Published values from a JSON file, for `rockyard check` and the report page. Files in
// results/reference must stay readable: their members are in reference_fields.h.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/json_value.h"
#include "statistics/published_values.h"

namespace rockyard::report {

// Reads a reference in the schema of results/reference/README.md. Throws core::UserError with all
// problems and their JSON paths: unknown keys and names, missing or contradictory members, repeated
// ids, numbers out of range.
statistics::PublishedReference ParseReference(const core::JsonValue& json);

// Reads a reference from a file; what is wrong with the file itself is a core::UserError as well.
statistics::PublishedReference LoadReference(const std::filesystem::path& path);

}  // namespace rockyard::report
