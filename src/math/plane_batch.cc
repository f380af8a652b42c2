#include "math/plane_batch.h"

#include <algorithm>
#include <array>
#include <span>

#include "math/plane_widths.h"

namespace rockyard::math {
namespace {

static_assert(kCountRow == std::size_t{PointMoments::kCount} &&
              kXRow == std::size_t{PointMoments::kX} && kXXRow == std::size_t{PointMoments::kXX} &&
              kXYRow == std::size_t{PointMoments::kXY} &&
              kYZRow == std::size_t{PointMoments::kYZ} &&
              kMomentRows == std::size_t{PointMoments::kSize});

#if defined(__x86_64__)
// The kernels from the narrowest to the widest. Must stay in this order: RunnableKernels counts
// from the front, BestPlaneKernel takes the back.
constexpr std::array<PlaneKernel, 3> kKernels = {{{"pairs", FitPlanesByPairs},
                                                  {"quads (AVX2)", FitPlanesByQuads},
                                                  {"octets (AVX-512)", FitPlanesByOctets}}};

std::size_t RunnableKernels() {
  if (!__builtin_cpu_supports("avx2")) return 1;
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") ? 3 : 2;
}
#else
constexpr std::array<PlaneKernel, 1> kKernels = {{{"pairs", FitPlanesByPairs}}};

std::size_t RunnableKernels() { return 1; }
#endif

}  // namespace

std::span<const PlaneKernel> PlaneKernels() {
  static const std::size_t count = RunnableKernels();
  return std::span<const PlaneKernel>(kKernels).first(count);
}

const PlaneKernel& BestPlaneKernel() { return PlaneKernels().back(); }

PlaneBatch::PlaneBatch() {
  // Lanes behind the last set take part. Until they have held a set, they hold one point at the
  // origin: every set must have a point.
  std::fill_n(moments_.begin() + kCountRow * kSize, kSize, 1);
}

void PlaneBatch::Fit(PlaneParts parts, const PlaneKernel& kernel) {
  kernel.fit(moments_.data(), size_, parts, planes_.data());
}

}  // namespace rockyard::math
