// What a drive is set up of, in words.
#pragma once

#include <string>
#include <vector>

#include "scenario/scenario.h"

namespace rockyard::campaign {

// Two lines: rover, gravity, soil and fidelity; by what it looks, drives and localizes. None of an
// experiment that does not drive.
std::vector<std::string> SetupInWords(const scenario::Scenario& scenario);

}  // namespace rockyard::campaign
