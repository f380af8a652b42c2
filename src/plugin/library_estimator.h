// Estimators of a shared library. A failure throws navigation::NavigatorFault: the drive ends as
// one whose navigator failed, and the reason names the estimator.
#pragma once

#include <cstddef>
#include <memory>

#include "plugin/foreign_estimator.h"
#include "plugin/library_calls.h"

namespace rockyard::plugin {

// Returns the source of the estimators at a place of the library's list.
std::shared_ptr<const EstimatorSource> MakeLibraryEstimators(
    std::shared_ptr<const LoadedLibrary> library, std::size_t place,
    std::unique_ptr<const Description> description);

}  // namespace rockyard::plugin
