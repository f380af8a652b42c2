// The course of one trial as a file for Foxglove, Lichtblick and other readers of MCAP: that of
// `trace --mcap` and of --traces with --trace-format mcap.
#pragma once

#include <string>

#include "replay/data.h"

namespace rockyard::replay {

// Returns an MCAP file with the topics that README.md of this folder lists. Must stay: topics and
// schemas, which layouts of players name. Title, command and repeats_stored of the data are not in
// it, so that it does not matter which command writes it: the same trial of the same build gives
// the same bytes, except for what the provenance says of the machine.
std::string TraceMcap(const ReplayData& data);

}  // namespace rockyard::replay
