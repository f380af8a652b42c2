// Which peak of a scanline is which laser's stripe, where several lasers are on in one image.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "perception/stripe_peaks.h"
#include "perception/stripe_search.h"

namespace rockyard::perception {

// Returns for each laser (left to right, as in `searches`) the index of its peak in `peaks` (left
// to right), or none. A peak is taken for a laser only within its searched columns, and for one
// laser only; stripes keep their order. Among the assignments that are left, the brightest is taken
// (sum of peak heights; the one nearer to the datum columns if equal), or, with kNearestToDatum,
// among those with most peaks the one nearest to the datum columns. With one laser this is its
// strongest or nearest peak.
//
// The order of stripes is an assumption: a rock on the inner stripe can throw its image past that
// of a pit on the outer one, where the searched columns overlap. Cost: lasers times peaks.
std::vector<std::optional<std::size_t>> AssociatePeaks(std::span<const StripeSearch> searches,
                                                       std::span<const StripePeak> peaks,
                                                       PeakChoice choice);

}  // namespace rockyard::perception
