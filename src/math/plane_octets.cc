// The kernel of registers of 8 numbers.
#include "math/plane_lanes.h"
#include "math/plane_widths.h"

namespace rockyard::math {

#if defined(__x86_64__)
void FitPlanesByOctets(const std::uint64_t* moments, std::size_t size, PlaneParts parts,
                       double* planes) {
  FitPlanesBy<Twin<Octet>>(moments, size, parts, planes);
}
#endif

}  // namespace rockyard::math
