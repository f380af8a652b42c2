/// @file
/// Makes a plugin of readers of images, header only, as navigator_plugin.h makes one of navigators:
///
///   perception::PointReaderDescription<MineParams> DescribeMine();  // as for a program's own
///   ROCKYARD_READERS(DescribeMine)
///
/// Class, parameters and description are the same as those of a reader that a program links. A
/// library may name readers, navigators and estimators in one ROCKYARD_PLUGIN. What a reader throws
/// ends its drive as a fault of the navigator.
#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "core/fields.h"
#include "math/pose.h"
#include "messages/look_images.h"
#include "perception/point_reader.h"
#include "perception/point_reader_set_params.h"
#include "plugin/abi.h"
#include "plugin/plugin_fields.h"

namespace rockyard::plugin {

/// What follows is for the macro alone.
namespace layer {

/// A reader with the points that it handed over last.
struct HeldReader {
  std::unique_ptr<perception::PointReader> reader;
  std::vector<math::Vector3> points_R;
};

/// The functions of one kind of reader. `Describe` returns its PointReaderDescription.
template <auto Describe, typename Params>
struct ReaderType {
  static int DescribeIt(rockyard_take_text take, void* to, rockyard_error* error) noexcept {
    return Guarded(error, [&] {
      const auto description = Describe();
      JsonLine json;
      WriteDescription<Params>(description, json);
      json.Raw("}");
      take(to, json.text().data(), json.text().size());
    });
  }

  static int Create(const rockyard_values* values, const rockyard_reader_setup* setup,
                    void** reader, rockyard_error* error) noexcept {
    return Guarded(error, [&] {
      auto held = std::make_unique<HeldReader>();
      held->reader =
          Describe().make(WithValues<Params>(*values),
                          {.rover = Rover(setup->rover), .max_range_m = setup->max_range_m});
      if (held->reader == nullptr) throw std::runtime_error("it made no reader");
      *reader = held.release();
    });
  }

  static int Points(void* reader, const rockyard_images* images, const double** points_R,
                    std::size_t* count, rockyard_error* error) noexcept {
    return Guarded(error, [&] {
      static_assert(sizeof(math::Vector3) == 3 * sizeof(double));
      auto& held = *static_cast<HeldReader*>(reader);
      held.points_R = held.reader->Points(Images(*images));
      *points_R = held.points_R.empty() ? nullptr : held.points_R.front().data();
      *count = held.points_R.size();
    });
  }

  static void Destroy(void* reader) noexcept { delete static_cast<HeldReader*>(reader); }

  static constexpr rockyard_reader_type kType{DescribeIt, Check<Params>, Create, Points, Destroy};
};

/// What ROCKYARD_PLUGIN takes of a reader.
template <auto Describe, typename Params>
struct TypeOf<Describe, perception::PointReaderDescription<Params>> : ReaderType<Describe, Params> {
};

}  // namespace layer
}  // namespace rockyard::plugin

/// Makes the library a plugin of readers, each named by the function that returns its
/// PointReaderDescription. Stands once in a library, outside of all namespaces. ROCKYARD_PLUGIN is
/// the same, and takes navigators and estimators beside them.
#define ROCKYARD_READERS(...) ROCKYARD_PLUGIN(__VA_ARGS__)
