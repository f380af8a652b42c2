#include "core/field_writer.h"

#include <string>
#include <utility>

#include "core/check.h"
#include "core/units.h"

namespace rockyard::core {
FieldWriter::FieldWriter() { levels_.push_back({"", JsonValue::Object()}); }

JsonValue FieldWriter::Take() {
  EXPECT(levels_.size() == 1);
  return std::move(levels_.back().object);
}

void FieldWriter::Add(std::string_view name, JsonValue value) {
  EXPECT(levels_.back().object.Find(name) == nullptr);
  levels_.back().object.Append(std::string(name), std::move(value));
}

void FieldWriter::Real(std::string_view name, double& value, const FieldInfo&) {
  Add(name, JsonValue(value));
}

void FieldWriter::Angle(std::string_view name, double& value_rad, const FieldInfo&) {
  Add(name, JsonValue(ExactDegrees(value_rad)));
}

void FieldWriter::Integer(std::string_view name, std::int64_t& value, const FieldInfo&) {
  Add(name, JsonValue(value));
}

void FieldWriter::Boolean(std::string_view name, bool& value, const FieldInfo&) {
  Add(name, JsonValue(value));
}

void FieldWriter::Text(std::string_view name, std::string& value, const FieldInfo&) {
  Add(name, JsonValue(value));
}

void FieldWriter::Reals(std::string_view name, std::vector<double>& values, const FieldInfo&) {
  Add(name, ListOf(values));
}

void FieldWriter::FixedReals(std::string_view name, std::span<double> values, const FieldInfo&) {
  Add(name, ListOf(values));
}

void FieldWriter::Integers(std::string_view name, std::vector<std::int64_t>& values,
                           const FieldInfo&) {
  Add(name, ListOf(values));
}

void FieldWriter::Require(std::string_view, bool, std::string_view, std::string_view) {}

void FieldWriter::ChoiceIndex(std::string_view name, int& index,
                              std::span<const std::string_view> names, const FieldInfo&) {
  EXPECT(index >= 0 && static_cast<std::size_t>(index) < names.size());
  Add(name, JsonValue(names[static_cast<std::size_t>(index)]));
}

void FieldWriter::BeginGroup(std::string_view name, std::string_view) {
  levels_.push_back({name, JsonValue::Object()});
}

void FieldWriter::EndGroup() {
  Level level = std::move(levels_.back());
  levels_.pop_back();
  Add(level.name, std::move(level.object));
}

}  // namespace rockyard::core
