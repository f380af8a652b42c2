// Named changes of a scenario that take one cause of failure away: what is left says how much that
// cause accounts for. `run --ablate` and axes of sweeps apply them, `list --ablations` tells them.
// Must stay: the names, as sweep files and command lines hold them. The settings decide the records
// of ablated runs, and which ablations count as in force in runs that are stored.
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

// Returns all ablations, in the order of tables: the four functions of Matthies 1995 first.
std::span<const Ablation> Ablations();

// Returns the ablation of that name. Throws core::UserError with a suggestion where there is none.
const Ablation& FindAblation(std::string_view name);

// Applies an ablation to a scenario's document, over whatever the document says. The document may
// be resolved or not; its "extends" must be. Throws core::UserError for an unknown name.
void ApplyAblation(core::JsonValue& document, std::string_view name);

struct AblatedScenario {
  Scenario scenario;
  std::vector<std::string> idle;  // names that would change nothing in the scenario as given
};

// Returns the scenario with all of these ablations, in their order. Throws core::UserError with
// everything that is wrong: unknown names, names given twice, one whose settings another one undoes
// (no_avoidance and perfect_path_selection each choose the navigator).
AblatedScenario WithAblations(const Scenario& scenario, std::span<const std::string> names);

// Returns the names of the ablations that are in force, however they came to be: they would change
// nothing in this scenario. perfect_designation is in force wherever goals are not designated with
// errors.
std::vector<std::string> AblationsInForce(const Scenario& scenario);

}  // namespace rockyard::scenario
