// Many damaged inputs, for a program of its own: NAME SEED FIRST COUNT. Built with the preset asan
// it finds crashes, leaks and huge allocations too; a case of more than a minute ends it. Each case
// is made of the seed and its own number. Exit code: 0 no failure, 1 failures, 2 bad arguments.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

namespace rockyard::core {

struct JudgedCase {
  std::string kind;     // of the input, for the table
  std::string outcome;  // "read", "refused", ...
  std::string failure;  // what is wrong; empty: nothing
};

// Of a reader, whose outcomes are kRead, kRefused and kFailed.
template <typename Verdict>
JudgedCase OfReader(const std::string& kind, const Verdict& verdict) {
  using Outcome = decltype(verdict.outcome);
  if (verdict.outcome == Outcome::kFailed) return {kind, "failed", verdict.what};
  return {kind, verdict.outcome == Outcome::kRead ? "read" : "refused", ""};
}

// `judge(seed, number)` makes a case and tries it.
template <typename Judge>
int FuzzStudy(int count, char** arguments, const Judge& judge) {
  constexpr unsigned kLongest_s = 60;
  if (count != 4) {
    std::fprintf(stderr, "usage: %s SEED FIRST COUNT\n", arguments[0]);
    return 2;
  }
  const std::uint64_t seed = std::strtoull(arguments[1], nullptr, 10);
  const auto first = static_cast<std::uint32_t>(std::strtoull(arguments[2], nullptr, 10));
  const auto cases = static_cast<std::uint32_t>(std::strtoull(arguments[3], nullptr, 10));
  std::map<std::string, int> counts;
  int failures = 0;
  double slowest_s = 0.0;
  for (std::uint32_t number = first; number < first + cases; ++number) {
    alarm(kLongest_s);
    const auto start = std::chrono::steady_clock::now();
    const JudgedCase judged = judge(seed, number);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    slowest_s = std::max(slowest_s, took.count());
    ++counts[judged.kind + " " + judged.outcome];
    if (judged.failure.empty()) continue;
    ++failures;
    std::printf("case %u, %s: %s\n", number, judged.kind.c_str(), judged.failure.c_str());
  }
  for (const auto& [what, times] : counts) std::printf("%6d %s\n", times, what.c_str());
  std::printf("%u cases, %d failures; slowest %.3f s\n", cases, failures, slowest_s);
  return failures == 0 ? 0 : 1;
}

}  // namespace rockyard::core
