// Words that only a look at files or settings can offer to the completion of a shell.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rockyard::app {

// The words of a kind that begin with what has been typed, for "KIND:TYPED":
//   settings    paths of a scenario with "=" behind, and where one has been typed, "PATH=VALUE" for
//               each value of an enumeration or a boolean
//   scenarios, sweeps, rovers   names (scenario_names.h)
//   runs        folders in results/runs
// None of any other kind. Cost: 30 ms for the scenarios of the project.
std::vector<std::string> LookUp(std::string_view asked);

// The kinds that fit what a command takes by the name "SCENARIO_OR_RUN".
std::vector<std::string> LookupKinds(std::string_view positional);

}  // namespace rockyard::app
