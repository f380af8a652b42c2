// The kernel of registers of 2 numbers, which every 64-bit processor has. All other kernels must
// equal it bit for bit.
#include "math/plane_lanes.h"
#include "math/plane_widths.h"

namespace rockyard::math {

void FitPlanesByPairs(const std::uint64_t* moments, std::size_t size, PlaneParts parts,
                      double* planes) {
  FitPlanesBy<Twin<Pair>>(moments, size, parts, planes);
}

}  // namespace rockyard::math
