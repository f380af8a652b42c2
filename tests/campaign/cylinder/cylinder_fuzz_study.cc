// Gives `rockyard cylinder`'s work many damaged images: cylinder_fuzz SEED FIRST COUNT. Each case
// is made of the seed and its own number. Exit code: 0 no failure, 1 failures, 2 bad arguments.
#include <array>
#include <cstdio>
#include <cstdlib>

#include "campaign/cylinder/painted_files.h"
#include "core/test_folder.h"

namespace rockyard::campaign {
namespace {

int Run(std::uint64_t seed, std::uint32_t first, std::uint32_t count) {
  const core::TestFolder folder;
  const DamagedPairs pairs(folder.path());
  std::array<int, 4> counts{};
  for (std::uint32_t number = first; number < first + count; ++number) {
    const CylinderVerdict verdict = pairs.Judge(seed, number);
    ++counts.at(static_cast<std::size_t>(verdict.outcome));
    if (verdict.outcome == CylinderOutcome::kFailed) {
      std::printf("case %u: %s\n", number, verdict.what.c_str());
    }
  }
  std::printf("%d found, %d missed, %d refused, %d failed\n", counts[0], counts[1], counts[2],
              counts[3]);
  return counts[3] == 0 ? 0 : 1;
}

}  // namespace
}  // namespace rockyard::campaign

int main(int count, char** arguments) {
  if (count != 4) {
    std::fputs("usage: cylinder_fuzz SEED FIRST COUNT\n", stderr);
    return 2;
  }
  const auto number = [&](int i) { return std::strtoull(arguments[i], nullptr, 10); };
  return rockyard::campaign::Run(number(1), static_cast<std::uint32_t>(number(2)),
                                 static_cast<std::uint32_t>(number(3)));
}
