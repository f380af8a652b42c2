// Values of a scenario that hardly suit each other.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "scenario/scenario.h"
#include "scenario/sweep.h"

namespace rockyard::campaign {

// Each with the path of the value, what of it is doubtful, and what would be right. Only what the
// scenario comes to counts, not who stated what: equal fingerprints, equal doubts. Of limits
// against the course, mass and goal against size, the odometer's scale against the slip of these
// wheels in this soil, gravity and sand of Earth against a name that says Mars; and of what
// settings say of each other (doubts/setting_doubts.h). None that the scenario calls accepted, word
// by word: of other numbers it is another doubt, and so is one whose path or reason is worded anew.
// Doubts warn: they refuse nothing and change no record.
std::vector<core::Problem> Doubts(const scenario::Scenario& scenario);

// Of a scenario file, or the folder of a run, with overrides. Throws core::UserError.
std::vector<core::Problem> DoubtsOf(const std::filesystem::path& source,
                                    std::span<const std::string> overrides);

// Of the cells of a sweep, each laid over its base: one that several have is told of the first.
std::vector<core::Problem> DoubtsOf(const scenario::Sweep& sweep);

// "path: what; what would be right".
std::string TextOf(const core::Problem& doubt);

}  // namespace rockyard::campaign
