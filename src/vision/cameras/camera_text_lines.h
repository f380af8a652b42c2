// Lines of a camera's text, sorted into the fields of camera_fields.h.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/json_value.h"

namespace rockyard::vision {

// The fields of one camera as the JSON that camera_fields.h describes, and the lines they stand in.
struct CameraBlock {
  std::string camera;  // left or right; empty where the text says neither
  int line = 1;        // where it begins
  core::JsonValue fields = core::JsonValue::Object();
  std::map<std::string, int, std::less<>> lines;  // by the field's name
};

struct CameraBlocks {
  std::vector<CameraBlock> blocks;
  std::vector<core::Problem> problems;  // of lines; the first 20
};

// What a text holds. A new block begins with each line `Camera = NAME`, the first three only.
CameraBlocks SortLines(std::string_view text, std::string_view source_name);

}  // namespace rockyard::vision
