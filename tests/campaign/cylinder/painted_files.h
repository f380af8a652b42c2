// A painted pair of the coloured cylinder as files.
#pragma once

#include <filesystem>

#include "campaign/cylinder/find_cylinder.h"

namespace rockyard::campaign {

// Writes left.png, right.png and cameras.json of a cylinder 2 m away at 30 deg into the folder.
CylinderRequest WritePaintedPair(const std::filesystem::path& folder);

}  // namespace rockyard::campaign
