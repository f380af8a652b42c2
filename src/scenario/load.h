// Scenario files: loading, overriding, writing, describing.
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

// The scenario in a JSON file, any object of which may extend another file (see
// core::LoadJsonFile), with "PATH=VALUE" overrides applied in order. Keys that are absent keep
// their defaults: a program with navigators of its own adds them to those of `defaults`. Throws
// core::UserError with everything that is wrong.
Scenario LoadScenario(const std::filesystem::path& path,
                      std::span<const std::string> overrides = {}, const Scenario& defaults = {});

// The same from text; "extends" is relative to `folder`.
Scenario ParseScenario(std::string_view text, std::span<const std::string> overrides = {},
                       const std::filesystem::path& folder = ".", const Scenario& defaults = {});

// The same from a value, for designs and sweeps that change members by core::SetPath.
Scenario ReadScenario(const core::JsonValue& document, const Scenario& defaults = {});

// Every effective value, as a scenario file that reads back to the same scenario, bit for bit.
core::JsonValue WriteScenario(const Scenario& scenario);
std::string ResolvedJson(const Scenario& scenario);

// Members that do not decide the record of a trial of given index.
inline constexpr std::array<std::string_view, 4> kNoInfluence = {"name", "description", "accepted",
                                                                 "trials"};

// Hash of all others, as ResolvedJson writes them. Stored runs go on only where it is the same: a
// key that is added, renamed or moved changes it for every scenario, also where no record changes.
std::uint64_t Fingerprint(const Scenario& scenario);
// The same of ResolvedJson, read. A stored run whose scenario does not give its fingerprint counts
// as damaged: neither the text of core::DumpJson nor core::Hasher may change.
std::uint64_t ResolvedFingerprint(core::JsonValue resolved);

// JSON Schema (draft 2020-12) of scenario files; "extends" included in every group.
std::string SchemaJson();

// ResolvedJson of a default scenario.
std::string DefaultsJson();

// Every parameter of the scenario with its value, bounds, origin, source and study range.
std::vector<core::ParameterInfo> ListParameters(const Scenario& scenario = {});

// Values that follow others where a scenario leaves them open (trial/open_values_params.h).

// Those that the document does not state, or states as null, which is taken out of it.
std::vector<trial::OpenValue> TakeOpenValues(core::JsonValue& document);

// Sets them to what suits the scenario.
void SetOpenValues(const std::vector<trial::OpenValue>& open, Scenario& scenario);

// Lets the schema of scenarios have null for them.
void AllowOpenValues(core::JsonValue& schema);

}  // namespace rockyard::scenario
