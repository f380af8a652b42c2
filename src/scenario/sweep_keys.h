// The fixed keys of sweep files. sweep_axes.cc reads them, and the free keys, which hold settings
// or levels. A default decides the cells of sweep files that leave it out.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/fields.h"
#include "scenario/sweep.h"

template <>
struct rockyard::core::EnumNames<rockyard::scenario::DesignKind> {
  static constexpr std::array<std::string_view, 4> kNames{"grid", "list", "latin_hypercube",
                                                          "sobol"};
};
template <>
struct rockyard::core::EnumNames<rockyard::scenario::AxisScale> {
  static constexpr std::array<std::string_view, 2> kNames{"linear", "log"};
};

namespace rockyard::scenario {

struct DesignParams {
  DesignKind kind = DesignKind::kGrid;
  std::int64_t points = 32;

  void Visit(core::FieldVisitor& v);
};

struct FitParams {
  std::string axis;
  AxisScale scale = AxisScale::kLog;

  void Visit(core::FieldVisitor& v);
};

struct SweepParams {
  std::string name = "unnamed";
  std::string description;
  std::int64_t trials = 100;
  std::int64_t seed = 1;
  bool common_random_numbers = false;
  DesignParams design;
  FitParams fit;

  void Visit(core::FieldVisitor& v);
};

// The free keys of a sweep file; further down those of an axis and of a level.
inline constexpr std::array<std::string_view, 4> kFreeSweepKeys{"scenario", "set", "axes", "cells"};

struct AxisParams {
  std::string name;
  std::string path;
  double from = 0.0;
  double to = 0.0;
  std::int64_t steps = 5;
  AxisScale scale = AxisScale::kLinear;
  std::string ablation;

  void Visit(core::FieldVisitor& v);
};

inline constexpr std::array<std::string_view, 3> kFreeAxisKeys{"values", "levels", "scenarios"};

// A level of an axis, or a cell of a list.
struct LevelParams {
  std::string name;

  void Visit(core::FieldVisitor& v);
};

inline constexpr std::array<std::string_view, 2> kFreeLevelKeys{"set", "scenario"};

}  // namespace rockyard::scenario
