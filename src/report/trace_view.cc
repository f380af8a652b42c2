#include "report/trace_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace rockyard::report {
namespace {

bool SameBits(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

}  // namespace

const truth::TraceSample* SampleAt(std::span<const truth::TraceSample> samples, double time_s) {
  const auto after = std::upper_bound(
      samples.begin(), samples.end(), time_s,
      [](double t, const truth::TraceSample& sample) { return t < sample.time_s; });
  return after == samples.begin() ? nullptr : &*(after - 1);
}

std::vector<std::string> RecordDifferences(const truth::RecordSchema& schema,
                                           const truth::Record& stored, const truth::Record& now) {
  std::vector<std::string> differences;
  if (stored.outcome != now.outcome) {
    differences.push_back(fmt::format("outcome: stored {}, now {}", truth::Name(stored.outcome),
                                      truth::Name(now.outcome)));
  }
  if (stored.detail != now.detail) {
    differences.push_back(
        fmt::format("detail: stored \"{}\", now \"{}\"", stored.detail, now.detail));
  }
  if (stored.values.size() != now.values.size()) {
    differences.push_back(
        fmt::format("values: stored {}, now {}", stored.values.size(), now.values.size()));
    return differences;
  }
  for (std::size_t i = 0; i < now.values.size(); ++i) {
    if (SameBits(stored.values[i], now.values[i])) continue;
    const std::string name = i < schema.size() ? schema[i].name : fmt::format("value {}", i);
    differences.push_back(
        fmt::format("{}: stored {}, now {}", name, stored.values[i], now.values[i]));
  }
  return differences;
}

}  // namespace rockyard::report
