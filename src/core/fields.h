/// @file
/// One visitor for every parameter struct: reading, writing, checking, defaults, schema and tables.
///
/// A parameter struct lists its members once:
///
///   struct GyroParams {
///     double scale = 0.94;
///     double noise_rad = 0.0;
///     void Visit(core::FieldVisitor& v) {
///       v.Real("scale", scale,
///              core::Published("estimated over true turn angle", "Matthies 1995 sec. 8",
///              {0.5, 1.5}));
///       v.Angle("noise_deg", noise_rad, ...);  // degrees in JSON, radians in the struct
///       v.Require("scale", scale > 0, "must be positive", "use 0.94");  // across fields
///     }
///   };
///
/// Modules know neither JSON nor their siblings; core/archive.h holds the JSON side, on which
/// loading, schemas and tables stand.
///
/// A default decides the records of every scenario that leaves the field out, and the baselines
/// made of them; a bound or a Require only refuses files. Fingerprints, by which stored runs are
/// resumed (scenario/load.h), depend on key, place in Visit and value of each field.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rockyard::core {

/// Where a default value comes from.
enum class Origin {
  kPublished,   ///< stated in the cited source
  kCalibrated,  ///< fitted to the cited experiment
  kAssumed,     ///< chosen here, with a range
  kSetting,     ///< a choice of the user, no claim about the world
};

/// What is known of one field. Bounds are inclusive and in the unit that the JSON key names.
struct FieldInfo {
  std::string_view doc;                                   ///< what it means, in one sentence
  double min = -std::numeric_limits<double>::infinity();  ///< smallest allowed value
  double max = std::numeric_limits<double>::infinity();   ///< largest allowed value
  Origin origin = Origin::kAssumed;                       ///< where the default comes from
  std::string_view source = {};  ///< where that is stated, or why it was chosen
  /// Range over which an assumed value is varied in sensitivity studies; empty when equal.
  double study_low = 0.0;
  double study_high = 0.0;
  /// Most entries of a list.
  std::size_t max_entries = 1000;
};

/// A bound that is none.
inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// Inclusive bounds, in the unit that the JSON key names.
struct Bounds {
  double low = -kUnbounded;
  double high = kUnbounded;
};

/// Returns what is known of a field whose default is assumed. `studied` is the range of study_low
/// and study_high.
constexpr FieldInfo Assumed(std::string_view doc, std::string_view source, Bounds bounds = {},
                            Bounds studied = {0.0, 0.0}) {
  return {doc, bounds.low, bounds.high, Origin::kAssumed, source, studied.low, studied.high};
}
/// Returns the same of a field whose default `source` states.
constexpr FieldInfo Published(std::string_view doc, std::string_view source, Bounds bounds = {},
                              Bounds studied = {0.0, 0.0}) {
  return {doc, bounds.low, bounds.high, Origin::kPublished, source, studied.low, studied.high};
}
/// Returns the same of a field whose default was fitted to the experiment of `source`.
constexpr FieldInfo Calibrated(std::string_view doc, std::string_view source, Bounds bounds = {},
                               Bounds studied = {0.0, 0.0}) {
  return {doc, bounds.low, bounds.high, Origin::kCalibrated, source, studied.low, studied.high};
}
/// Returns the same of a choice of the user, which claims nothing about the world.
constexpr FieldInfo Setting(std::string_view doc, Bounds bounds = {},
                            std::string_view source = {}) {
  return {doc, bounds.low, bounds.high, Origin::kSetting, source};
}

/// Names of an enumeration's values, in value order starting at 0. Specialize per enum:
///   template <> struct core::EnumNames<Arena> { static constexpr std::array<std::string_view, 2>
///   kNames{"open", "walled"}; };
template <typename Enum>
struct EnumNames;

/// The visitor to which a parameter struct lists its members. Readers write into the references,
/// all other visitors leave them. `name` is the JSON key, a literal. Nothing is thrown: what is
/// wrong is collected, and told at once by whoever sent the visitor.
class FieldVisitor {
 public:
  virtual ~FieldVisitor() = default;

  /// A number. Bounds of `info`, here and below, are those of the value in JSON.
  virtual void Real(std::string_view name, double& value, const FieldInfo& info) = 0;
  /// An angle: radians in the struct, degrees in JSON and in the bounds of `info`.
  virtual void Angle(std::string_view name, double& value_rad, const FieldInfo& info) = 0;
  virtual void Integer(std::string_view name, std::int64_t& value, const FieldInfo& info) = 0;
  virtual void Boolean(std::string_view name, bool& value, const FieldInfo& info) = 0;
  virtual void Text(std::string_view name, std::string& value, const FieldInfo& info) = 0;
  /// A list of numbers whose length may vary, and one of fixed length.
  virtual void Reals(std::string_view name, std::vector<double>& values, const FieldInfo& info) = 0;
  virtual void FixedReals(std::string_view name, std::span<double> values,
                          const FieldInfo& info) = 0;
  /// Integers of any length, e.g. stripe indices.
  virtual void Integers(std::string_view name, std::vector<std::int64_t>& values,
                        const FieldInfo& info) = 0;

  /// A condition across fields of the group being visited; `name` is the field to blame.
  virtual void Require(std::string_view name, bool holds, std::string_view reason,
                       std::string_view suggestion) = 0;

  /// A choice among the values of an enumeration, by its EnumNames.
  template <typename Enum>
  void Choice(std::string_view name, Enum& value, const FieldInfo& info) {
    int index = static_cast<int>(value);
    ChoiceIndex(name, index, EnumNames<Enum>::kNames, info);
    value = static_cast<Enum>(index);
  }

  /// A choice among names that are known at run time: `index` into `names`.
  void ChoiceOf(std::string_view name, int& index, std::span<const std::string_view> names,
                const FieldInfo& info) {
    ChoiceIndex(name, index, names, info);
  }

  /// A nested parameter struct with its own Visit.
  template <typename Params>
  void Group(std::string_view name, Params& params, std::string_view doc) {
    BeginGroup(name, doc);
    params.Visit(*this);
    EndGroup();
  }

 protected:
  /// Choice, ChoiceOf and Group are made of these three. `index` counts from 0 into `names`.
  virtual void ChoiceIndex(std::string_view name, int& index,
                           std::span<const std::string_view> names, const FieldInfo& info) = 0;
  virtual void BeginGroup(std::string_view name, std::string_view doc) = 0;
  virtual void EndGroup() = 0;
};

}  // namespace rockyard::core
