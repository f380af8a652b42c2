#include "vision/cylinder/cylinder_sighting.h"

#include <utility>

#include "core/check.h"

namespace rockyard::vision {

CylinderFinding NotFound(CylinderMiss miss, std::string reason) {
  EXPECT(miss != CylinderMiss::kNone && !reason.empty());
  return {std::nullopt, miss, std::move(reason)};
}

}  // namespace rockyard::vision
