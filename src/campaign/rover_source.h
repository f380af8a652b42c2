// The rover that the commands `rover` and `mobility` are asked for: of a scenario, of a rover file,
// or of a URDF file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/json_value.h"
#include "rover/rover_params.h"
#include "rover/urdf_reader/urdf_reader.h"
#include "terrain/soil_params.h"

namespace rockyard::campaign {

struct RoverSource {
  std::string name;  // of the scenario, or of the file without its extension
  rover::RoverParams params;
  // What a rover file has to say of it: all parameters of a scenario's or rover file's; of a URDF
  // file those that the file or --set tells.
  core::JsonValue group;
  std::optional<rover::UrdfReading> reading;  // of a URDF file
  terrain::SoilParams soil = {};              // of the scenario; what --set says of it alone
};

// Returns the rover that `word` means (ScenarioFile), with "PATH=VALUE" overrides applied. A rover
// file, or what a URDF file tells, is read as the group `rover` of a scenario that is otherwise the
// default one. A file that begins with "<" is a URDF file. Throws core::UserError with all that is
// wrong; of a URDF file with the place that a value came from.
RoverSource LoadRover(const std::string& word, const std::vector<std::string>& overrides);

// Returns what of a URDF file is not taken, and which parameters keep their defaults, for people.
std::string LeftOutText(const RoverSource& source);

}  // namespace rockyard::campaign
