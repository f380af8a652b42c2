// The tables of `rockyard terrain`: how far a blind swath gets, and how densely rocks lie along the
// course.
#pragma once

#include <cstdint>
#include <string>

#include "scenario/scenario.h"
#include "terrain/blind_swath.h"

namespace rockyard::app {

// Returns the default swath: as wide as the rover, with the rocks that, at mean shape and burial,
// reach its belly.
terrain::BlindSwath SwathOf(const scenario::Scenario& scenario);

// Returns a table of the share of swaths that are clear to some distances: by terrain/blind_swath.h
// and in `fields` fields of the scenario, with Wilson intervals (95 %). Swaths run along +x from
// the end of the start's clear zone to the beginning of the goal's. Fields follow their own overlap
// rule, and so their difference from the closed form shows what that rule does.
std::string BlindSwathText(const scenario::Scenario& scenario, std::uint64_t seed,
                           std::int64_t fields, const terrain::BlindSwath& swath);

// Returns a table by placement rule and size class: how many rock centres lie in the corridor in
// `fields` fields of the scenario, how many terrain/field.h lets expect, their ratio, and its exact
// 95 % interval (Poisson; conservative for fields of an exact count). Every placement rule is
// shown, not only the scenario's: keep_off is the negative control, which the table must show as
// off. Throws core::UserError where the corridor has no expectation.
std::string CorridorDensityText(const scenario::Scenario& scenario, std::uint64_t seed,
                                std::int64_t fields);

}  // namespace rockyard::app
