/// @file
/// The estimators that a scenario can name: each with its parameters and how it is made.
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "core/fields.h"
#include "core/kind_set.h"
#include "localization/dead_reckoning_params.h"
#include "math/pose.h"
#include "messages/calibration.h"

namespace rockyard::localization {

class Estimator;
struct EstimatorMemory;

/// The lander, in whose frame goals are told: where it stands, in W, and how well its mast's pan
/// angle is known, a standard deviation.
struct LanderFrame {
  double x_m = 0.0;
  double y_m = 0.0;
  double pan_sd_rad = 0.0;
};

/// What an estimator gets at the start of a drive, beside its parameters: how wheels, gyro and
/// accelerometers are read is the same for all of them.
struct EstimatorSetup {
  /// What the rover believes of its wheels, and how dead reckoning and attitude are worked out.
  messages::DriveCalibration calibration{};
  DeadReckoningParams dead_reckoning{};
  AttitudeParams attitude{};
  math::Pose2 start{};  ///< where operators put the rover down, in the world frame; as
                        ///< remembered, in the frame in which goals are told
  std::optional<LanderFrame> lander{};  ///< empty: goals are told in the world frame
  /// Of the day before, where the rover was not put down but goes on (localization/estimator.h).
  const EstimatorMemory* memory = nullptr;
};

/// All that is needed to add an estimator. `Params` has `void Visit(core::FieldVisitor&)`; one
/// without parameters takes core::NoParams.
template <typename Params>
struct EstimatorDescription {
  /// In localization.estimator, and of the group of its parameters; a literal. Scenarios name it.
  std::string_view name;
  std::string_view doc;  ///< of that group; a literal
  std::unique_ptr<Estimator> (*make)(const Params&, const EstimatorSetup&) = nullptr;
  bool takes_fixes = false;    ///< or has no use for what aids measure of its pose
  bool takes_motions = false;  ///< or for motions between two moments
};

/// One of a set, whatever its parameters.
class EstimatorKind : public core::Kind {
 public:
  using core::Kind::Kind;

  /// Makes one for a drive, with the parameters of this kind. Draws no random numbers.
  virtual std::unique_ptr<Estimator> Make(const EstimatorSetup& setup) const = 0;
  /// Returns whether it uses what aids measure of its pose, and of motions between two moments.
  virtual bool takes_fixes() const = 0;
  virtual bool takes_motions() const = 0;
  /// Returns a copy with parameters of its own.
  virtual std::unique_ptr<EstimatorKind> Clone() const = 0;
};

/// The estimators that a scenario can name. A value.
class EstimatorSet : public core::KindSet<EstimatorKind> {
 public:
  /// An empty set.
  EstimatorSet();

  /// Throws core::UserError where the name is taken or is no key at all. Needs
  /// localization/estimator.h.
  template <typename Params>
  void Add(const EstimatorDescription<Params>& description, Params params = {}) {
    AddKind(std::make_unique<KindOf<Params>>(description, std::move(params)));
  }

 private:
  template <typename Params>
  struct KindOf final : core::KindWithParams<EstimatorKind, Params> {
    KindOf(const EstimatorDescription<Params>& of, Params values)
        : core::KindWithParams<EstimatorKind, Params>(of.name, of.doc, std::move(values)),
          description(of) {}

    std::unique_ptr<Estimator> Make(const EstimatorSetup& setup) const override {
      return description.make(this->params, setup);
    }
    bool takes_fixes() const override { return description.takes_fixes; }
    bool takes_motions() const override { return description.takes_motions; }
    std::unique_ptr<EstimatorKind> Clone() const override {
      return std::make_unique<KindOf>(*this);
    }

    EstimatorDescription<Params> description;
  };
};

}  // namespace rockyard::localization
