// Scenario files: loading, overriding, writing, describing. Commands and campaigns load scenarios
// by it, sweeps resolve their cells, and `api` gives other programs the same.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/field_table.h"
#include "core/json_value.h"
#include "scenario/scenario.h"
#include "trial/open_values_params.h"

namespace rockyard::scenario {

// Returns the scenario in a JSON file, any object of which may extend another file (see
// core::LoadJsonFile), with "PATH=VALUE" overrides applied in order. Keys that are absent keep
// their defaults: a program with navigators of its own adds them to those of `defaults`. Throws
// core::UserError with everything that is wrong.
Scenario LoadScenario(const std::filesystem::path& path,
                      std::span<const std::string> overrides = {}, const Scenario& defaults = {});

// Returns the same from text; "extends" is relative to `folder`.
Scenario ParseScenario(std::string_view text, std::span<const std::string> overrides = {},
                       const std::filesystem::path& folder = ".", const Scenario& defaults = {});

// Returns the sets of a scenario that plugins add to; they last as long as the scenario.
plugin::PluginSets PluginSetsOf(Scenario& scenario);

// Makes the paths of plugins in a document absolute, as they are relative to `folder`.
void AnchorPlugins(core::JsonValue& document, const std::filesystem::path& folder);

// Returns the same from a document whose "extends" are resolved, for designs and sweeps that change
// members by core::SetPath. Plugins that the document names are opened; those of `defaults` are not
// opened again.
Scenario ReadScenario(const core::JsonValue& document, const Scenario& defaults = {});

// Returns the same without opening plugins: to show, list and compare what was run, by whoever.
// What it returns cannot drive where a plugin decides. Throws as ReadScenario, also where the
// conditions of a scenario need to know its navigator.
Scenario ReadScenarioSealed(const core::JsonValue& document, const Scenario& defaults = {});

// Return every effective value, as a scenario file that reads back to the same scenario, bit for
// bit.
core::JsonValue WriteScenario(const Scenario& scenario);
std::string ResolvedJson(const Scenario& scenario);

// Members that do not decide the record of a trial of given index. Sweeps look for equal cells
// without these and without the seed (Duplicates in sweep.cc).
inline constexpr std::array<std::string_view, 4> kNoInfluence = {"name", "description", "accepted",
                                                                 "trials"};

// Returns a hash of all members but kNoInfluence, as ResolvedJson writes them; plugins enter by
// their hashes alone, wherever their files lie. Stored runs go on
// only where it is the same: a key that is added, renamed or moved changes it for every scenario,
// also where no record changes.
std::uint64_t Fingerprint(const Scenario& scenario);
// Returns the fingerprint of the document that ResolvedJson writes. A stored run whose scenario
// does not give its fingerprint counts as damaged. Must stay: the text of core::DumpJson, and
// core::Hasher.
std::uint64_t ResolvedFingerprint(core::JsonValue resolved);

// Returns the JSON Schema (draft 2020-12) of scenario files, with "extends" in every group.
std::string SchemaJson(const Scenario& scenario = {});

// Returns ResolvedJson of a default scenario.
std::string DefaultsJson();

// Returns every parameter of the scenario with its value, bounds, origin, source and study range.
std::vector<core::ParameterInfo> ListParameters(const Scenario& scenario = {});

// Open values follow other values where a scenario leaves them open (trial/open_values_params.h).
// Returns those that the document does not state, or states as null, and takes the nulls out of the
// document.
std::vector<trial::OpenValue> TakeOpenValues(core::JsonValue& document);

// Sets open values to what suits the scenario.
void SetOpenValues(const std::vector<trial::OpenValue>& open, Scenario& scenario);

// Lets the schema of scenarios have null for open values.
void AllowOpenValues(core::JsonValue& schema);

}  // namespace rockyard::scenario
