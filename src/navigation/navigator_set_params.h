/// @file
/// The navigators that a scenario can name: each with its parameters, its traits and how it is
/// made. Scenarios list them, drives make the chosen one, and a program adds its own.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/fields.h"
#include "core/kind_set.h"
#include "messages/calibration.h"
#include "messages/estimates.h"
#include "messages/navigation_view.h"
#include "messages/site_map.h"
#include "navigation/navigator_traits_params.h"

namespace rockyard::navigation {

class Navigator;

/// What a navigator that is no part of the program, a plugin or a process, may use. What exceeds
/// one of these twice in a trial ends the drive (navigator_fault).
struct LimitParams {
  double decision_cpu_s = 60.0;  ///< of one answer
  double drive_cpu_s = 600.0;    ///< of all answers of a drive
  double memory_mb = 4096.0;     ///< of a process, in 2^20 bytes
  double answer_s = 60.0;        ///< of the clock on the wall, while a process uses no CPU time

  void Visit(core::FieldVisitor& v);
};

/// What a navigator gets at the start of a drive, beside its parameters.
struct NavigatorSetup {
  messages::Goal goal;         ///< in the frame in which goals are told
  bool judges_hazards = true;  ///< false: perception reports no hazards, the rover drives blind
  /// Of the fastest rim. The default is Athena's (Howard 2012 sec. 3), as in gestalt/gestalt.h.
  double full_speed_m_s = 0.07;
  messages::Route route = {};  ///< to the goal, for traits().follows_route; else empty
  /// All that the rover is told to drive to, in the order of driving; the first of them is `goal`.
  std::vector<messages::Goal> places = {};
  messages::RoverBelief rover = {};  ///< what it believes of its body
  /// What is known of the site before the drive; null where the scenario has no such map
  /// (course.site_map). Lives as long as the navigator.
  std::shared_ptr<const messages::SiteMap> site_map = {};
  /// For a random generator of the navigator's own: another one in each trial, the same whenever a
  /// trial is run again. It shifts no other noise.
  std::uint64_t random_seed = 0;
  /// Operations a second of the modelled computer (clock.compute.operations_per_s); 0: own
  /// operations take no time.
  double operations_per_s = 0.0;
  double control_period_s = 0.05;  ///< between two ticks
  LimitParams limits = {};         ///< for whoever asks a plugin or process
  /// Is told of a plugin or process when its drive is over; may be empty. Must not throw.
  std::function<void(const messages::NavigatorUse&)> on_end = {};
};

/// All that is needed to add a navigator. `Params` has `void Visit(core::FieldVisitor&)`.
template <typename Params>
struct NavigatorDescription {
  /// The name in navigation.navigator, and of the group of its parameters; a literal.
  std::string_view name;
  std::string_view doc;  ///< of that group; a literal
  /// What a trial has to know of the navigator, and how one is made for a drive.
  NavigatorTraits (*traits)(const Params&) = nullptr;
  std::unique_ptr<Navigator> (*make)(const Params&, const NavigatorSetup&) = nullptr;
  /// What Navigator::own_values() returns: columns of records, in this order.
  std::vector<messages::OwnValue> own_values = {};
};

/// A navigator of a set, whatever its parameters.
class NavigatorKind : public core::Kind {
 public:
  using core::Kind::Kind;

  /// Returns the path of one of its parameters in a scenario.
  std::string PathOf(std::string_view parameter) const {
    return "navigation." + std::string(name()) + "." + std::string(parameter);
  }

  /// Returns what a trial has to know of the navigator, by the parameters of this kind.
  virtual NavigatorTraits traits() const = 0;
  /// Returns what it counts for itself.
  virtual std::span<const messages::OwnValue> own_values() const = 0;
  /// Returns whether it is a plugin or a process, which the program does not answer for.
  virtual bool foreign() const { return false; }
  /// Makes one for a drive.
  virtual std::unique_ptr<Navigator> Make(const NavigatorSetup& setup) const = 0;
  /// Returns a copy with parameters of its own.
  virtual std::unique_ptr<NavigatorKind> Clone() const = 0;
};

/// The navigators that a scenario can name. A value.
class NavigatorSet : public core::KindSet<NavigatorKind> {
 public:
  /// An empty set.
  NavigatorSet();

  /// Adds a navigator. Throws core::UserError where its name is taken, by a navigator or by another
  /// key of "navigation", or is no key at all. The caller includes navigation/navigator.h.
  template <typename Params>
  void Add(const NavigatorDescription<Params>& description, Params params = {}) {
    AddKind(std::make_unique<KindOf<Params>>(description, std::move(params)));
  }
  /// Adds a kind; throws as above.
  void Add(std::unique_ptr<NavigatorKind> kind) { AddKind(std::move(kind)); }

  /// Puts what `wrap` returns in the place of the kind that is chosen. It must have the same name.
  void WrapChosen(
      const std::function<std::unique_ptr<NavigatorKind>(std::unique_ptr<NavigatorKind>)>& wrap) {
    ReplaceChosen(wrap(chosen().Clone()));
  }

 private:
  template <typename Params>
  struct KindOf final : core::KindWithParams<NavigatorKind, Params> {
    KindOf(const NavigatorDescription<Params>& of, Params values)
        : core::KindWithParams<NavigatorKind, Params>(of.name, of.doc, std::move(values)),
          description(of) {}

    NavigatorTraits traits() const override { return description.traits(this->params); }
    std::span<const messages::OwnValue> own_values() const override {
      return description.own_values;
    }
    std::unique_ptr<Navigator> Make(const NavigatorSetup& setup) const override {
      return description.make(this->params, setup);
    }
    std::unique_ptr<NavigatorKind> Clone() const override {
      return std::make_unique<KindOf>(*this);
    }

    NavigatorDescription<Params> description;
  };
};

/// Returns rockyard's own navigators: pathfinder (chosen), gestalt, route, enav. Scenarios that
/// name none drive with the first. Names and order must stay: scenario files and stored runs hold
/// the names, and fingerprints depend on the order.
NavigatorSet StandardNavigators();

}  // namespace rockyard::navigation
