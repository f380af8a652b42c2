// Values that a scenario takes from elsewhere, and that hardly suit what it says itself.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "campaign/scenario_layers.h"
#include "core/error.h"
#include "scenario/scenario.h"
#include "scenario/sweep.h"

namespace rockyard::campaign {

// Each with the path of the value, what of it is doubtful, and what would be right. Doubted is what
// lies below that against which it is held (or is a default): whoever stated it did not know the
// course, or the rover. Rules, each with its threshold in the .cc file: limits of referee and
// batteries against the length of the course, mass against size, the odometer's scale and
// the size that GESTALT believes in against the rover,
// goal radius and the view of the
// terrain sensor against the rover, gravity and sand of Earth against a name that says
// Mars.
std::vector<core::Problem> Doubts(const scenario::Scenario& scenario, const Layers& layers);

// Of a scenario file with overrides; none of the folder of a run. Throws core::UserError.
std::vector<core::Problem> DoubtsOf(const std::filesystem::path& source,
                                    std::span<const std::string> overrides);

// Of the cells of a sweep, each laid over its base: one that several have is told of the first.
std::vector<core::Problem> DoubtsOf(const scenario::Sweep& sweep);

// "path: what; what would be right".
std::string TextOf(const core::Problem& doubt);

}  // namespace rockyard::campaign
