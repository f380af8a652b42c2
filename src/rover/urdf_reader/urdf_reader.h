// A rover from the URDF file of somebody else, the other way of rover/urdf.h. The command `rover`
// writes what is read as a rover file, from which scenarios take it. No record depends on it.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/field_table.h"
#include "core/json_value.h"
#include "rover/rover_params.h"
#include "rover/urdf_reader/urdf_xml.h"

namespace rockyard::rover {

// What a URDF file says of a rover, and what it does not.
struct UrdfReading {
  std::string robot;     // its name; may be empty
  RoverParams params{};  // what the file tells, and defaults
  // What the file tells alone, as a rover file: the group `rover` of a scenario.
  core::JsonValue group;
  // The parameters of which the file tells nothing, with the defaults that they keep, in the order
  // of RoverParams. With `group` these are all parameters of a rover.
  std::vector<core::ParameterInfo> left_out;
  // What the file tells and rockyard's rover has not: the place in the file, and what counts in its
  // stead.
  std::vector<core::Problem> not_taken;
  // Where the file tells each parameter of `group`: `line 12: joint "left_rocker"`.
  std::map<std::string, std::string> places;

  // Returns problems of parameters, such as "rover.geometry.width_m", with the place in the file
  // from which the value came added to the reason.
  std::vector<core::Problem> WithPlaces(std::vector<core::Problem> problems) const;
};

// Reads the text of a URDF file. The rover is found by its joints and shapes, whatever they are
// called (urdf_skeleton.h): six wheels on rockers and bogies, in a frame with x ahead, y left and z
// up at the root of the tree; links beyond those count with what carries them. Lengths come back as
// the decimals that somebody wrote, free of the rounding of sums. Throws core::UserError with all
// that is wrong, each with line and element: what is no URDF (urdf_model.h), and robots of another
// build (urdf_skeleton.h). Values are not held against the bounds of RoverParams: the caller may
// change them first.
UrdfReading ReadUrdf(std::string_view text, std::string_view source_name);

}  // namespace rockyard::rover
