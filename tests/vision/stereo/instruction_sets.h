// Runs a test with each instruction set that this machine has.
#pragma once

#include <hwy/targets.h>

#include <cstdint>
#include <vector>

namespace rockyard::vision {

// One bit of Highway each; the emulation of 128 bits, which machines without any fall back to, too.
inline std::vector<std::int64_t> InstructionSets() {
  std::vector<std::int64_t> sets{HWY_EMU128};
  for (std::int64_t left = hwy::SupportedTargets() & HWY_TARGETS & ~(HWY_EMU128 | HWY_SCALAR);
       left != 0; left &= left - 1) {
    sets.push_back(left & -left);
  }
  return sets;
}

// The fast stages use this instruction set as long as the object lives.
class UseInstructionSet {
 public:
  explicit UseInstructionSet(std::int64_t set) {
    hwy::SetSupportedTargetsForTest(set);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
  UseInstructionSet(const UseInstructionSet&) = delete;
  UseInstructionSet& operator=(const UseInstructionSet&) = delete;
  ~UseInstructionSet() {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

}  // namespace rockyard::vision
