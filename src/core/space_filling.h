// Points that fill the unit cube evenly: designs of sweeps, and the triples that the alignment of
// stereo rows tries. Must stay: draws and their order (of a dimension all slices of a Latin
// hypercube, then the places in them). Stores keep a sweep as text, and `rockyard merge` makes its
// cells anew.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rockyard::core {

// One point of [0, 1)^dimensions per element.
using UnitPoints = std::vector<std::vector<double>>;

// Most dimensions of a design, and the substream at which those of Sobol points begin. Must stay:
// another number gives another Sobol design for every seed.
inline constexpr std::size_t kMaxDesignDimensions = 100;

// Returns a Latin hypercube (McKay, Beckman and Conover 1979): every axis is cut into `points`
// slices of equal width, and each slice of each axis holds exactly one point, uniform within it.
// Another number of points gives another design. Randomness: Philox, `seed`, Purpose::kDesign, one
// substream per dimension. Cost: points times dimensions. 1 <= dimensions <= kMaxDesignDimensions.
UnitPoints LatinHypercube(std::size_t points, std::size_t dimensions, std::uint64_t seed);

// Returns the first points of the Sobol sequence (Sobol 1967, directions of Joe and Kuo 2008 as in
// Boost.Random), the origin included, with a random digital shift (Cranley and Patterson 1976 in
// base 2: every coordinate's bits are flipped by one random word per dimension), which keeps the
// net property: of 2^m points, each of 2^m equal slices of an axis holds exactly one. More points
// go on with the same sequence. Best with powers of 2. Randomness: Philox, `seed`,
// Purpose::kDesign, substreams from kMaxDesignDimensions on. Cost and limits are those of
// LatinHypercube.
UnitPoints SobolPoints(std::size_t points, std::size_t dimensions, std::uint64_t seed);

}  // namespace rockyard::core
