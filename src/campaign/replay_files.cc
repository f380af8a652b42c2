#include "campaign/replay_files.h"

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "image_files/png_file.h"
#include "report/atomic_file.h"
#include "report/scan_drawing.h"
#include "report/scan_picture.h"
#include "scenario/load.h"
#include "trial/terrain_sensor_set_params.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

std::string FileStem(const messages::StripeExposure& frames) {
  return fmt::format("{}-group{}", frames.camera == 0 ? "left" : "right", frames.group);
}

void BeginFolder(const fs::path& folder, const scenario::Scenario& scenario) {
  fs::create_directories(folder);
  report::WriteFileAtomically(folder / "scenario.resolved.json", scenario::ResolvedJson(scenario));
}

bool HasStereoCameras(const scenario::Scenario& scenario) {
  const trial::DriveParams& drive = scenario.drive;
  return drive.sensors.terrain_sensors.chosen().cameras(drive) != nullptr;
}

}  // namespace

void WriteScanFiles(const fs::path& folder, const scenario::Scenario& scenario,
                    const CapturedScan& captured) {
  BeginFolder(folder, scenario);
  for (const CapturedExposure& exposure : captured.exposures) {
    const auto write = [&](std::string_view what, const image_files::Picture& picture) {
      report::WriteFileAtomically(
          folder / fmt::format("{}-{}.png", FileStem(exposure.frames), what),
          image_files::EncodePng(picture));
    };
    write("lit", report::FramePicture(exposure.frames.lit.front()));
    write("dark", report::FramePicture(exposure.frames.dark.front()));
    write("difference",
          report::DifferencePicture(captured.view, exposure.frames, exposure.difference));
  }
  report::WriteFileAtomically(folder / "array.svg", report::ScanSvg(captured.view));
  report::WriteFileAtomically(folder / "points.csv", report::ScanCsv(captured.view));
}

std::vector<LookFile> WriteStepFiles(const fs::path& folder, const scenario::Scenario& scenario,
                                     const CapturedStep& captured) {
  BeginFolder(folder, scenario);
  const messages::NavigationView& view = captured.picture.view;
  report::WriteFileAtomically(folder / "step.svg", report::NavigationSvg(captured.picture));
  report::WriteFileAtomically(folder / "map.csv", report::MapCsv(view.map));
  report::WriteFileAtomically(folder / "votes.csv", report::VotesCsv(view));
  report::WriteFileAtomically(folder / "points.csv", report::CloudCsv(captured.cloud));
  if (!captured.looks.empty()) return WriteLookFiles(folder, captured.looks, view);
  if (!HasStereoCameras(scenario)) return {};
  return WriteCloudFiles(folder, captured.cloud);
}

}  // namespace rockyard::campaign
