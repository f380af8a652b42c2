#include "core/field_table.h"

#include <array>
#include <utility>

#include "core/check.h"
#include "core/units.h"

namespace rockyard::core {
std::string_view Name(Origin origin) {
  constexpr std::array<std::string_view, 4> kNames = {"published", "calibrated", "assumed",
                                                      "setting"};
  return kNames[static_cast<std::size_t>(origin)];
}

ParameterInfo& FieldTable::Add(std::string_view name, FieldKind kind, JsonValue value,
                               const FieldInfo& info) {
  ParameterInfo parameter;
  parameter.path = prefix_ + std::string(name);
  parameter.kind = kind;
  parameter.value = std::move(value);
  parameter.unit = UnitOf(name);
  parameter.min = info.min;
  parameter.max = info.max;
  parameter.origin = info.origin;
  parameter.source = info.source;
  parameter.doc = info.doc;
  parameter.study_low = info.study_low;
  parameter.study_high = info.study_high;
  parameters_.push_back(std::move(parameter));
  return parameters_.back();
}

void FieldTable::Real(std::string_view name, double& value, const FieldInfo& info) {
  Add(name, FieldKind::kReal, JsonValue(value), info);
}

void FieldTable::Angle(std::string_view name, double& value_rad, const FieldInfo& info) {
  Add(name, FieldKind::kAngle, JsonValue(ExactDegrees(value_rad)), info);
}

void FieldTable::Integer(std::string_view name, std::int64_t& value, const FieldInfo& info) {
  Add(name, FieldKind::kInteger, JsonValue(value), info);
}

void FieldTable::Boolean(std::string_view name, bool& value, const FieldInfo& info) {
  Add(name, FieldKind::kBoolean, JsonValue(value), info);
}

void FieldTable::Text(std::string_view name, std::string& value, const FieldInfo& info) {
  Add(name, FieldKind::kText, JsonValue(value), info);
}

void FieldTable::Reals(std::string_view name, std::vector<double>& values, const FieldInfo& info) {
  Add(name, FieldKind::kReals, ListOf(values), info);
}

void FieldTable::FixedReals(std::string_view name, std::span<double> values,
                            const FieldInfo& info) {
  Add(name, FieldKind::kReals, ListOf(values), info).fixed_length = values.size();
}

void FieldTable::Integers(std::string_view name, std::vector<std::int64_t>& values,
                          const FieldInfo& info) {
  Add(name, FieldKind::kIntegers, ListOf(values), info);
}

void FieldTable::Require(std::string_view, bool, std::string_view, std::string_view) {}

void FieldTable::ChoiceIndex(std::string_view name, int& index,
                             std::span<const std::string_view> names, const FieldInfo& info) {
  EXPECT(index >= 0 && static_cast<std::size_t>(index) < names.size());
  ParameterInfo& parameter =
      Add(name, FieldKind::kChoice, JsonValue(names[static_cast<std::size_t>(index)]), info);
  parameter.choices.assign(names.begin(), names.end());
}

void FieldTable::BeginGroup(std::string_view name, std::string_view doc) {
  prefix_ += name;
  groups_.push_back({prefix_, std::string(doc), parameters_.size()});
  prefix_ += '.';
}

void FieldTable::EndGroup() {
  prefix_.pop_back();
  const std::size_t dot = prefix_.rfind('.');
  prefix_.resize(dot == std::string::npos ? 0 : dot + 1);
}

}  // namespace rockyard::core
