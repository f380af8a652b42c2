#include "core/space_filling.h"

#include <boost/random/sobol.hpp>
#include <numeric>
#include <utility>

#include "core/check.h"
#include "core/random.h"

namespace rockyard::core {
namespace {

RandomStream DesignStream(std::uint64_t seed, std::size_t substream) {
  return {{.seed = seed}, Purpose::kDesign, static_cast<std::uint32_t>(substream)};
}

// Returns a random permutation (Fisher and Yates).
std::vector<std::size_t> Permutation(std::size_t size, RandomStream& stream) {
  std::vector<std::size_t> order(size);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t left = size; left > 1; --left) {
    const auto chosen = static_cast<std::size_t>(stream.Uniform() * static_cast<double>(left));
    std::swap(order[left - 1], order[chosen]);
  }
  return order;
}

// Returns the upper 53 bits as a fraction: exact, and below 1.
double Fraction(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

}  // namespace

UnitPoints LatinHypercube(std::size_t points, std::size_t dimensions, std::uint64_t seed) {
  EXPECT(dimensions >= 1 && dimensions <= kMaxDesignDimensions);
  UnitPoints design(points, std::vector<double>(dimensions));
  for (std::size_t d = 0; d < dimensions; ++d) {
    RandomStream stream = DesignStream(seed, d);
    const std::vector<std::size_t> slices = Permutation(points, stream);
    for (std::size_t i = 0; i < points; ++i) {
      design[i][d] =
          (static_cast<double>(slices[i]) + stream.Uniform()) / static_cast<double>(points);
    }
  }
  return design;
}

UnitPoints SobolPoints(std::size_t points, std::size_t dimensions, std::uint64_t seed) {
  EXPECT(dimensions >= 1 && dimensions <= kMaxDesignDimensions);
  std::vector<std::uint64_t> shifts(dimensions);
  for (std::size_t d = 0; d < dimensions; ++d) {
    shifts[d] = DesignStream(seed, kMaxDesignDimensions + d).NextU64();
  }
  UnitPoints design(points, std::vector<double>(dimensions));
  boost::random::sobol sequence(dimensions);
  for (std::size_t i = 0; i < points; ++i) {
    for (std::size_t d = 0; d < dimensions; ++d) {
      // Boost leaves out the origin, without which 2^m points are no net.
      design[i][d] = Fraction((i == 0 ? 0 : sequence()) ^ shifts[d]);
    }
  }
  return design;
}

}  // namespace rockyard::core
