#include "campaign/doubts/setting_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <stdexcept>
#include <utility>

#include "scenario/load.h"
#include "trial/open_values_params.h"

namespace rockyard::campaign {

std::vector<core::Problem> DoubtsOfSettings(const scenario::Scenario& scenario) {
  Values s(scenario);
  // A navigator or sensor that another program brings is not known here; bounds of its parameters
  // are its own rules.
  const bool known = s.Uses("pathfinder") || s.Uses("gestalt") || s.Uses("route");
  if (!known || !(s.SeesBy("light_stripe") || s.SeesBy("stereo"))) return {};
  const auto ask = [&](std::initializer_list<void (*)(Values&)> rules) {
    for (const auto rule : rules) rule(s);
  };
  // DoubtUnusual must come last: units are doubted only of what no rule has doubted before.
  const std::string_view experiment = scenario.experiment.chosen().name();
  if (experiment == "drive") {
    ask({DoubtTask, DoubtRover, DoubtSensing, DoubtGestalt, DoubtBelief, DoubtUnusual});
  } else if (experiment == "mission") {
    // Sols of a mission have courses of their own, and aids that come when operators look.
    ask({DoubtMission, DoubtRover, DoubtSensing, DoubtGestalt, DoubtUnusual});
  } else if (experiment == "hazard_detection") {
    ask({DoubtScenes, DoubtUnusual});
  }
  return std::move(s.doubts);
}

using core::JsonValue;

Values::Values(const scenario::Scenario& scenario)
    : whole(scenario), drive(scenario.drive), parameters(scenario::ListParameters(scenario)) {
  for (const core::ParameterInfo& each : parameters) values_[each.path] = &each.value;
}

const JsonValue& Values::At(std::string_view path) const {
  const auto found = values_.find(path);
  if (found == values_.end()) throw std::logic_error(fmt::format("no parameter {}", path));
  return *found->second;
}

double Values::operator()(std::string_view path) const { return At(path).number(); }
bool Values::On(std::string_view path) const { return At(path).boolean(); }
bool Values::Is(std::string_view path, std::string_view name) const {
  return At(path).text() == name;
}

std::vector<std::int64_t> Values::Integers(std::string_view path) const {
  std::vector<std::int64_t> numbers;
  for (const JsonValue& each : At(path).list()) numbers.push_back(each.integer());
  return numbers;
}

bool Values::IsOff(const std::string& path) const {
  const auto found = values_.find(path);
  return found != values_.end() && !found->second->boolean();
}

double Values::course_m() const { return trial::CourseLength_m(drive.course); }
std::string Values::OfCourse() const { return fmt::format("a course of {:.3g} m", course_m()); }
double Values::front_m() const { return 0.5 * drive.rover.geometry.length_m; }

bool Values::Uses(std::string_view navigator) const {
  return drive.navigation.navigators.chosen().name() == navigator;
}

bool Values::SeesBy(std::string_view sensor) const {
  return drive.sensors.terrain_sensors.chosen().name() == sensor;
}

bool Values::HasRocks() const { return drive.terrain.rocks.kind != terrain::RockFieldKind::kNone; }

bool Values::Looks() const { return Uses("gestalt") || DrivesByArray(); }

bool Values::DrivesByArray() const { return Uses("pathfinder") && drive.perception.hazard.enabled; }

std::string Values::OfNavigator(std::string_view gestalts, std::string_view key) const {
  if (Uses("gestalt")) return fmt::format("navigation.gestalt.{}", gestalts);
  return fmt::format("navigation.{}.{}", Uses("route") ? "route" : "pathfinder", key);
}

trial::Zone Values::zone() const {
  return drive.sensors.terrain_sensors.chosen().reported_zone(drive);
}

void Values::Doubt(bool doubtful, std::string_view path, std::string reason,
                   std::string_view right) {
  if (doubtful) doubts.push_back({std::string(path), std::move(reason), std::string(right)});
}

void Values::Within(std::string_view path, double low, double high, std::string_view what,
                    std::string_view right) {
  const double value = (*this)(path);
  Doubt(value < low || value > high, path,
        fmt::format("{:g} is {} for {}", value, value < low ? "little" : "much", what), right);
}

void Values::AtLeast(std::string_view path, double low, std::string_view what,
                     std::string_view right) {
  Within(path, low, kUnbounded, what, right);
}

void Values::AtMost(std::string_view path, double high, std::string_view what,
                    std::string_view right) {
  Within(path, -kUnbounded, high, what, right);
}

bool Values::IsDoubted(std::string_view path) const {
  return std::any_of(doubts.begin(), doubts.end(),
                     [&](const core::Problem& doubt) { return doubt.path == path; });
}

}  // namespace rockyard::campaign
