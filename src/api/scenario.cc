#include "api/scenario.h"

#include <utility>

#include "campaign/run_source.h"
#include "core/json_file.h"
#include "experiments/make_experiment.h"
#include "scenario/load.h"

namespace rockyard::api {

Scenario::Scenario() : Scenario(scenario::Scenario{}) {}
Scenario::Scenario(scenario::Scenario values)
    : values_(std::make_unique<scenario::Scenario>(std::move(values))) {}
Scenario::Scenario(const Scenario& other) : Scenario(scenario::Scenario(*other.values_)) {}
Scenario::Scenario(Scenario&& other) noexcept = default;
Scenario& Scenario::operator=(const Scenario& other) { return *this = Scenario(other); }
Scenario& Scenario::operator=(Scenario&& other) noexcept = default;
Scenario::~Scenario() = default;

Scenario Scenario::Load(const std::filesystem::path& path, std::span<const std::string> overrides,
                        const Scenario& defaults) {
  return Scenario(campaign::LoadScenarioFrom(path, overrides, "", *defaults.values_));
}

Scenario Scenario::Parse(std::string_view text, std::span<const std::string> overrides,
                         const std::filesystem::path& folder, const Scenario& defaults) {
  return Scenario(scenario::ParseScenario(text, overrides, folder, *defaults.values_));
}

void Scenario::Set(std::string_view path_and_value) {
  core::JsonValue document = scenario::WriteScenario(*values_);
  core::ApplyOverride(document, path_and_value);
  *values_ = scenario::ReadScenario(document, *values_);
}

navigation::NavigatorSet& Scenario::navigators() { return values_->drive.navigation.navigators; }
localization::EstimatorSet& Scenario::estimators() {
  return values_->drive.localization.estimators;
}

perception::PointReaderSet& Scenario::readers() { return values_->drive.perception.readers; }

const std::string& Scenario::name() const { return values_->name; }
std::int64_t Scenario::trials() const { return values_->trials; }
std::uint64_t Scenario::seed() const { return static_cast<std::uint64_t>(values_->seed); }

std::string Scenario::ResolvedJson() const { return scenario::ResolvedJson(*values_); }

std::unique_ptr<experiments::Experiment> Scenario::MakeExperiment() const {
  return experiments::MakeExperiment(values_->experiment, values_->drive);
}

}  // namespace rockyard::api
