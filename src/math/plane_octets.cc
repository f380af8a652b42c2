// The kernel of registers of 8 numbers, compiled with AVX-512: it runs only where plane_batch.cc
// has asked the processor, and leaves no code that other files could use.
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
