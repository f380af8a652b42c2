#include "fuzz/readers.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <iterator>
#include <stdexcept>
#include <string>
#include <system_error>
#include <variant>

#include "campaign/odometry/image_sequence.h"
#include "campaign/odometry/path_journal.h"
#include "campaign/odometry/pose_text.h"
#include "core/error.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "image_files/disparity_file.h"
#include "image_files/read_image.h"
#include "report/baseline.h"
#include "report/comparison_reference.h"
#include "scenario/load.h"
#include "scenario/sweep.h"
#include "vision/calibration/target_file.h"
#include "vision/cameras/camera_file.h"

namespace rockyard {
namespace {

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

// What is written reads back to the same text.
void ReadJson(std::string_view bytes) {
  const std::string once = core::DumpJson(core::ParseJson(bytes, "bytes"));
  const std::string twice = core::DumpJson(core::ParseJson(once, "what was written"));
  if (once != twice) throw std::logic_error("JSON does not read back");
}

// A resolved scenario is the same scenario.
void ReadScenario(std::string_view bytes) {
  const scenario::Scenario read = scenario::ParseScenario(bytes);
  const scenario::Scenario again = scenario::ParseScenario(scenario::ResolvedJson(read));
  if (scenario::Fingerprint(read) != scenario::Fingerprint(again)) {
    throw std::logic_error("a scenario does not read back");
  }
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

constexpr Reader kReaders[] = {
    {"json", ReadJson},
    {"scenario", ReadScenario},
    {"override",
     [](std::string_view bytes) {
       core::JsonValue document = core::JsonValue::Object();
       core::ApplyOverride(document, bytes);
     }},
    {"sweep", [](std::string_view bytes) { scenario::ParseSweep(bytes); }},
    {"reference", ReadReference},
    {"camera", [](std::string_view bytes) { Use(vision::ParseCamera(bytes, "bytes")); }},
    {"cameras", ReadCameras},
    {"target", [](std::string_view bytes) { vision::LoadTarget(MemoryFile(bytes).path()); }},
    {"poses", [](std::string_view bytes) { campaign::ReadPoses(MemoryFile(bytes).path()); }},
    {"times", [](std::string_view bytes) { campaign::ReadTimes(MemoryFile(bytes).path()); }},
    {"list", [](std::string_view bytes) { campaign::FindSequence(MemoryFile(bytes).path()); }},
    {"journal", [](std::string_view bytes) { campaign::PathJournal(MemoryFile(bytes).path()); }},
    {"image", [](std::string_view bytes) { image_files::DecodeImage(bytes, "bytes", kSmall); }},
    {"disparity",
     [](std::string_view bytes) {
       image_files::ReadDisparity(MemoryFile(bytes).path(), 1.0, kSmall);
     }},
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
