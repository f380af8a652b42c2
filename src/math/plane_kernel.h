// The loop that fits a batch of planes, compiled once for each width of registers: what PlaneBatch
// calls.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace rockyard::math {

// Number of sets in a batch. Kernels go on past the last set to fill twin registers of up to 2 x 8
// numbers, so that it must be a multiple of 16.
inline constexpr std::size_t kPlaneBatch = 32;

// A kernel reads and writes rows of kPlaneBatch numbers. MomentRow must be PointMoments::Index, as
// plane_batch.cc checks.
enum MomentRow : std::size_t {
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

// Fits planes to the first `size` sets of moments, and to as many more as fill its registers. Each
// of these sets must have a point.
using FitPlaneRows = void (*)(const std::uint64_t* moments, std::size_t size, PlaneParts parts,
                              double* planes);

struct PlaneKernel {
  std::string_view name;
  FitPlaneRows fit;
};

// Returns the kernels that this processor can run, from the narrowest to the widest.
std::span<const PlaneKernel> PlaneKernels();

// Returns the kernel to use: the widest of PlaneKernels().
const PlaneKernel& BestPlaneKernel();

}  // namespace rockyard::math
