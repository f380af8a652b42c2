// What a navigator answered in one drive, as bytes, and a navigator that gives the same answers
// again: by them the physics of a drive is driven again bit for bit, also where whoever decided
// cannot be asked again or would not repeat itself. Benchmarks record and verify by it.
//
// Must stay: the bytes, as entries of benchmarks keep them (kActionLogHead names the version).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "navigation/navigator.h"
#include "navigation/navigator_set_params.h"

namespace rockyard::navigation {

inline constexpr std::string_view kActionLogHead = "rockyard actions 1\n";

// Takes the log of a drive when its navigator is gone. `random_seed` is that of its setup, which
// names the trial. Must not throw. A drive that is begun anew gives its log anew.
using ActionSink = std::function<void(std::uint64_t random_seed, std::string log)>;
// Returns the log of a drive.
using ActionSource = std::function<std::string(std::uint64_t random_seed)>;

// Returns the kind with navigators whose answers are recorded. They decide as without; name,
// parameters and traits are those of `kind`.
std::unique_ptr<NavigatorKind> Recorded(std::unique_ptr<NavigatorKind> kind, ActionSink sink);

// Returns the kind with navigators that give the answers of a log in their order, with the counts
// of plans and the own values that the log ends with; nobody of `kind` is asked. Where a log is no
// log or has no further answer, the drive ends by a NavigatorFault. What they show (view) is empty.
std::unique_ptr<NavigatorKind> Played(std::unique_ptr<NavigatorKind> kind, ActionSource source);

}  // namespace rockyard::navigation
