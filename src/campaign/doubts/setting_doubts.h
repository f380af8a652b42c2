// Settings of a drive, a mission or scenes of hazards that hardly suit each other, by sizes and
// physics. Doubts about scenarios (scenario_doubts.h) ask these rules; each rule asks settings by
// their paths through Values.
//
// Must stay: the path and the wording of every doubt, numbers included. Scenarios that accept a
// doubt quote "path: reason" to the letter.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/field_table.h"
#include "scenario/scenario.h"
#include "trial/counters/hazard_watch.h"
#include "trial/drive_params.h"

namespace rockyard::campaign {

inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

// The settings of a scenario by their paths, and what the rules doubt of them.
class Values {
 public:
  // `scenario` must outlive it.
  explicit Values(const scenario::Scenario& scenario);
  Values(const Values&) = delete;
  Values& operator=(const Values&) = delete;

  // Returns a number, in the unit that ends the name of its path. Throws std::logic_error where
  // there is no such parameter, as On, Is and Integers do.
  double operator()(std::string_view path) const;
  bool On(std::string_view path) const;
  bool Is(std::string_view path, std::string_view name) const;
  std::vector<std::int64_t> Integers(std::string_view path) const;
  // Returns whether the parameter is there and false.
  bool IsOff(const std::string& path) const;

  double course_m() const;       // by all waypoints
  std::string OfCourse() const;  // "a course of 7.6 m"
  double front_m() const;        // of the rover, from its middle
  bool Uses(std::string_view navigator) const;
  bool SeesBy(std::string_view sensor) const;
  bool HasRocks() const;
  // Returns whether the terrain sensor is used: by the pathfinder for hazards, or for the map of
  // GESTALT.
  bool Looks() const;
  // Returns whether the pathfinder finds hazards in an array of elevations; what it does not see
  // now it does not know.
  bool DrivesByArray() const;
  // Returns the path of a parameter that GESTALT calls `gestalts`, pathfinder and route `key`.
  std::string OfNavigator(std::string_view gestalts, std::string_view key) const;
  // The zone of which the terrain sensor reports, in R.
  trial::Zone zone() const;

  // Adds a doubt where `doubtful`. `right`: what would be right.
  void Doubt(bool doubtful, std::string_view path, std::string reason, std::string_view right);
  // Adds a doubt where the value is below `low` or above `high`: "0.4 is little for a course of 7.6
  // m", with `what` for the course.
  void Within(std::string_view path, double low, double high, std::string_view what,
              std::string_view right);
  void AtLeast(std::string_view path, double low, std::string_view what, std::string_view right);
  void AtMost(std::string_view path, double high, std::string_view what, std::string_view right);
  bool IsDoubted(std::string_view path) const;

  const scenario::Scenario& whole;
  const trial::DriveParams& drive;
  const std::vector<core::ParameterInfo> parameters;
  std::vector<core::Problem> doubts;

 private:
  const core::JsonValue& At(std::string_view path) const;

  std::map<std::string, const core::JsonValue*, std::less<>> values_;
};

// The rules, each about what is named beside it.
void DoubtTask(Values& s);     // goal, field, limits, and what all of the looks take
void DoubtRover(Values& s);    // shape, masses, motors, steering, soil
void DoubtSensing(Values& s);  // what is seen, in time and where the wheels go
void DoubtGestalt(Values& s);  // the vehicle that it is told, map and paths
void DoubtBelief(Values& s);   // gyro, filter, visual odometry, aids
void DoubtMission(Values& s);  // what lander and sun give a rover for its goals
void DoubtScenes(Values& s);   // of the detection of hazards
void DoubtUnusual(Values& s);  // one by one: usual values, and studies' ranges

// Returns what the rules doubt, each with the path of one of the settings, what is doubtful, and
// what would be right. The rules ask only what the chosen navigator, sensor and estimator use;
// their thresholds, assumptions all, stand where they are applied. They leave room for rovers and
// sites that are merely unusual: what they doubt would end drives, or hide what is to be found out.
// Tests hold them to lists of misfits, most of which they have to name (tests/data/misfits), and to
// the scenarios that come with rockyard, of which they doubt none.
std::vector<core::Problem> DoubtsOfSettings(const scenario::Scenario& scenario);

}  // namespace rockyard::campaign
