// Values of a scenario that hardly suit each other. Runs, sweeps and their dry runs warn of them
// before they begin, and `validate` tells them.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/error.h"
#include "scenario/scenario.h"
#include "scenario/sweep.h"

namespace rockyard::campaign {

// Returns what is doubtful in a scenario, each with the path of the value, what of it is doubtful,
// and what would be right. Doubts warn: they refuse nothing and change no record. Only what the
// scenario comes to counts, not who stated what: equal resolved scenarios have equal doubts.
//
// These rules of drives are held here: limits against the course, mass and goal radius against the
// size of the rover, the odometer's scale against the slip of the wheels on their soil, and gravity
// and sand of Earth against a name that says Mars. Rules that ask settings of each other are in
// doubts/setting_doubts.h.
//
// A doubt is left out where the scenario's `accepted` holds its "path: reason" (WhatOf) to the
// letter. Must stay: path and reason of every doubt, the form of its numbers included. Scenario
// files quote them, and a doubt that is worded anew, or has other numbers, comes back.
std::vector<core::Problem> Doubts(const scenario::Scenario& scenario);

// Returns the doubts of a scenario file, or of the run in a folder, with "PATH=VALUE" overrides;
// absent keys keep the values of `defaults`.
// Throws core::UserError.
std::vector<core::Problem> DoubtsOf(const std::filesystem::path& source,
                                    std::span<const std::string> overrides,
                                    const scenario::Scenario& defaults = {});

// Returns the doubts of the cells of a sweep, each cell as it is run. Doubts of one path are told
// as one: that of the first cell, and how many more there are.
std::vector<core::Problem> DoubtsOf(const scenario::Sweep& sweep);

// Returns "path: reason; what would be right", for people.
std::string TextOf(const core::Problem& doubt);

}  // namespace rockyard::campaign
