// Gives `rockyard cylinder`'s work many damaged images (core/fuzz_study.h).
#include <array>

#include "campaign/cylinder/painted_files.h"
#include "core/fuzz_study.h"
#include "core/test_folder.h"

int main(int count, char** arguments) {
  using namespace rockyard::campaign;
  constexpr std::array kOutcomes = {"found", "missed", "refused", "failed"};
  const rockyard::core::TestFolder folder;
  const DamagedPairs pairs(folder.path());
  return rockyard::core::FuzzStudy(count, arguments, [&](auto seed, auto number) {
    const CylinderVerdict verdict = pairs.Judge(seed, number);
    return rockyard::core::JudgedCase{
        "pair", kOutcomes.at(static_cast<std::size_t>(verdict.outcome)),
        verdict.outcome == CylinderOutcome::kFailed ? verdict.what : ""};
  });
}
