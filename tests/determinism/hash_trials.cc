// Prints the hash over the records of a scenario's first trials, with nothing of the command, its
// store or its pages: what builds at different optimization levels are compared by.
//
// Usage: hash_trials SCENARIO TRIALS THREADS [--without-avx|--without-avx512] [PATH=VALUE]...
// Without AVX, or AVX-512, code that is chosen while the program runs takes this processor for one
// that has SSE at most, or AVX2. The C library goes by GLIBC_TUNABLES.
// Exit code 0; 2: bad usage or scenario; 77: this processor lacks what should be left out.

#include <hwy/highway.h>

#include <cstdlib>
#include <iostream>

#include "batch/executor.h"
#include "batch/trial_hash.h"
#include "core/error.h"
#include "experiments/make_experiment.h"
#include "scenario/load.h"

// What __builtin_cpu_supports reads (GCC's libgcc; compiler-rt has the same layout).
extern "C" struct {
  unsigned int vendor, type, subtype;
  unsigned int features;
} __cpu_model;  // NOLINT(bugprone-reserved-identifier)

namespace rockyard::batch {
namespace {

enum class Registers { kAll, kUpToAvx2, kUpToSse };

// Hides registers from Highway's and the compiler's dispatch. Returns whether there were any.
bool Hide(Registers registers) {
  if (registers == Registers::kAll) return true;
#if defined(__x86_64__)
  __builtin_cpu_init();
  const bool sse = registers == Registers::kUpToSse;
  if (!(sse ? __builtin_cpu_supports("avx2") : __builtin_cpu_supports("avx512f"))) return false;
  constexpr unsigned int kFirstAvx = 9;  // bits from AVX on, and from AVX-512F on
  constexpr unsigned int kFirstAvx512 = 15;
  __cpu_model.features &= (1U << (sse ? kFirstAvx : kFirstAvx512)) - 1U;
  hwy::DisableTargets(HWY_AVX3 | HWY_AVX3_DL | (sse ? HWY_AVX2 : 0));
  return !__builtin_cpu_supports("avx512f") && !(sse && __builtin_cpu_supports("avx2"));
#else
  return false;
#endif
}

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
  using rockyard::batch::Registers;
  std::vector<std::string> words(argv + 1, argv + argc);
  Registers registers = Registers::kAll;
  if (words.size() > 3 && words[3].starts_with("--without-")) {
    registers = words[3] == "--without-avx" ? Registers::kUpToSse : Registers::kUpToAvx2;
    words.erase(words.begin() + 3);
  }
  const std::int64_t trials = words.size() > 1 ? std::atoll(words[1].c_str()) : 0;
  const int threads = words.size() > 2 ? std::atoi(words[2].c_str()) : 0;
  if (trials < 1 || threads < 1) {
    std::cerr << "usage: hash_trials SCENARIO TRIALS THREADS [--without-avx|--without-avx512]"
                 " [PATH=VALUE]...\n";
    return 2;
  }
  if (!rockyard::batch::Hide(registers)) return 77;
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
