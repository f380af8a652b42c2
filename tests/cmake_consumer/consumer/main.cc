// Drives one trial of the default scenario through an installed rockyard, twice: the same record.
#include <cstdio>

#include "experiments/experiment.h"
#include "scenario/scenario.h"
#include "truth/record.h"

int main() {
  const rockyard::scenario::Scenario scenario;
  const auto experiment =
      rockyard::experiments::MakeExperiment(scenario.experiment, scenario.drive);
  const auto first = experiment->Run(1, 0);
  const auto again = experiment->Run(1, 0);
  const bool same = first.outcome == again.outcome && first.values.size() == again.values.size();
  const bool ran = first.outcome != rockyard::truth::TrialOutcome::kSimulatorFault;
  std::puts(same && ran ? "consumer: ok" : "consumer: the trial failed");
  return same && ran ? 0 : 1;
}
