/// @file
/// A scenario as other programs hold it: loaded, changed, written, and made into an experiment.
/// Only programs that link rockyard use it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "experiments/experiment.h"
#include "localization/estimator_set_params.h"
#include "navigation/navigator_set_params.h"
#include "perception/point_reader_set_params.h"

namespace rockyard::scenario {
struct Scenario;
}

namespace rockyard::api {

/// Every parameter of a drive or another experiment, with its number of trials and its seed. A
/// value: copies are independent. Its fields are those of a scenario file (`rockyard parameters`),
/// named by their JSON paths, in the units that the paths end in. Not for several threads at once
/// while it changes.
class Scenario {
 public:
  /// Every parameter at its default.
  Scenario();
  Scenario(const Scenario& other);
  Scenario(Scenario&& other) noexcept;
  Scenario& operator=(const Scenario& other);
  Scenario& operator=(Scenario&& other) noexcept;
  ~Scenario();

  /// Returns the scenario in a scenario file, in a scenario.resolved.json, or of the run in a
  /// folder, with "PATH=VALUE" overrides applied in order. Any object of a scenario file may extend
  /// another file. Absent keys have the values of `defaults`; the file may name the navigators and
  /// estimators of `defaults`. Throws core::UserError with everything that is wrong: unknown keys,
  /// values out of bounds, conditions across modules.
  static Scenario Load(const std::filesystem::path& path,
                       std::span<const std::string> overrides = {}, const Scenario& defaults = {});

  /// Returns the same from the JSON text of a scenario file; "extends" is relative to `folder`.
  static Scenario Parse(std::string_view text, std::span<const std::string> overrides = {},
                        const std::filesystem::path& folder = ".", const Scenario& defaults = {});

  /// Changes one value: "terrain.rocks.kind=none". Throws core::UserError, and changes nothing
  /// then.
  void Set(std::string_view path_and_value);

  /// Returns the navigators that navigation.navigator may name. Add a navigator of another program
  /// with navigators().Add(description), before the file that names it is loaded.
  navigation::NavigatorSet& navigators();

  /// Returns the estimators that localization.estimator may name; one is added in the same way.
  localization::EstimatorSet& estimators();
  /// Returns the readers of images that perception.reader may name; one is added in the same way.
  perception::PointReaderSet& readers();

  const std::string& name() const;
  /// Returns how many trials a campaign of it has, >= 1.
  std::int64_t trials() const;
  /// Returns the seed of its random streams.
  std::uint64_t seed() const;

  /// Returns every effective value, as a scenario file that reads back to the same scenario, bit
  /// for bit.
  std::string ResolvedJson() const;

  /// Returns what it holds, for rockyard's own code.
  const scenario::Scenario& values() const { return *values_; }

  /// Returns the experiment that runs single trials of it. Changes of the scenario after the call
  /// do not reach it.
  std::unique_ptr<experiments::Experiment> MakeExperiment() const;

 private:
  explicit Scenario(scenario::Scenario values);

  std::unique_ptr<scenario::Scenario> values_;
};

}  // namespace rockyard::api
