#include "localization/gate.h"

#include <limits>

#include "core/check.h"
#include "core/distributions.h"

namespace rockyard::localization {

Gate::Gate(const GateParams& params) : patience_(params.patience) {
  for (int values = 1; values <= kMostValues; ++values) {
    limit_[static_cast<std::size_t>(values)] =
        params.chance > 0.0 ? core::ChiSquaredQuantile(1.0 - params.chance, values)
                            : std::numeric_limits<double>::infinity();
  }
}

GateAnswer Gate::Ask(double mahalanobis_squared, int values) {
  EXPECT(values >= 1 && values <= kMostValues);
  if (mahalanobis_squared <= limit_[static_cast<std::size_t>(values)]) {
    turned_away_ = 0;
    return GateAnswer::kIn;
  }
  ++turned_away_;
  if (patience_ == 0 || turned_away_ < patience_) return GateAnswer::kOut;
  turned_away_ = 0;
  return GateAnswer::kDoubtYourself;
}

}  // namespace rockyard::localization
