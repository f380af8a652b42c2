/// @file
/// A navigator of one's own as a process in C++: this header and nlohmann-json (Debian:
/// nlohmann-json3-dev) are all that it needs. A plugin is quicker, and has the types of
/// navigation/navigator.h; a process can hold what no plugin should: other versions of libraries,
/// global state, memory without bounds.
///
///   using namespace rockyard_navigator;
///   struct Mine final : Navigator {
///     static Json Describe() {
///       return {{"name", "mine"}, {"doc", "drives straight ahead"}, {"version", "1.0"},
///               {"parameters", Json::array({Parameter("goal_tolerance_m", "real", 0.3,
///                                                     "arrives within", {{"max", 5}})})}};
///     }
///     Json Decide(const Json& input) override { return Drive(0.0, 1.0); }
///   };
///   int main() { return Run<Mine>(); }
///
///   rockyard run nominal --navigator-process ./mine
///
/// SI units, radians. Members that a message lacks are not there: input.contains("cloud"). A trial
/// has to repeat bit for bit: read no clock, and seed random numbers by setup["random_seed"]. What
/// is printed is shown where the navigator fails. docs/navigators.md has the messages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace rockyard_navigator {

using Json = nlohmann::json;

/// Declares a parameter; `more`: min, max, study, origin, source, choices, parameters.
inline Json Parameter(const std::string& name, const std::string& type, const Json& value,
                      const std::string& doc, Json more = Json::object()) {
  more.update({{"name", name}, {"type", type}, {"default", value}, {"doc", doc}});
  return more;
}

/// Returns a number of a message; what is none (null, absent) as NaN.
inline double Number(const Json& object, const std::string& key) {
  const auto found = object.find(key);
  const bool is_number = found != object.end() && found->is_number();
  return is_number ? found->get<double>() : std::numeric_limits<double>::quiet_NaN();
}

/// Returns the decision to drive an arc; positive curvatures turn left, direction -1 backs off.
inline Json Drive(double curvature_per_m, double until_distance_m, int direction = 1,
                  double near_goal_m = 0.0) {
  return {
      {"motion", {{"kind", "arc"}, {"curvature_per_m", curvature_per_m}, {"direction", direction}}},
      {"until", {{"distance_m", until_distance_m}, {"near_goal_m", near_goal_m}}}};
}
/// Returns the decision to turn in place, +1 to the left, until the heading is `turn_rad` away.
inline Json Turn(int direction, double turn_rad) {
  return {{"motion", {{"kind", "turn"}, {"direction", direction}}},
          {"until", {{"turn_rad", turn_rad}}}};
}
/// Returns the decision to stop and look; the next input carries what was seen.
inline Json Look(const std::string& direction = "ahead") { return {{"look", direction}}; }
inline Json Rest(double period_s) {
  return {{"motion", {{"kind", "stop"}}}, {"until", {{"period_s", period_s}}}};
}
inline Json Arrived() { return {{"status", "arrived"}}; }
inline Json GaveUp() { return {{"status", "gave_up"}}; }

/// The base of a navigator, which has a static Json Describe() besides. One object drives one
/// trial.
class Navigator {
 public:
  virtual ~Navigator() = default;

  /// What a trial has to know beside decisions.
  virtual Json Traits() {
    return {{"reads", "nothing"},
            {"cost", {{"kind", "look"}, {"time_s", 0.0}}},
            {"goal_tolerance",
             {{"parameter", "goal_tolerance_m"}, {"value_m", parameters["goal_tolerance_m"]}}}};
  }
  virtual void Start(const Json& /*setup*/) {}
  virtual Json Decide(const Json& input) = 0;
  /// The estimate was corrected; or else operators have moved the rover.
  virtual void Jump(bool /*corrected*/, const Json& /*before*/, const Json& /*after*/) {}
  /// `goal` is the next one; `moved`: the same, seen elsewhere.
  virtual void SetGoal(const Json& /*goal*/, bool /*moved*/) {}
  /// Returns lines and grids for replays. No decision may depend on the call.
  virtual Json Overlay() { return Json::object(); }

  // Run sets these.
  Json parameters;
  Json goal;
  std::vector<double> own;  ///< own values, as Describe() declares them
};

// What follows is for Run alone.
namespace layer {

template <typename Mine>
Json Answer(const Json& ask, std::unique_ptr<Mine>& navigator) {
  const std::string type = ask.at("type");
  if (type == "describe") {
    Json answer = Mine::Describe();
    answer["protocol"] = 1;
    return answer;
  }
  if (type == "traits" || type == "start") {
    auto made = std::make_unique<Mine>();
    made->parameters = ask.at("parameters");
    if (type == "traits") return made->Traits();
    made->goal = ask.at("setup").at("goal");
    made->own.assign(Mine::Describe().value("own_values", Json::array()).size(), 0.0);
    made->Start(ask.at("setup"));
    navigator = std::move(made);
    return Json::object();
  }
  if (navigator == nullptr) throw std::runtime_error(type + " before start");
  if (type == "decide") {
    Json answer = navigator->Decide(ask);
    answer["own_values"] = navigator->own;
    return answer;
  }
  if (type == "overlay") return navigator->Overlay();
  if (type == "jump") navigator->Jump(ask.at("corrected"), ask.at("before"), ask.at("after"));
  if (type == "goal") {
    navigator->goal = ask.at("goal");
    navigator->SetGoal(ask.at("goal"), ask.at("moved"));
  }
  return Json::object();
}

}  // namespace layer

/// Serves navigators of the class until rockyard closes its end. Returns the exit code.
template <typename Mine>
int Run() {
  std::FILE* requests = ::fdopen(3, "rb");
  std::FILE* answers = ::fdopen(4, "wb");
  if (requests == nullptr || answers == nullptr) {
    std::fputs("a navigator of rockyard: run by --navigator-process\n", stderr);
    return 2;
  }
  std::unique_ptr<Mine> navigator;
  std::array<unsigned char, 4> size{};  // little endian
  while (std::fread(size.data(), 1, 4, requests) == 4) {
    std::string text(size[0] | size[1] << 8 | size[2] << 16 | std::size_t{size[3]} << 24, '\0');
    if (std::fread(text.data(), 1, text.size(), requests) != text.size()) break;
    Json answer;
    try {
      const Json ask = Json::parse(text);
      answer = layer::Answer(ask, navigator);
      answer["id"] = ask.at("id");
    } catch (const std::exception& error) {  // the drive ends with its text
      answer = {{"error", error.what()}};
    }
    text = answer.dump(-1, ' ', false, Json::error_handler_t::replace);
    for (std::size_t i = 0; i < 4; ++i)
      size[i] = static_cast<unsigned char>(text.size() >> (8 * i));
    std::fwrite(size.data(), 1, 4, answers);
    std::fwrite(text.data(), 1, text.size(), answers);
    if (std::fflush(answers) != 0) return 1;
  }
  return 0;
}

}  // namespace rockyard_navigator
