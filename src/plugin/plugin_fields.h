/// @file
/// The parameters of a navigator, between its plugin and the command: listed as JSON, set from
/// values, their conditions told. A part of navigator_plugin.h, which alone includes it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/fields.h"
#include "plugin/abi.h"

namespace rockyard::plugin::layer {

/// JSON that is written from front to back.
class JsonLine {
 public:
  JsonLine& Raw(std::string_view text) {
    text_ += text;
    return *this;
  }
  JsonLine& Text(std::string_view text) {
    text_ += '"';
    for (const char c : text) {
      const auto byte = static_cast<unsigned char>(c);
      if (c == '"' || c == '\\') {
        text_ += '\\';
        text_ += c;
      } else if (byte < 0x20) {
        std::array<char, 8> escaped{};
        std::snprintf(escaped.data(), escaped.size(), "\\u%04x", static_cast<unsigned>(byte));
        text_ += escaped.data();
      } else {
        text_ += c;
      }
    }
    text_ += '"';
    return *this;
  }
  JsonLine& Number(double value) {
    if (!std::isfinite(value)) return Raw("null");
    std::array<char, 40> digits{};
    std::snprintf(digits.data(), digits.size(), "%.17g", value);
    std::replace(digits.begin(), digits.end(), ',', '.');
    return Raw(digits.data());
  }
  JsonLine& Integer(std::int64_t value) { return Raw(std::to_string(value)); }
  /// Begins a member, after a comma unless it is the first of its object.
  JsonLine& Key(std::string_view key) {
    if (!text_.empty() && text_.back() != '{' && text_.back() != '[') text_ += ',';
    return Text(key).Raw(":");
  }
  JsonLine& Member(std::string_view key, std::string_view value) { return Key(key).Text(value); }
  JsonLine& Comma() {
    if (!text_.empty() && text_.back() != '[') text_ += ',';
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Lists parameters as JSON, with their defaults.
class FieldLister final : public core::FieldVisitor {
 public:
  explicit FieldLister(JsonLine& json) : json_(json) {}

  void Real(std::string_view name, double& value, const core::FieldInfo& info) override {
    Begin(name, "real", info).Number(value).Raw("}");
  }
  void Angle(std::string_view name, double& value_rad, const core::FieldInfo& info) override {
    Begin(name, "angle", info).Number(value_rad).Raw("}");
  }
  void Integer(std::string_view name, std::int64_t& value, const core::FieldInfo& info) override {
    Begin(name, "integer", info).Integer(value).Raw("}");
  }
  void Boolean(std::string_view name, bool& value, const core::FieldInfo& info) override {
    Begin(name, "boolean", info).Raw(value ? "true}" : "false}");
  }
  void Text(std::string_view name, std::string& value, const core::FieldInfo& info) override {
    Begin(name, "text", info).Text(value).Raw("}");
  }
  void Reals(std::string_view name, std::vector<double>& values,
             const core::FieldInfo& info) override {
    List(Begin(name, "reals", info), values);
  }
  void FixedReals(std::string_view name, std::span<double> values,
                  const core::FieldInfo& info) override {
    List(Begin(name, "fixed_reals", info), values);
  }
  void Integers(std::string_view name, std::vector<std::int64_t>& values,
                const core::FieldInfo& info) override {
    List(Begin(name, "integers", info), values);
  }
  void Require(std::string_view, bool, std::string_view, std::string_view) override {}

 protected:
  void ChoiceIndex(std::string_view name, int& index, std::span<const std::string_view> names,
                   const core::FieldInfo& info) override {
    json_.Comma().Raw("{").Member("name", name).Member("type", "choice");
    Describe(info);
    json_.Key("choices").Raw("[");
    for (const std::string_view choice : names) json_.Comma().Text(choice);
    json_.Raw("]").Key("default").Integer(index).Raw("}");
  }
  void BeginGroup(std::string_view name, std::string_view doc) override {
    json_.Comma().Raw("{").Member("name", name).Member("type", "group").Member("doc", doc);
    json_.Key("parameters").Raw("[");
  }
  void EndGroup() override { json_.Raw("]}"); }

 private:
  JsonLine& Begin(std::string_view name, std::string_view type, const core::FieldInfo& info) {
    json_.Comma().Raw("{").Member("name", name).Member("type", type);
    Describe(info);
    return json_.Key("default");
  }
  void Describe(const core::FieldInfo& info) {
    constexpr std::array<std::string_view, 4> kOrigins{"published", "calibrated", "assumed",
                                                       "setting"};
    json_.Member("doc", info.doc).Member("source", info.source);
    json_.Member("origin", kOrigins[static_cast<std::size_t>(info.origin)]);
    if (std::isfinite(info.min)) json_.Key("min").Number(info.min);
    if (std::isfinite(info.max)) json_.Key("max").Number(info.max);
    if (info.study_low < info.study_high) {
      json_.Key("study").Raw("[").Number(info.study_low).Raw(",").Number(info.study_high).Raw("]");
    }
    json_.Key("max_entries").Integer(static_cast<std::int64_t>(info.max_entries));
  }
  template <typename Values>
  static void List(JsonLine& json, const Values& values) {
    json.Raw("[");
    for (const auto value : values) {
      json.Comma();
      if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>) {
        json.Number(value);
      } else {
        json.Integer(value);
      }
    }
    json.Raw("]}");
  }

  JsonLine& json_;
};

/// Sets parameters to the values of the command, in the order of the lister.
class FieldSetter final : public core::FieldVisitor {
 public:
  explicit FieldSetter(const rockyard_values& values) : values_(values) {}

  void Real(std::string_view, double& value, const core::FieldInfo&) override {
    value = Next().real;
  }
  void Angle(std::string_view, double& value_rad, const core::FieldInfo&) override {
    value_rad = Next().real;
  }
  void Integer(std::string_view, std::int64_t& value, const core::FieldInfo&) override {
    value = Next().integer;
  }
  void Boolean(std::string_view, bool& value, const core::FieldInfo&) override {
    value = Next().integer != 0;
  }
  void Text(std::string_view, std::string& value, const core::FieldInfo&) override {
    value = Next().text;
  }
  void Reals(std::string_view, std::vector<double>& values, const core::FieldInfo&) override {
    const rockyard_value& value = Next();
    values.assign(value.reals, value.reals + value.count);
  }
  void FixedReals(std::string_view, std::span<double> values, const core::FieldInfo&) override {
    const rockyard_value& value = Next();
    std::copy_n(value.reals, std::min(values.size(), value.count), values.begin());
  }
  void Integers(std::string_view, std::vector<std::int64_t>& values,
                const core::FieldInfo&) override {
    const rockyard_value& value = Next();
    values.assign(value.integers, value.integers + value.count);
  }
  void Require(std::string_view, bool, std::string_view, std::string_view) override {}

 protected:
  void ChoiceIndex(std::string_view, int& index, std::span<const std::string_view>,
                   const core::FieldInfo&) override {
    index = static_cast<int>(Next().integer);
  }
  void BeginGroup(std::string_view, std::string_view) override {}
  void EndGroup() override {}

 private:
  const rockyard_value& Next() {
    if (next_ >= values_.count) throw std::runtime_error("the command handed too few parameters");
    return values_.values[next_++];
  }

  const rockyard_values& values_;
  std::size_t next_ = 0;
};

/// Lists the conditions across parameters that do not hold.
class Conditions final : public core::FieldVisitor {
 public:
  explicit Conditions(JsonLine& json) : json_(json) {}

  void Real(std::string_view, double&, const core::FieldInfo&) override {}
  void Angle(std::string_view, double&, const core::FieldInfo&) override {}
  void Integer(std::string_view, std::int64_t&, const core::FieldInfo&) override {}
  void Boolean(std::string_view, bool&, const core::FieldInfo&) override {}
  void Text(std::string_view, std::string&, const core::FieldInfo&) override {}
  void Reals(std::string_view, std::vector<double>&, const core::FieldInfo&) override {}
  void FixedReals(std::string_view, std::span<double>, const core::FieldInfo&) override {}
  void Integers(std::string_view, std::vector<std::int64_t>&, const core::FieldInfo&) override {}
  void Require(std::string_view name, bool holds, std::string_view reason,
               std::string_view suggestion) override {
    if (holds) return;
    json_.Comma().Raw("{").Member("parameter", prefix_ + std::string(name));
    json_.Member("reason", reason).Member("suggestion", suggestion).Raw("}");
  }

 protected:
  void ChoiceIndex(std::string_view, int&, std::span<const std::string_view>,
                   const core::FieldInfo&) override {}
  void BeginGroup(std::string_view name, std::string_view) override {
    prefix_ += std::string(name) + ".";
  }
  void EndGroup() override {
    prefix_.pop_back();
    const std::size_t dot = prefix_.find_last_of('.');
    prefix_.resize(dot == std::string::npos ? 0 : dot + 1);
  }

 private:
  JsonLine& json_;
  std::string prefix_;
};

}  // namespace rockyard::plugin::layer
