// Prints the hash over the records of a scenario's first trials, with nothing of the command, its
// store or its pages: what builds at different optimization levels are compared by.
//
// Usage: hash_trials SCENARIO TRIALS THREADS [PATH=VALUE]...
// Exit code 0; 2: bad usage or scenario.

#include <cstdlib>
#include <iostream>

#include "batch/executor.h"
#include "batch/trial_hash.h"
#include "core/error.h"
#include "experiments/make_experiment.h"
#include "scenario/load.h"

namespace rockyard::batch {
namespace {

// The trials of one cell in order, and a place for the record of each.
class CountedTrials final : public WorkSource {
 public:
  explicit CountedTrials(std::int64_t trials) : records_(static_cast<std::size_t>(trials)) {}

  std::optional<TrialId> Take() override {
    const std::size_t next = next_++;
    if (next >= records_.size()) return std::nullopt;
    return TrialId{.cell = 0, .trial = static_cast<std::int64_t>(next)};
  }

  void Finish(CellRecord record) override {
    const auto trial = static_cast<std::size_t>(record.record.trial);
    records_[trial] = std::move(record.record);
  }

  void Close() override { next_ = records_.size(); }

  const std::vector<truth::Record>& records() const { return records_; }

 private:
  std::atomic<std::size_t> next_ = 0;
  std::vector<truth::Record> records_;
};

std::string HashOfTrials(const scenario::Scenario& scenario, std::int64_t trials, int threads) {
  const auto experiment = experiments::MakeExperiment(scenario.experiment, scenario.drive);
  const std::vector<CellWork> work{{experiment.get(), static_cast<std::uint64_t>(scenario.seed)}};
  CountedTrials source(trials);
  RunTrials(work, source, threads);
  return TrialHash(source.records());
}

}  // namespace
}  // namespace rockyard::batch

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  const std::int64_t trials = words.size() > 1 ? std::atoll(words[1].c_str()) : 0;
  const int threads = words.size() > 2 ? std::atoi(words[2].c_str()) : 0;
  if (trials < 1 || threads < 1) {
    std::cerr << "usage: hash_trials SCENARIO TRIALS THREADS [PATH=VALUE]...\n";
    return 2;
  }
  try {
    const std::vector<std::string> overrides(words.begin() + 3, words.end());
    const auto scenario = rockyard::scenario::LoadScenario(words[0], overrides);
    std::cout << rockyard::batch::HashOfTrials(scenario, trials, threads) << "\n";
  } catch (const rockyard::core::UserError& error) {
    std::cerr << "hash_trials: " << error.what() << "\n";
    return 2;
  }
  return 0;
}
