#include "plugin/library_reader.h"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "navigation/navigator_fault.h"

namespace rockyard::plugin {
namespace {

using navigation::FaultKind;
using navigation::NavigatorFault;

// More than any pair of images has pixels (sensors.stereo).
constexpr std::size_t kMostPoints = std::size_t{1} << 23;

// One reader of a library.
class LibraryReader final : public perception::PointReader {
 public:
  LibraryReader(const rockyard_reader_type& type, const std::string& name,
                const perception::PointReaderSetup& setup)
      : calls_("reader " + name + ": ", setup.look_cpu_s, setup.drive_cpu_s), type_(type) {}
  ~LibraryReader() override {
    if (reader_ != nullptr) type_.destroy(reader_);
  }
  LibraryReader(const LibraryReader&) = delete;
  LibraryReader& operator=(const LibraryReader&) = delete;

  void Begin(const Parameters& parameters, const perception::PointReaderSetup& setup) {
    const AbiValues values(parameters);
    const rockyard_reader_setup to{AbiRover(setup.rover), setup.max_range_m};
    calls_.Call(
        [&](rockyard_error* error) { return type_.create(values.get(), &to, &reader_, error); });
    if (reader_ == nullptr) Fail(FaultKind::kThrew, "it made no reader");
  }

  std::vector<math::Vector3> Points(const messages::LookImages& images) const override {
    const rockyard_images from = AbiImages(images);
    const double* points_R = nullptr;
    std::size_t count = 0;
    calls_.Call([&](rockyard_error* error) {
      return type_.points(reader_, &from, &points_R, &count, error);
    });
    if (count > kMostPoints) {
      Fail(FaultKind::kNonsense, fmt::format("{} points, more than {}", count, kMostPoints));
    }
    if (count > 0 && points_R == nullptr) Fail(FaultKind::kNonsense, "points without a list");
    std::vector<math::Vector3> points(count);
    for (std::size_t i = 0; i < count; ++i) {
      points[i] = Eigen::Map<const math::Vector3>(points_R + 3 * i);
      if (!points[i].allFinite()) {
        Fail(FaultKind::kNonsense, fmt::format("point {} is no place", i));
      }
    }
    return points;
  }

 private:
  [[noreturn]] void Fail(FaultKind kind, const std::string& reason) const {
    throw NavigatorFault(kind, calls_.who() + reason);
  }

  const LibraryCalls calls_;
  const rockyard_reader_type& type_;
  void* reader_ = nullptr;
};

// One kind of readers of a library.
class LibraryReaderSource final : public ReaderSource {
 public:
  LibraryReaderSource(std::shared_ptr<const LoadedLibrary> library, std::size_t place,
                      std::unique_ptr<const Description> description)
      : ReaderSource(library->file().string(), std::move(description)),
        library_(std::move(library)),
        place_(place) {}

  std::unique_ptr<perception::PointReader> Make(
      const Parameters& parameters, const perception::PointReaderSetup& setup) const override {
    auto reader = std::make_unique<LibraryReader>(*library_->info().readers[place_],
                                                  description().name, setup);
    reader->Begin(parameters, setup);
    return reader;
  }

 protected:
  core::JsonValue AskProblems(const Parameters& parameters) const override {
    return AskOfParameters(*library_, parameters, [&](const rockyard_plugin_info& info) {
      return info.readers[place_]->check;
    });
  }

 private:
  const std::shared_ptr<const LoadedLibrary> library_;
  const std::size_t place_;
};

}  // namespace

std::shared_ptr<const ReaderSource> MakeLibraryReaders(
    std::shared_ptr<const LoadedLibrary> library, std::size_t place,
    std::unique_ptr<const Description> description) {
  return std::make_shared<LibraryReaderSource>(std::move(library), place, std::move(description));
}

}  // namespace rockyard::plugin
