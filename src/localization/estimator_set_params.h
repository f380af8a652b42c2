/// @file
/// The estimators that a scenario can name: each with its parameters and how it is made. A drive
/// makes the one that is chosen; programs add estimators of their own to the set.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/fields.h"
#include "core/kind_set.h"
#include "localization/dead_reckoning_params.h"
#include "math/pose.h"
#include "messages/calibration.h"
#include "messages/navigation_view.h"

namespace rockyard::localization {

class Estimator;
struct EstimatorMemory;

/// The lander in whose frame goals are told.
struct LanderFrame {
  double x_m = 0.0;  ///< where the lander stands, in W
  double y_m = 0.0;
  double pan_sd_rad = 0.0;  ///< standard deviation of the pan angle of its mast
};

/// What an estimator gets at the start of a drive, beside its parameters. How wheels, gyro and
/// accelerometers are read is the same for all estimators.
struct EstimatorSetup {
  messages::DriveCalibration calibration{};  ///< what the rover believes of its wheels
  DeadReckoningParams dead_reckoning{};
  AttitudeParams attitude{};
  /// Where operators put the rover down, in W; with `memory` the remembered pose, in the frame in
  /// which goals are told.
  math::Pose2 start{};
  std::optional<LanderFrame> lander{};  ///< empty: goals are told in the world frame
  /// What the estimator of the drive before kept; null where operators put the rover down.
  const EstimatorMemory* memory = nullptr;
  /// For whoever asks an estimator that is no part of the program: the most CPU time of one call,
  /// and of all calls of a drive (navigation.limits).
  double call_cpu_s = 60.0;
  double drive_cpu_s = 600.0;
};

/// All that is needed to add an estimator. `Params` has `void Visit(core::FieldVisitor&)`; one
/// without parameters takes core::NoParams.
template <typename Params>
struct EstimatorDescription {
  /// The value of localization.estimator and the name of the group of its parameters; a literal.
  std::string_view name;
  std::string_view doc;  ///< what the group says of itself; a literal
  std::unique_ptr<Estimator> (*make)(const Params&, const EstimatorSetup&) = nullptr;
  bool takes_fixes = false;    ///< whether it uses poses that aids measure (PoseFix)
  bool takes_motions = false;  ///< whether it uses motions between two moments (RelativeMotion)
  /// What Estimator::own_values() returns: columns of records, in this order.
  std::vector<messages::OwnValue> own_values = {};
};

/// One estimator of a set, whatever its parameters.
class EstimatorKind : public core::Kind {
 public:
  using core::Kind::Kind;

  /// Makes the estimator of a drive, with the parameters of this kind. Draws no random numbers.
  virtual std::unique_ptr<Estimator> Make(const EstimatorSetup& setup) const = 0;
  /// Return whether it uses poses that aids measure, and motions between two moments.
  virtual bool takes_fixes() const = 0;
  virtual bool takes_motions() const = 0;
  /// Returns what it counts for itself.
  virtual std::span<const messages::OwnValue> own_values() const = 0;
  /// Returns whether it is a plugin, which the program does not answer for.
  virtual bool foreign() const { return false; }
  /// Returns a copy with parameters of its own.
  virtual std::unique_ptr<EstimatorKind> Clone() const = 0;
};

/// The estimators that a scenario can name. A set can be copied.
class EstimatorSet : public core::KindSet<EstimatorKind> {
 public:
  /// Makes an empty set.
  EstimatorSet();

  /// Adds an estimator. Throws core::UserError where the name is taken or cannot be a key. Callers
  /// include localization/estimator.h.
  template <typename Params>
  void Add(const EstimatorDescription<Params>& description, Params params = {}) {
    AddKind(std::make_unique<KindOf<Params>>(description, std::move(params)));
  }
  /// Adds a kind; throws as above.
  void Add(std::unique_ptr<EstimatorKind> kind) { AddKind(std::move(kind)); }

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
    std::span<const messages::OwnValue> own_values() const override {
      return description.own_values;
    }
    std::unique_ptr<EstimatorKind> Clone() const override {
      return std::make_unique<KindOf>(*this);
    }

    EstimatorDescription<Params> description;
  };
};

}  // namespace rockyard::localization
