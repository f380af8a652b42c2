// rockyard terrain --density: rocks in the corridor of the course against the law.
#pragma once

#include <cstdint>
#include <string>

#include "scenario/scenario.h"

namespace rockyard::app {

// A table by placement rule and size class: centres in the corridor of `fields` fields of the
// scenario, what terrain/corridor.h lets expect, their ratio, and its exact 95 % interval (Poisson;
// conservative for exact counts). Every placement rule is shown, not only the scenario's: keep_off
// is the negative control, which the table must show as off. Throws core::UserError where the
// corridor has no expectation.
std::string CorridorDensityText(const scenario::Scenario& scenario, std::uint64_t seed,
                                std::int64_t fields);

}  // namespace rockyard::app
