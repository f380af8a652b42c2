// Named changes of a scenario that take one cause of failure away: what is left says how much that
// cause accounts for. Sweep files and command lines hold the names, so that these stay.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/json_value.h"
#include "scenario/scenario.h"

namespace rockyard::scenario {

struct Ablation {
  std::string_view name;
  std::string_view sentence;                   // what it does
  std::span<const std::string_view> settings;  // "PATH=VALUE", applied in order
};

// All of them, in the order of tables: the four functions of Matthies 1995 first.
std::span<const Ablation> Ablations();

// Throws core::UserError with a suggestion where there is none of that name.
const Ablation& FindAblation(std::string_view name);

// Changes a scenario's document, resolved or not (its "extends" must be), over whatever it says.
// Throws core::UserError: an unknown name.
void ApplyAblation(core::JsonValue& document, std::string_view name);

struct AblatedScenario {
  Scenario scenario;
  std::vector<std::string> idle;  // of the names, those that changed nothing in this scenario
};

// The scenario with all of these, in their order. Throws core::UserError with everything that is
// wrong: unknown names, names given twice, one whose settings another one undoes (no_avoidance and
// perfect_path_selection each choose the navigator).
AblatedScenario WithAblations(const Scenario& scenario, std::span<const std::string> names);

// Names of the ablations that would change nothing in this scenario: those in force, however they
// came to be. perfect_designation is, wherever goals are not designated with errors.
std::vector<std::string> AblationsInForce(const Scenario& scenario);

}  // namespace rockyard::scenario
