// Completion for fish.
#pragma once

#include <string>
#include <vector>

#include "app/completion_offers.h"

namespace rockyard::app {

// The script (completion_script.h) for these subcommands.
std::string FishCompletion(const std::vector<CommandOffer>& commands);

}  // namespace rockyard::app
