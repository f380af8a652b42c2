// Writes parameter structs to a JSON object.
#pragma once

#include <string_view>
#include <vector>

#include "core/fields.h"
#include "core/json_value.h"

namespace rockyard::core {

// Every field in visiting order, angles in degrees chosen so that they read back to the same bits
// (see ExactDegrees). Values must be finite.
class FieldWriter final : public FieldVisitor {
 public:
  FieldWriter();

  // The object written; call once, after visiting.
  JsonValue Take();

  void Real(std::string_view name, double& value, const FieldInfo& info) override;
  void Angle(std::string_view name, double& value_rad, const FieldInfo& info) override;
  void Integer(std::string_view name, std::int64_t& value, const FieldInfo& info) override;
  void Boolean(std::string_view name, bool& value, const FieldInfo& info) override;
  void Text(std::string_view name, std::string& value, const FieldInfo& info) override;
  void Reals(std::string_view name, std::vector<double>& values, const FieldInfo& info) override;
  void FixedReals(std::string_view name, std::span<double> values, const FieldInfo& info) override;
  void Integers(std::string_view name, std::vector<std::int64_t>& values,
                const FieldInfo& info) override;
  // Conditions are the reader's business.
  void Require(std::string_view name, bool holds, std::string_view reason,
               std::string_view suggestion) override;

 protected:
  void ChoiceIndex(std::string_view name, int& index, std::span<const std::string_view> names,
                   const FieldInfo& info) override;
  void BeginGroup(std::string_view name, std::string_view doc) override;
  void EndGroup() override;

 private:
  // The objects that are open, outermost first; each but the first with the key it will get.
  struct Level {
    std::string_view name;
    JsonValue object;
  };
  void Add(std::string_view name, JsonValue value);

  std::vector<Level> levels_;
};

}  // namespace rockyard::core
