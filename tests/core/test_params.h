// A parameter struct with a field of every kind.
#pragma once

#include <array>

#include "core/fields.h"
#include "math/angles.h"

namespace rockyard::core {

enum class Colour { kRed, kGreen, kBlue };

struct InnerParams {
  double low_m = 0.1;
  double high_m = 1.0;
  Colour colour = Colour::kGreen;

  void Visit(FieldVisitor& v);
};

struct TestParams {
  double radius_m = 0.5;
  double heading_rad = math::DegToRad(30.0);
  std::int64_t count = 3;
  bool enabled = true;
  std::string label = "plain";
  std::vector<double> weights = {1.0, 2.5};
  std::array<double, 3> axes_m = {0.1, 0.2, 0.3};
  std::vector<std::int64_t> stripes = {0, 1};
  double unbounded = 0.0;
  InnerParams inner;

  void Visit(FieldVisitor& v);
};

}  // namespace rockyard::core

template <>
struct rockyard::core::EnumNames<rockyard::core::Colour> {
  static constexpr std::array<std::string_view, 3> kNames{"red", "green", "blue"};
};

namespace rockyard::core {

inline void InnerParams::Visit(FieldVisitor& v) {
  v.Real("low_m", low_m, Assumed("lower end", {}, {0.0, 10.0}));
  v.Real("high_m", high_m, Assumed("upper end", {}, {0.0, 10.0}));
  v.Choice("colour", colour, Setting("paint"));
  v.Require("high_m", low_m <= high_m, "is below low_m", "use a larger high_m");
}

inline void TestParams::Visit(FieldVisitor& v) {
  v.Real("radius_m", radius_m, Published("radius", "Author 1995 sec. 1", {0.01, 2.0}, {0.4, 0.6}));
  v.Angle("heading_deg", heading_rad, Assumed("heading", {}, {-180.0, 180.0}));
  v.Integer("count", count, Assumed("how many", {}, {0, 1000}));
  v.Boolean("enabled", enabled, Assumed("whether", {}));
  v.Text("label", label, Assumed("name", {}));
  v.Reals("weights", weights, Assumed("weights", {}, {0.0, 100.0}));
  v.FixedReals("axes_m", axes_m, Assumed("axes", {}, {0.0, 1.0}));
  v.Integers("stripes", stripes, Assumed("stripes", {}, {0, 4}));
  v.Real("unbounded", unbounded, Assumed("any finite number", {}));
  v.Group("inner", inner, "a nested group");
}

}  // namespace rockyard::core
