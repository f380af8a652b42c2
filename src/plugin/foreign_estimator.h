// Estimators that the program does not hold: of a shared library (library.h), as kinds of an
// EstimatorSet. Scenarios add them (plugin_use.h).
#pragma once

#include <span>

#include "localization/estimator.h"
#include "localization/estimator_set_params.h"
#include "plugin/foreign_source.h"

namespace rockyard::plugin {

// Where estimators of one kind come from. Shared by all copies of the kind; any thread may call it.
class EstimatorSource
    : public CheckedSource<localization::Estimator, localization::EstimatorSetup> {
 public:
  using CheckedSource::CheckedSource;
};

// A kind of such estimators, with its parameters.
class ForeignEstimatorKind final
    : public CheckedKind<ForeignEstimatorKind, localization::EstimatorKind, EstimatorSource,
                         localization::Estimator, localization::EstimatorSetup> {
 public:
  using CheckedKind::CheckedKind;

  bool takes_fixes() const override { return description().takes_fixes; }
  bool takes_motions() const override { return description().takes_motions; }
  std::span<const messages::OwnValue> own_values() const override {
    return description().own_values;
  }
};

}  // namespace rockyard::plugin
