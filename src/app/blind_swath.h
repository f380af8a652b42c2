// rockyard terrain --blind-swath: how far a straight blind swath gets, by closed form and by
// fields.
#pragma once

#include <cstdint>
#include <string>

#include "scenario/scenario.h"
#include "terrain/blind_swath.h"

namespace rockyard::app {

// A table of the share of swaths that are clear to some distances: by terrain/blind_swath.h and in
// `fields` fields of the scenario, with Wilson intervals (95 %). Swaths run along +x from the
// start, behind its clear zone, as far as the zone before the goal. The field's own overlap rule
// holds, and so the difference from the closed form shows what that rule does.
std::string BlindSwathText(const scenario::Scenario& scenario, std::uint64_t seed,
                           std::int64_t fields, const terrain::BlindSwath& swath);

// The rover's width, and rocks of mean shape that reach its belly.
terrain::BlindSwath SwathOf(const scenario::Scenario& scenario);

}  // namespace rockyard::app
