#include "fuzz/readers.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <system_error>
#include <variant>

#include "campaign/odometry/pair_reader.h"
#include "campaign/odometry/path_journal.h"
#include "campaign/odometry/pose_text.h"
#include "campaign/site/rock_catalogue.h"
#include "core/archive.h"
#include "core/error.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "core/test_folder.h"
#include "image_files/elevation_raster.h"
#include "image_files/float_files.h"
#include "image_files/planetary.h"
#include "image_files/png_bytes.h"
#include "image_files/raw_image.h"
#include "image_files/read_image.h"
#include "report/baseline.h"
#include "report/comparison_reference.h"
#include "rover/urdf.h"
#include "rover/urdf_reader/urdf_reader.h"
#include "scenario/load.h"
#include "scenario/sweep.h"
#include "vision/calibration/target_file.h"
#include "vision/cameras/camera_file.h"

namespace rockyard {
namespace {

namespace fs = std::filesystem;

// A few bytes must not ask for gigabytes.
constexpr image_files::ImageLimits kSmall{.max_side = 4096, .max_pixels = 1 << 20};

// A file in memory that holds the bytes, for readers of paths.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes) : file_(memfd_create("reader", MFD_CLOEXEC)) {
    if (file_ < 0 || write(file_, bytes.data(), bytes.size()) != std::ssize(bytes)) {
      throw std::system_error(errno, std::generic_category(), "memfd");
    }
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { close(file_); }

  std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

// Files that name each other, in a folder: the name of the one to read, or nothing for the folder
// itself, then each file's name and what it holds, with a zero byte after each. Nothing is written
// outside of the folder; what is read may be.
class FileTree {
 public:
  explicit FileTree(std::string_view bytes) {
    first_ = Inside(Next(bytes));
    for (int files = 0; files < kMaxFiles && !bytes.empty(); ++files) {
      const fs::path path = Inside(Next(bytes));
      std::error_code refused;  // a name that the disk does not take is a file that is missing
      fs::create_directories(path.parent_path(), refused);
      std::ofstream(path, std::ios::binary) << Next(bytes);
    }
  }

  const fs::path& path() const { return first_; }

 private:
  static constexpr int kMaxFiles = 30;

  static std::string_view Next(std::string_view& bytes) {
    const std::size_t end = std::min(bytes.find('\0'), bytes.size());
    const std::string_view part = bytes.substr(0, end);
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
    return part;
  }

  fs::path Inside(std::string_view name) const {
    const fs::path path = (folder_.path() / name).lexically_normal();
    const bool inside = path.string().starts_with(folder_.path().string() + '/');
    return inside ? path : folder_.path();
  }

  core::TestFolder folder_;
  fs::path first_;
};

// What is written reads back to the same text.
void ReadJson(std::string_view bytes) {
  const std::string once = core::DumpJson(core::ParseJson(bytes, "bytes"));
  const std::string twice = core::DumpJson(core::ParseJson(once, "what was written"));
  if (once != twice) throw std::logic_error("JSON does not read back");
}

// Gives each chunk of a PNG file the checksum that fits, so that damage gets further than it.
std::string WithChecksums(std::string_view bytes) {
  constexpr std::size_t kSignature = 8;
  constexpr std::size_t kAround = 12;  // length, type and checksum of a chunk
  std::string mended(bytes);
  for (std::size_t at = kSignature; at + kAround <= bytes.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      length = length << 8 | static_cast<unsigned char>(bytes[at + i]);
    }
    if (length > bytes.size() - at - kAround) break;
    const std::string sum =
        image_files::BigEndian(image_files::PngCrc(mended.substr(at + 4, 4 + length)));
    mended.replace(at + 8 + length, 4, sum);
    at += kAround + length;
  }
  return mended;
}

// Within the limits and its full scale.
void Use(const image_files::RawImage& image) {
  bool good = image.planes.size() == 1 || image.planes.size() == 3;
  for (const image_files::SamplePlane& plane : image.planes) {
    const bool masked = image.format == "PDS3" || image.format == "PDS4" || image.format == "VICAR";
    good = good && plane.width() == image.width() && plane.height() == image.height() &&
           std::int64_t{plane.width()} * plane.height() <= kSmall.max_pixels &&
           (masked || std::ranges::max(plane.values()) <= image.full_scale);
  }
  if (!good || image_files::ToGray(image).image.width() != image.width()) {
    throw std::logic_error("an image that is none");
  }
}

void ReadImage(std::string_view bytes) {
  const std::string mended = bytes.starts_with("\x89PNG") ? WithChecksums(bytes) : "";
  if (!mended.empty() && mended != bytes) {
    try {
      Use(image_files::DecodeImage(mended, "bytes", kSmall));
    } catch (const core::UserError&) {
      // As good as the bytes themselves, which come next.
    }
  }
  Use(image_files::DecodeImage(bytes, "bytes", kSmall));
}

// What rockyard reads of a label; the samples are GDAL's.
void ReadPlanetary(std::string_view bytes) {
  const auto kind = image_files::PlanetaryKindOf(bytes);
  if (!kind) throw core::UserError("bytes", "are no planetary image", "use another reader");
  const auto samples = [](const fs::path&, const char*, const image_files::ImageLimits&) {
    return image_files::Raster{.planes = {image_files::SamplePlane(4, 3)}, .bits = 16};
  };
  Use(image_files::ReadPlanetary("bytes", bytes, *kind, kSmall, {samples, ""}));
}

// A resolved scenario is the same scenario.
void ReadScenario(std::string_view bytes) {
  const scenario::Scenario read =
      scenario::ParseScenario(bytes, {}, ROCKYARD_SOURCE_DIR "/scenarios/gestalt");
  const scenario::Scenario again = scenario::ParseScenario(scenario::ResolvedJson(read));
  if (scenario::Fingerprint(read) != scenario::Fingerprint(again)) {
    throw std::logic_error("a scenario does not read back");
  }
}

// Whether it asks for a hundred cells by one number.
bool IsLarge(const core::JsonValue& value) {
  using Type = core::JsonValue::Type;
  if (value.Is(Type::kList)) return std::ranges::any_of(value.list(), IsLarge);
  return value.Is(Type::kObject) &&
         std::ranges::any_of(value.members(), [](const core::JsonMember& member) {
           const bool counts = member.key == "steps" || member.key == "points";
           return IsLarge(member.value) ||
                  (counts && member.value.IsNumber() && member.value.number() > 99.0);
         });
}

// Thousands of cells take minutes under sanitizers.
void ReadSweep(std::string_view bytes) {
  if (IsLarge(core::ParseJson(bytes, "bytes"))) {
    throw core::UserError("bytes", "are a large sweep", "use fewer cells");
  }
  scenario::ParseSweep(bytes, {}, ROCKYARD_SOURCE_DIR "/scenarios/sweeps");
}

// A camera that is read maps pixels to finite rays and back, or to nothing, and, written, reads
// back.
void Use(const vision::CameraModel& camera) {
  const vision::ImageSize& size = camera.size;
  for (const vision::Pixel& pixel :
       {vision::MiddleOf(size), vision::Pixel(0.0, 0.0), vision::Pixel(size.columns - 1.0, 0.0)}) {
    const auto ray = vision::BackProject(camera, pixel);
    if (!ray) continue;
    const auto back = vision::Project(camera, ray->origin + 3.0 * ray->direction);
    if (!ray->direction.allFinite() || !ray->origin.allFinite() || (back && !back->allFinite())) {
      throw std::logic_error("a camera whose rays or pixels are not finite");
    }
  }
  const auto read_back = [&](const std::string& text) {
    if (vision::ParseCamera(text, "what was written").size != size) {
      throw std::logic_error("a camera does not read back");
    }
  };
  read_back(core::DumpJson(vision::CameraJson(camera)));
  if (!std::holds_alternative<vision::BrownPinhole>(camera.lens)) {
    read_back(vision::CameraText(camera));
  }
}

void ReadCameras(std::string_view bytes) {
  const vision::CameraPair pair = vision::ParseCameraPair(bytes, "bytes");
  vision::ParseCameraPair(core::DumpJson(vision::CameraPairJson(pair)), "what was written");
  Use(pair.left);
  Use(pair.right);
}

void ReadReference(std::string_view bytes) {
  const core::JsonValue json = core::ParseJson(bytes, "bytes");
  if (report::IsBaseline(json)) {
    report::ParseBaseline(json);
  } else {
    report::ParseReference(json);
  }
}

// What of a rover comes from a file comes back from the file that rockyard writes of it.
void ReadUrdf(std::string_view bytes) {
  const rover::UrdfReading reading = rover::ReadUrdf(bytes, "bytes");
  rover::RoverParams params;
  core::ReadParams(reading.group, params);
  const auto written = [](const rover::UrdfReading& read) { return core::DumpJson(read.group); };
  const rover::UrdfReading again = rover::ReadUrdf(rover::WriteUrdf(params), "what was written");
  if (!again.not_taken.empty() || written(again).empty()) {
    throw std::logic_error("a rover does not read back");
  }
}

// The last corner of an elevation model. What its numbers are is free.
void ReadElevation(std::string_view bytes) {
  constexpr std::int64_t kCorner = 64;
  const MemoryFile file(bytes);
  const auto raster = image_files::OpenElevation(file.path());
  const image_files::RasterInfo& info = raster->info();
  const std::int64_t rows = std::min(info.rows, kCorner);
  const std::int64_t columns = std::min(info.columns, kCorner);
  if (raster->Read({info.rows - rows, info.columns - columns, rows, columns}).size() !=
      static_cast<std::size_t>(rows * columns)) {
    throw std::logic_error("an elevation model that is none");
  }
  if (raster->HasFrame()) raster->ToGeographic(std::array{image_files::MapPoint{}});
}

// Rocks that are read have sizes, and places where these are asked for.
void ReadCatalogue(std::string_view bytes) {
  const MemoryFile file(bytes);
  const campaign::RockCatalogue found = campaign::ReadCatalogue({.file = file.path()});
  const bool good =
      found.placed && !found.rocks.empty() &&
      std::ranges::all_of(found.rocks, [](const campaign::CatalogueRock& rock) {
        return std::isfinite(rock.x) && std::isfinite(rock.y) && rock.diameter_m > 0.0;
      });
  if (!good) throw std::logic_error("a catalogue that is none");
}

constexpr Reader kReaders[] = {
    {"json", ReadJson},
    {"scenario", ReadScenario},
    {"override",
     [](std::string_view bytes) {
       core::JsonValue document = core::JsonValue::Object();
       core::ApplyOverride(document, bytes);
     }},
    {"sweep", ReadSweep},
    {"extends", [](std::string_view bytes) { core::LoadJsonFile(FileTree(bytes).path()); }},
    {"reference", ReadReference},
    {"camera", [](std::string_view bytes) { Use(vision::ParseCamera(bytes, "bytes")); }},
    {"cameras", ReadCameras},
    {"target", [](std::string_view bytes) { vision::LoadTarget(MemoryFile(bytes).path()); }},
    {"poses", [](std::string_view bytes) { campaign::ReadPoses(MemoryFile(bytes).path()); }},
    {"times", [](std::string_view bytes) { campaign::ReadTimes(MemoryFile(bytes).path()); }},
    {"sequence", [](std::string_view bytes) { campaign::FindSequence(FileTree(bytes).path()); }},
    {"journal", [](std::string_view bytes) { campaign::PathJournal(MemoryFile(bytes).path()); }},
    {"image", ReadImage},
    {"planetary", ReadPlanetary},
    {"disparity",
     [](std::string_view bytes) {
       image_files::ReadDisparity(MemoryFile(bytes).path(), 1.0, kSmall);
     }},
    {"urdf", ReadUrdf},
    {"elevation", ReadElevation},
    {"catalogue", ReadCatalogue},
};

}  // namespace

std::span<const Reader> Readers() { return kReaders; }

bool Accepts(const Reader& reader, std::string_view bytes) {
  try {
    reader.read(bytes);
    return true;
  } catch (const core::UserError&) {
    return false;
  }
}

}  // namespace rockyard
