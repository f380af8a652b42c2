/// @file
/// A set of kinds of one thing, each with a name that a scenario can choose and with parameters of
/// its own: the navigators, the estimators, the readers of images, the terrain sensors.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/check.h"
#include "core/fields.h"

namespace rockyard::core {

/// How a set appears in a scenario. Views of literals.
struct KindSetWords {
  std::string_view group;                    ///< "navigation": where it is listed
  std::string_view key;                      ///< "navigator": the choice
  std::string_view one;                      ///< "a navigator", in messages
  std::span<const std::string_view> others;  ///< the group's other keys, which no kind may have
  FieldInfo choice;                          ///< what the choice means
};

/// Parameters of a kind that has none.
struct NoParams {
  /// Lists nothing.
  void Visit(FieldVisitor& /*v*/) {}
};

/// A kind of a set, whatever its parameters. The Base of a KindSet derives from it and adds
/// Clone(), which returns a pointer to that Base.
class Kind {
 public:
  /// Literals: the name, and what the group of its parameters is for.
  Kind(std::string_view name, std::string_view doc) : name_(name), doc_(doc) {}
  virtual ~Kind() = default;

  /// Returns the name by which a scenario chooses it.
  std::string_view name() const { return name_; }
  /// Returns what the group of its parameters is for.
  std::string_view doc() const { return doc_; }

  /// Returns whether it has a group of parameters.
  virtual bool has_params() const = 0;
  /// Lists its parameters.
  virtual void Visit(FieldVisitor& v) = 0;

 protected:
  Kind(const Kind&) = default;

 private:
  std::string_view name_;
  std::string_view doc_;
};

/// A kind with its parameters, and without how its thing is made: code that reads parameters need
/// not include the thing.
template <typename Base, typename Params>
struct KindWithParams : Base {
  /// Name and doc are literals, as of Kind.
  KindWithParams(std::string_view name, std::string_view doc, Params values)
      : Base(name, doc), params(std::move(values)) {}

  bool has_params() const override { return !std::is_same_v<Params, NoParams>; }
  void Visit(FieldVisitor& v) override { params.Visit(v); }

  Params params;
};

/// Throws UserError where the name is taken, by a kind or by another key of the group, or is no key
/// at all (lower case, digits, underscores).
void RequireNewKind(const KindSetWords& words, std::span<const std::string_view> names,
                    std::string_view name);

/// Returns the place of a name. Throws UserError where it is not there.
int FindKind(const KindSetWords& words, std::span<const std::string_view> names,
             std::string_view name);

/// A set of kinds. A value: a copy has parameters of its own. The first kind that is added is
/// chosen until another one is. Fingerprints of scenarios depend on the order in which kinds are
/// added, as resolved scenarios list them so.
template <typename Base>
class KindSet {
 public:
  /// An empty set.
  explicit KindSet(const KindSetWords& words) : words_(words) {}
  KindSet(const KindSet& other)
      : words_(other.words_), names_(other.names_), chosen_(other.chosen_) {
    kinds_.reserve(other.kinds_.size());
    for (const auto& kind : other.kinds_) kinds_.push_back(kind->Clone());
  }
  KindSet& operator=(const KindSet& other) {
    *this = KindSet(other);
    return *this;
  }
  KindSet(KindSet&&) noexcept = default;
  KindSet& operator=(KindSet&&) noexcept = default;
  ~KindSet() = default;

  /// Returns the names of all kinds, in the order in which they were added; valid until one is
  /// added.
  std::span<const std::string_view> names() const { return names_; }
  /// Returns the kinds, in the same order.
  std::span<const std::unique_ptr<Base>> kinds() const { return kinds_; }

  /// Chooses a kind. Throws UserError where none has that name.
  void Choose(std::string_view name) { chosen_ = FindKind(words_, names_, name); }
  /// Returns a kind. Throws UserError where none has that name.
  const Base& Named(std::string_view name) const {
    return *kinds_.at(static_cast<std::size_t>(FindKind(words_, names_, name)));
  }
  /// Returns the kind that is chosen. Requires at least one kind.
  const Base& chosen() const { return *kinds_.at(static_cast<std::size_t>(chosen_)); }

  /// Returns the parameters of the kind that has such; there must be one.
  template <typename Params>
  Params& params() {
    return Find<KindWithParams<Base, Params>>(*this).params;
  }
  template <typename Params>
  const Params& params() const {
    return Find<const KindWithParams<Base, Params>>(*this).params;
  }

  /// Lists the choice, then a group for each kind with parameters, in the group that is being
  /// visited.
  void Visit(FieldVisitor& v) {
    VisitChoice(v);
    VisitGroups(v);
  }
  /// The two apart, where others stand between them.
  void VisitChoice(FieldVisitor& v) { v.ChoiceOf(words_.key, chosen_, names_, words_.choice); }
  void VisitGroups(FieldVisitor& v) {
    for (const auto& kind : kinds_) {
      if (kind->has_params()) v.Group(kind->name(), *kind, kind->doc());
    }
  }

 protected:
  /// Throws as RequireNewKind.
  void AddKind(std::unique_ptr<Base> kind) {
    RequireNewKind(words_, names_, kind->name());
    names_.push_back(kind->name());
    kinds_.push_back(std::move(kind));
  }

  /// Requires a kind of the name of the chosen one.
  void ReplaceChosen(std::unique_ptr<Base> kind) {
    EXPECT(kind->name() == chosen().name());
    names_.at(static_cast<std::size_t>(chosen_)) = kind->name();
    kinds_.at(static_cast<std::size_t>(chosen_)) = std::move(kind);
  }

 private:
  template <typename Wanted, typename Set>
  static Wanted& Find(Set& set) {
    Wanted* found = nullptr;
    for (const auto& kind : set.kinds_) {
      if (found == nullptr) found = dynamic_cast<Wanted*>(kind.get());
    }
    EXPECT(found != nullptr);
    return *found;
  }

  KindSetWords words_;
  std::vector<std::unique_ptr<Base>> kinds_;
  std::vector<std::string_view> names_;  ///< in the same order
  int chosen_ = 0;
};

}  // namespace rockyard::core
