/// @file
/// The readers of images that a scenario can name (perception.reader): each with its parameters and
/// how it is made. Drives make the one that is chosen; programs and plugins add readers of their
/// own.
#pragma once

#include <memory>
#include <string_view>
#include <utility>

#include "core/fields.h"
#include "core/kind_set.h"
#include "messages/calibration.h"

namespace rockyard::perception {

class PointReader;

/// What a reader gets at the start of a drive, beside its parameters.
struct PointReaderSetup {
  messages::RoverBelief rover = {};  ///< what the rover believes of its body, which it may see
  double max_range_m = 0.0;          ///< sensors.stereo.max_range_m: how far it is to see
  /// What a plugin may use: CPU time of one look, and of all looks of a drive.
  double look_cpu_s = 60.0;
  double drive_cpu_s = 600.0;
};

/// All that is needed to add a reader. `Params` has `void Visit(core::FieldVisitor&)`; one without
/// parameters takes core::NoParams.
template <typename Params>
struct PointReaderDescription {
  /// The value of perception.reader and the name of the group of its parameters; a literal.
  std::string_view name;
  std::string_view doc;  ///< what the group says of itself; a literal
  std::unique_ptr<PointReader> (*make)(const Params&, const PointReaderSetup&) = nullptr;
};

/// One reader of a set, whatever its parameters.
class PointReaderKind : public core::Kind {
 public:
  using core::Kind::Kind;

  /// Returns whether it is rockyard's own stereo (stereo_points.h), by which the stereo sensor
  /// reads on its own.
  virtual bool is_own() const { return false; }
  /// Returns whether it is of a plugin, which the program does not answer for.
  virtual bool foreign() const { return false; }
  /// Makes the reader of a drive; null for rockyard's own.
  virtual std::unique_ptr<PointReader> Make(const PointReaderSetup& setup) const = 0;
  /// Returns a copy with parameters of its own.
  virtual std::unique_ptr<PointReaderKind> Clone() const = 0;
};

/// The readers that a scenario can name. A value.
class PointReaderSet : public core::KindSet<PointReaderKind> {
 public:
  /// Makes a set of rockyard's own reader, `stereo`, whose parameters are perception.stereo. It is
  /// the reader of scenarios that name none.
  PointReaderSet();

  /// Adds a reader. Throws core::UserError where the name is taken, by a reader or by another key
  /// of "perception", or cannot be a key. Callers include perception/point_reader.h.
  template <typename Params>
  void Add(const PointReaderDescription<Params>& description, Params params = {}) {
    AddKind(std::make_unique<KindOf<Params>>(description, std::move(params)));
  }
  /// Adds a kind; throws as above.
  void Add(std::unique_ptr<PointReaderKind> kind) { AddKind(std::move(kind)); }

 private:
  template <typename Params>
  struct KindOf final : core::KindWithParams<PointReaderKind, Params> {
    KindOf(const PointReaderDescription<Params>& of, Params values)
        : core::KindWithParams<PointReaderKind, Params>(of.name, of.doc, std::move(values)),
          description(of) {}

    std::unique_ptr<PointReader> Make(const PointReaderSetup& setup) const override {
      return description.make(this->params, setup);
    }
    std::unique_ptr<PointReaderKind> Clone() const override {
      return std::make_unique<KindOf>(*this);
    }

    PointReaderDescription<Params> description;
  };
};

}  // namespace rockyard::perception
