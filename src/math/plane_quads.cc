// The kernel of registers of 4 numbers, compiled with AVX2. It runs only where plane_batch.cc has
// asked the processor, and must leave no code that the linker could give to other files.
#include "math/plane_lanes.h"
#include "math/plane_widths.h"

namespace rockyard::math {

#if defined(__x86_64__)
void FitPlanesByQuads(const std::uint64_t* moments, std::size_t size, PlaneParts parts,
                      double* planes) {
  FitPlanesBy<Twin<Quad>>(moments, size, parts, planes);
}
#endif

}  // namespace rockyard::math
