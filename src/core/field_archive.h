// Reader and writer of parameter structs: from JSON, with all that is wrong with it, and to JSON.
// Others include core/archive.h.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/fields.h"
#include "core/json_value.h"

namespace rockyard::core {

// Reads a JSON object into a parameter struct. Missing keys leave their field as it is. Problems
// are wrong types, values out of bounds, unknown names and keys (with the nearest right one), lists
// of a wrong length, and conditions that do not hold. A condition is judged only where all fields
// of its group could be read, since it would otherwise complain about a default. A field with a
// problem keeps its value. The names that a Visit passes must outlive the reader (they are
// literals).
class FieldReader final : public FieldVisitor {
 public:
  // `root` must outlive the reader. `others` are keys of the root that another reader takes.
  explicit FieldReader(const JsonValue& root, std::initializer_list<std::string_view> others = {});

  // Call after visiting: looks for unknown keys at the root. Throws UserError with all problems, if
  // there are any; at most 100 are listed.
  void Finish();

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
  struct Level {
    const JsonValue* object;             // nullptr where the input has no such group
    std::string path;                    // with a trailing dot unless empty
    std::vector<std::string_view> keys;  // visited so far
    std::size_t problems_before = 0;
  };

  // Returns the input of a field, or nullptr where it is missing; notes the key as visited.
  const JsonValue* Take(std::string_view name);
  std::string Path(std::string_view name) const;
  void Add(std::string path, std::string reason, std::string suggestion);
  void AddWrongType(const std::string& path, std::string_view wanted, const JsonValue& value);
  void CheckUnknownKeys();
  // Returns true where `value` is a number within bounds, which then is in `out`.
  bool ReadReal(const std::string& path, const JsonValue& value, const FieldInfo& info,
                double& out);
  bool ReadInteger(const std::string& path, const JsonValue& value, const FieldInfo& info,
                   std::int64_t& out);
  bool CheckBounds(const std::string& path, const JsonValue& value, const FieldInfo& info);
  // Returns the elements of a list of numbers; nothing where it is missing or wrong.
  template <typename Element>
  std::optional<std::vector<Element>> ReadElements(std::string_view name, const FieldInfo& info);

  std::vector<Level> levels_;
  std::vector<Problem> problems_;
  std::size_t problem_count_ = 0;  // including those beyond the list
};

// Writes a parameter struct to a JSON object: every field in visiting order, angles in degrees
// chosen so that they read back to the same bits (ExactDegrees). Fingerprints of scenarios depend
// on order and digits (scenario/load.h). Values must be finite.
class FieldWriter final : public FieldVisitor {
 public:
  FieldWriter();

  // Returns the object written; call once, after visiting.
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
  // Does nothing: conditions are the reader's business.
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
