// The files of `rockyard mobility`: a sheet of charts, tables, and all of it as one JSON object.
#pragma once

#include <vector>

#include "campaign/mobility/mobility.h"
#include "campaign/output_folder.h"
#include "core/json_value.h"

namespace rockyard::campaign {

// Returns the file mobility.json, described in src/campaign/README.md. Programs read it (--json).
// Must stay: its members; others may only be added.
core::JsonValue MobilityJson(const MobilityRequest& request, const MobilityResult& result,
                             const std::vector<OutputFile>& files);

// The folder of the command, claimed before the work. Throws as OutputFolder does.
OutputPlan MobilityPlan(const MobilityRequest& request);

// Fills the folder: mobility.svg, slopes.csv, wheel.csv, limits.csv, mobility.json.
void WriteMobility(const MobilityRequest& request, const MobilityResult& result,
                   OutputFolder& folder);

}  // namespace rockyard::campaign
