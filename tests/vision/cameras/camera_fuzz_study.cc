// Gives the readers of camera files many damaged ones: camera_fuzz SEED FIRST COUNT. Built with the
// preset asan it finds crashes, leaks and huge allocations too; a case of more than a minute ends
// it. Each case is made of the seed and its own number. Exit code: 0 no failure, 1 failures, 2 bad
// arguments.
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "vision/cameras/mutated_cameras.h"

namespace rockyard::vision {
namespace {

constexpr unsigned kLongest_s = 60;

int Run(std::uint64_t seed, std::uint32_t first, std::uint32_t count) {
  const std::vector<CameraSeed> seeds = CameraSeeds();
  std::map<std::string, std::map<CameraOutcome, int>> of_seed;
  int failures = 0;
  double slowest_s = 0.0;
  for (std::uint32_t number = first; number < first + count; ++number) {
    const CameraSeed file = MutatedCamera(seeds, seed, number);
    alarm(kLongest_s);
    const auto start = std::chrono::steady_clock::now();
    const CameraVerdict verdict = JudgeCamera(file);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    slowest_s = std::max(slowest_s, took.count());
    ++of_seed[file.name][verdict.outcome];
    if (verdict.outcome != CameraOutcome::kFailed) continue;
    ++failures;
    std::printf("case %u, %s: %s\n", number, file.name.c_str(), verdict.what.c_str());
  }
  for (auto& [name, counts] : of_seed) {
    std::printf("%-36s %6d read, %6d refused, %d failed\n", name.c_str(),
                counts[CameraOutcome::kRead], counts[CameraOutcome::kRefused],
                counts[CameraOutcome::kFailed]);
  }
  std::printf("%u cases, %d failures; slowest %.3f s\n", count, failures, slowest_s);
  return failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace rockyard::vision

int main(int count, char** arguments) {
  if (count != 4) {
    std::fputs("usage: camera_fuzz SEED FIRST COUNT\n", stderr);
    return 2;
  }
  const auto number = [&](int i) { return std::strtoull(arguments[i], nullptr, 10); };
  return rockyard::vision::Run(number(1), static_cast<std::uint32_t>(number(2)),
                               static_cast<std::uint32_t>(number(3)));
}
