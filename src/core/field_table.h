// Lists the parameters of a struct with all that is known of them. JSON schemas, tables of
// parameters, completion on command lines, sweeps and warnings on odd settings are made of it. No
// fingerprint depends on it, but cells of sweeps do: an axis without a range takes the study range
// (scenario/sweep_axes.cc), also when a stored sweep is merged.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/fields.h"
#include "core/json_value.h"

namespace rockyard::core {

enum class FieldKind { kReal, kAngle, kInteger, kBoolean, kText, kReals, kIntegers, kChoice };

// One parameter; numbers in the unit that its JSON key names (angles in degrees).
struct ParameterInfo {
  std::string path;  // "terrain.ground.slope_deg"
  FieldKind kind = FieldKind::kReal;
  JsonValue value;   // of the struct visited: the default of a fresh struct
  std::string unit;  // from the name; "1" where it has none
  double min = 0.0;  // -infinity and infinity where unbounded
  double max = 0.0;
  Origin origin = Origin::kAssumed;
  std::string source;
  std::string doc;
  double study_low = 0.0;  // equal to study_high where there is no study range
  double study_high = 0.0;
  std::vector<std::string> choices;  // of kChoice
  std::size_t fixed_length = 0;      // of lists whose length is fixed

  bool HasStudyRange() const { return study_low < study_high; }
};

// A group of parameters, for the descriptions in schemas.
struct GroupInfo {
  std::string path;
  std::string doc;
  std::size_t first_parameter = 0;  // index of the parameter that it precedes
};

std::string_view Name(Origin origin);  // "published", "calibrated", "assumed", "setting"

// Collects the fields that a Visit lists.
class FieldTable final : public FieldVisitor {
 public:
  const std::vector<ParameterInfo>& parameters() const { return parameters_; }
  const std::vector<GroupInfo>& groups() const { return groups_; }

  void Real(std::string_view name, double& value, const FieldInfo& info) override;
  void Angle(std::string_view name, double& value_rad, const FieldInfo& info) override;
  void Integer(std::string_view name, std::int64_t& value, const FieldInfo& info) override;
  void Boolean(std::string_view name, bool& value, const FieldInfo& info) override;
  void Text(std::string_view name, std::string& value, const FieldInfo& info) override;
  void Reals(std::string_view name, std::vector<double>& values, const FieldInfo& info) override;
  void FixedReals(std::string_view name, std::span<double> values, const FieldInfo& info) override;
  void Integers(std::string_view name, std::vector<std::int64_t>& values,
                const FieldInfo& info) override;
  void Require(std::string_view name, bool holds, std::string_view reason,
               std::string_view suggestion) override;

 protected:
  void ChoiceIndex(std::string_view name, int& index, std::span<const std::string_view> names,
                   const FieldInfo& info) override;
  void BeginGroup(std::string_view name, std::string_view doc) override;
  void EndGroup() override;

 private:
  ParameterInfo& Add(std::string_view name, FieldKind kind, JsonValue value, const FieldInfo& info);

  std::string prefix_;  // path of the open group, with a trailing dot unless empty
  std::vector<ParameterInfo> parameters_;
  std::vector<GroupInfo> groups_;
};

// Returns a schema with one property per field with description, bounds, default, and the
// annotations "x-unit", "x-origin", "x-source" and "x-study-range" where they are known. Unknown
// keys are not allowed ("additionalProperties": false). Conditions across fields have no place in a
// schema: the reader checks them. `table` must have visited default values.
JsonValue MakeSchema(const FieldTable& table, std::string_view title);

}  // namespace rockyard::core
