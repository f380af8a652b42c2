// What a plugin or a navigator's process says of itself, and its parameters as a scenario has them.
// Libraries and processes describe themselves in the same JSON (docs/navigators.md); the two hosts
// read it here. Nothing here runs a plugin.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/fields.h"
#include "core/json_value.h"
#include "messages/navigation_view.h"
#include "navigation/navigator_traits_params.h"

namespace rockyard::plugin {

enum class FieldType {
  kReal,
  kAngle,
  kInteger,
  kBoolean,
  kText,
  kReals,
  kFixedReals,
  kIntegers,
  kChoice,
  kGroup,
};

// The value of one parameter. Which member counts follows from its type.
struct FieldValue {
  double real = 0.0;         // kReal; kAngle, rad
  std::int64_t integer = 0;  // kInteger
  bool boolean = false;
  int choice = 0;  // place among the choices
  std::string text;
  std::vector<double> reals;  // kReals, kFixedReals
  std::vector<std::int64_t> integers;
};

// One parameter, or a group of them, as it was declared.
struct Field {
  FieldType type = FieldType::kReal;
  std::string name;
  std::string doc;
  std::string source;
  core::FieldInfo info;  // its texts are views of the two above; in units of JSON
  std::vector<std::string> choices;
  std::vector<std::string_view> choice_views;  // of `choices`
  FieldValue value;                            // the default
  std::vector<std::unique_ptr<Field>> fields;  // of a group

  Field() = default;
  Field(const Field&) = delete;  // views would dangle
  Field& operator=(const Field&) = delete;
  Field(Field&&) = delete;
  Field& operator=(Field&&) = delete;
};

// What a navigator, an estimator or a reader says of itself.
struct Description {
  std::string name;  // by which a scenario chooses it, and of its parameters
  std::string doc;
  std::string version;  // of a process; "" of a library, whose file is its identity
  std::vector<std::unique_ptr<Field>> fields;
  std::vector<messages::OwnValue> own_values;
  bool takes_fixes = false;  // of an estimator, as the next
  bool takes_motions = false;
};

// Reads the answer to "describe". `source` names the plugin in messages. Throws core::UserError
// with what is wrong.
std::unique_ptr<const Description> ReadDescription(const core::JsonValue& answer,
                                                   const std::string& source);

// What a trial has to know of a navigator with certain parameters.
struct Traits {
  navigation::LookReading reads = navigation::LookReading::kNothing;
  navigation::DecisionCost cost = navigation::CostOfLook{};
  std::string goal_parameter;
  double goal_tolerance_m = 0.0;
  bool looks_on_the_move = false;
  bool steers_on_the_move = false;
  bool images = false;
  std::vector<core::Problem> problems;  // of its parameters; paths within its group

  // The views in it last as long as this object.
  navigation::NavigatorTraits AsNavigatorTraits() const;
};

// Reads the answer to "traits". Throws as ReadDescription.
Traits ReadTraits(const core::JsonValue& answer, const std::string& source);

// What is wrong with parameters; paths within their group.
using Problems = std::vector<core::Problem>;

// Reads the member "problems" of an answer. Throws as ReadDescription.
Problems ReadProblems(const core::JsonValue& answer, const std::string& source);

// The values of all parameters of a description. A value; the description outlives it.
class Parameters {
 public:
  explicit Parameters(const Description& description);

  // Lists them, each with its value.
  void Visit(core::FieldVisitor& v);

  // Return all values: in the order in which they were declared; as the JSON that a process gets.
  const std::vector<FieldValue>& values() const { return values_; }
  core::JsonValue ToJson() const;

 private:
  const Description* description_;
  std::vector<FieldValue> values_;  // groups have none
};

}  // namespace rockyard::plugin
