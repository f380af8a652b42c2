// The kernels of plane_batch, by the registers that they are compiled for. Another kernel needs its
// file here, its flags in CMakeLists.txt, a row in plane_batch.cc, where the processor is asked,
// and its whole numbers in spread_lanes.h.
#pragma once

#include <cstddef>
#include <cstdint>

#include "math/plane_kernel.h"

namespace rockyard::math {

// Each is a FitPlaneRows. Quads and octets are there on x86 only, and may be called only where the
// processor has such registers.
void FitPlanesByPairs(const std::uint64_t* moments, std::size_t size, PlaneParts parts,
                      double* planes);
void FitPlanesByQuads(const std::uint64_t* moments, std::size_t size, PlaneParts parts,
                      double* planes);
void FitPlanesByOctets(const std::uint64_t* moments, std::size_t size, PlaneParts parts,
                       double* planes);

}  // namespace rockyard::math
