#include "core/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "math/angles.h"

namespace rockyard::core {
namespace {

struct Unit {
  std::string_view token;  // in names
  std::string_view text;   // for people
};

// Units by the tokens of names. A token that is added gives a unit to every name that ends in it.
constexpr std::array<Unit, 37> kUnits = {{{"m", "m"},
                                          {"m2", "m2"},
                                          {"m3", "m3"},
                                          {"mm", "mm"},
                                          {"cm", "cm"},
                                          {"nm", "nm"},
                                          {"au", "au"},
                                          {"s", "s"},
                                          {"s2", "s2"},
                                          {"h", "h"},
                                          {"rad", "rad"},
                                          {"rad2", "rad2"},
                                          {"deg", "deg"},
                                          {"deg2", "deg2"},
                                          {"kg", "kg"},
                                          {"g", "g"},
                                          {"N", "N"},
                                          {"Nm", "Nm"},
                                          {"Ns", "Ns"},
                                          {"W", "W"},
                                          {"w", "W"},
                                          {"Wh", "Wh"},
                                          {"wh", "Wh"},
                                          {"J", "J"},
                                          {"V", "V"},
                                          {"A", "A"},
                                          {"Hz", "Hz"},
                                          {"hz", "Hz"},
                                          {"Pa", "Pa"},
                                          {"px", "px"},
                                          {"e", "e"},  // electrons
                                          {"bit", "bit"},
                                          {"bits", "bit"},
                                          {"percent", "%"},
                                          {"K", "K"},
                                          // Powers of Bekker's sinkage exponent n.
                                          {"mn1", "m^(n+1)"},
                                          {"mn2", "m^(n+2)"}}};

// Returns an empty text where the token names no unit.
std::string_view UnitText(std::string_view token) {
  const auto* found = std::find_if(kUnits.begin(), kUnits.end(),
                                   [token](const Unit& unit) { return unit.token == token; });
  return found == kUnits.end() ? std::string_view() : found->text;
}

std::vector<std::string_view> Split(std::string_view name) {
  std::vector<std::string_view> tokens;
  while (true) {
    const std::size_t bar = name.find('_');
    tokens.push_back(name.substr(0, bar));
    if (bar == std::string_view::npos) return tokens;
    name.remove_prefix(bar + 1);
  }
}

}  // namespace

std::string UnitOf(std::string_view name) {
  if (name.ends_with("_min")) return "min";  // before a unit it is the least value
  const std::vector<std::string_view> tokens = Split(name);
  std::size_t first = tokens.size();
  while (first > 1 && (!UnitText(tokens[first - 1]).empty() || tokens[first - 1] == "per")) --first;
  std::string unit;
  for (std::size_t i = first; i < tokens.size(); ++i) {
    if (tokens[i] == "per") {
      if (unit.empty()) unit += '1';
    } else {
      unit += unit.empty() ? "" : "/";
      unit += UnitText(tokens[i]);
    }
  }
  return unit.empty() ? "1" : unit;
}

double ExactDegrees(double value_rad) {
  const double degrees = math::RadToDeg(value_rad);
  for (int digits = 1; digits <= 17; ++digits) {
    const double candidate = std::strtod(fmt::format("{:.{}g}", degrees, digits).c_str(), nullptr);
    if (math::DegToRad(candidate) == value_rad) return candidate;
  }
  for (const double neighbour :
       {std::nextafter(degrees, -HUGE_VAL), std::nextafter(degrees, HUGE_VAL)}) {
    if (math::DegToRad(neighbour) == value_rad) return neighbour;
  }
  return degrees;
}

}  // namespace rockyard::core
