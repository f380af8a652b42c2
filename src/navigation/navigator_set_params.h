// The navigators that a scenario can name: each with its parameters, its traits and how it is made.
#pragma once

#include <concepts>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/check.h"
#include "core/fields.h"
#include "messages/estimates.h"
#include "messages/route.h"
#include "navigation/navigator_traits_params.h"

namespace rockyard::navigation {

class Navigator;

// What a navigator gets at the start of a drive, beside its parameters.
struct NavigatorSetup {
  messages::Goal goal;
  bool judges_hazards = true;  // false: perception reports no hazards, the rover drives blind
  messages::Route route = {};  // to the goal, for one that follows it; empty where there is none
};

// All that is needed to add a navigator. `Params` has `void Visit(core::FieldVisitor&)`.
template <typename Params>
struct NavigatorDescription {
  std::string_view name;  // in navigation.navigator, and of the group of its parameters; a literal
  std::string_view doc;   // of that group; a literal
  NavigatorTraits (*traits)(const Params&) = nullptr;
  std::unique_ptr<Navigator> (*make)(const Params&, const NavigatorSetup&) = nullptr;
};

// One of a set, whatever its parameters.
class NavigatorKind {
 public:
  NavigatorKind(std::string_view name, std::string_view doc) : name_(name), doc_(doc) {}
  virtual ~NavigatorKind() = default;

  std::string_view name() const { return name_; }
  std::string_view doc() const { return doc_; }
  // Of one of its parameters, in a scenario.
  std::string PathOf(std::string_view parameter) const {
    return "navigation." + std::string(name_) + "." + std::string(parameter);
  }

  virtual void Visit(core::FieldVisitor& v) = 0;
  virtual NavigatorTraits traits() const = 0;
  virtual std::unique_ptr<Navigator> Make(const NavigatorSetup& setup) const = 0;
  virtual std::unique_ptr<NavigatorKind> Clone() const = 0;

 protected:
  NavigatorKind(const NavigatorKind&) = default;

 private:
  std::string_view name_;
  std::string_view doc_;
};

// A value: a copy has parameters of its own. The first navigator that is added is chosen until
// another one is.
class NavigatorSet {
 public:
  NavigatorSet() = default;
  NavigatorSet(const NavigatorSet& other);
  NavigatorSet& operator=(const NavigatorSet& other);
  NavigatorSet(NavigatorSet&&) = default;
  NavigatorSet& operator=(NavigatorSet&&) = default;
  ~NavigatorSet() = default;

  // Throws core::UserError where the name is taken, by a navigator or by another key of
  // "navigation", or is no key at all (lower case, digits, underscores). Needs
  // navigation/navigator.h.
  template <typename Params>
  void Add(const NavigatorDescription<Params>& description, Params params = {}) {
    AddKind(std::make_unique<KindOf<Params>>(description, std::move(params)));
  }

  std::span<const std::string_view> names() const { return names_; }
  std::span<const std::unique_ptr<NavigatorKind>> kinds() const { return kinds_; }

  // Throws core::UserError where no navigator has that name.
  void Choose(std::string_view name);
  const NavigatorKind& chosen() const;

  // The parameters of the navigator that has such; there must be one.
  template <typename Params>
  Params& params() {
    return Find<WithParams<Params>>(*this).params;
  }
  template <typename Params>
  const Params& params() const {
    return Find<const WithParams<Params>>(*this).params;
  }

  // Lists the choice, then a group for each navigator, in the group that is being visited.
  void Visit(core::FieldVisitor& v);

 private:
  // Apart from how it is made, which needs the whole Navigator: who reads parameters sees no more
  // of it than its name.
  template <typename Params>
  struct WithParams : NavigatorKind {
    WithParams(const NavigatorDescription<Params>& of, Params values)
        : NavigatorKind(of.name, of.doc), description(of), params(std::move(values)) {}

    void Visit(core::FieldVisitor& v) override { params.Visit(v); }
    NavigatorTraits traits() const override { return description.traits(params); }

    NavigatorDescription<Params> description;
    Params params;
  };

  template <typename Params>
  struct KindOf final : WithParams<Params> {
    using WithParams<Params>::WithParams;

    std::unique_ptr<Navigator> Make(const NavigatorSetup& setup) const override {
      return this->description.make(this->params, setup);
    }
    std::unique_ptr<NavigatorKind> Clone() const override {
      return std::make_unique<KindOf>(*this);
    }
  };

  template <typename Kind, typename Set>
  static Kind& Find(Set& set) {
    Kind* found = nullptr;
    for (const auto& kind : set.kinds_) {
      if (found == nullptr) found = dynamic_cast<Kind*>(kind.get());
    }
    EXPECT(found != nullptr);
    return *found;
  }

  void AddKind(std::unique_ptr<NavigatorKind> kind);

  std::vector<std::unique_ptr<NavigatorKind>> kinds_;
  std::vector<std::string_view> names_;  // in the same order
  int chosen_ = 0;
};

}  // namespace rockyard::navigation
