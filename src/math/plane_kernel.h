// The loop that fits a batch of planes, compiled once for each width of registers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace rockyard::math {

// Kernels fit whole registers, up to twice 8 numbers, and go on past the last set to fill one: a
// multiple of 16.
inline constexpr std::size_t kPlaneBatch = 32;

// What a kernel reads and writes: rows of kPlaneBatch numbers.
enum MomentRow : std::size_t {  // as PointMoments::Index
  kCountRow,
  kXRow,
  kYRow,
  kZRow,
  kXXRow,
  kYYRow,
  kZZRow,
  kXYRow,
  kXZRow,
  kYZRow,
  kMomentRows
};
enum PlaneRow : std::size_t {
  kResidualRow,
  kEigenRatioRow,
  kNormalXRow,
  kNormalYRow,
  kNormalZRow,
  kPlaneRows
};

// Whether the normals of planes are asked for.
enum class PlaneParts { kWithoutNormals, kWithNormals };

// Fits planes to the first `size` sets of moments, and to as many more as fill its registers, each
// of which has a point.
using FitPlaneRows = void (*)(const std::uint64_t* moments, std::size_t size, PlaneParts parts,
                              double* planes);

struct PlaneKernel {
  std::string_view name;
  FitPlaneRows fit;
};

// Returns the kernels that this processor can run, from the narrowest to the widest.
std::span<const PlaneKernel> PlaneKernels();

// Returns the one to use: the widest.
const PlaneKernel& BestPlaneKernel();

}  // namespace rockyard::math
