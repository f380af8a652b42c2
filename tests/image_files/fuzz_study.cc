// Gives the readers of image files many damaged ones: image_fuzz SEED FIRST COUNT. Built with the
// preset asan it finds crashes, leaks and huge allocations too; a case of more than a minute ends
// it. Each case is made of the seed and its own number. Exit code: 0 no failure, 1 failures, 2 bad
// arguments.
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "core/test_folder.h"
#include "image_files/mutated_files.h"

namespace rockyard::image_files {
namespace {

constexpr unsigned kLongest_s = 60;
constexpr std::uint32_t kCasesALine = 10000;

struct Tally {
  std::map<std::string, std::map<Outcome, int>> of_seed;
  int failures = 0;
  double slowest_s = 0.0;
  std::uint32_t slowest = 0;
};

void Judge(const std::vector<SeedFile>& files, const std::filesystem::path& folder,
           std::uint64_t seed, std::uint32_t number, Tally& tally) {
  const SeedFile file = MutatedFile(files, seed, number);
  alarm(kLongest_s);
  const auto start = std::chrono::steady_clock::now();
  const Verdict verdict = JudgeFile(file, folder);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  ++tally.of_seed[file.name][verdict.outcome];
  if (took.count() > tally.slowest_s) {
    tally.slowest_s = took.count();
    tally.slowest = number;
  }
  if (verdict.outcome == Outcome::kFailed) {
    ++tally.failures;
    std::printf("case %u, %s: %s\n", number, file.name.c_str(), verdict.what.c_str());
  }
}

int Run(std::uint64_t seed, std::uint32_t first, std::uint32_t count) {
  const core::TestFolder folder;
  const std::vector<SeedFile> files = SeedFiles(folder.path());
  Tally tally;
  for (std::uint32_t number = first; number < first + count; ++number) {
    Judge(files, folder.path(), seed, number, tally);
    if ((number + 1) % kCasesALine == 0) std::fprintf(stderr, "%u cases\n", number + 1);
  }
  for (auto& [name, counts] : tally.of_seed) {
    std::printf("%-16s %6d read, %6d refused, %d failed\n", name.c_str(), counts[Outcome::kRead],
                counts[Outcome::kRefused], counts[Outcome::kFailed]);
  }
  std::printf("%u cases, %d failures; slowest %.3f s (case %u)\n", count, tally.failures,
              tally.slowest_s, tally.slowest);
  return tally.failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace rockyard::image_files

int main(int count, char** arguments) {
  if (count != 4) {
    std::fputs("usage: image_fuzz SEED FIRST COUNT\n", stderr);
    return 2;
  }
  const auto number = [&](int i) { return std::strtoull(arguments[i], nullptr, 10); };
  return rockyard::image_files::Run(number(1), static_cast<std::uint32_t>(number(2)),
                                    static_cast<std::uint32_t>(number(3)));
}
