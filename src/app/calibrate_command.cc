// The command `rockyard calibrate`: estimates cameras from images of a chessboard.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstddef>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/console.h"
#include "app/output_files.h"
#include "app/progress_line.h"
#include "campaign/calibrate/calibrate_cameras.h"
#include "core/error.h"
#include "core/json_text.h"
#include "report/line_text.h"

namespace rockyard::app {
namespace {

struct CalibrateOptions {
  campaign::CalibrateRequest request;
  std::string model = "cahvor";
  bool json = false;
};

// How many outliers the text names; the files of results name all.
constexpr std::size_t kShownOutliers = 10;

std::string CalibratedCameraText(const campaign::CalibrateResult& result, std::size_t camera) {
  const vision::Intrinsics found = vision::IntrinsicsOf(
      result.calibration.cameras[camera], vision::CovarianceOf(result.calibration, camera));
  const auto of = [](const vision::Estimate& estimate) {
    return fmt::format("{:.2f} +- {:.2f}", estimate.value, estimate.sd);
  };
  return fmt::format("{}: focal length {} by {} px, principal point {}, {} px\n",
                     campaign::CameraName(result, camera), of(found.focal_h_px),
                     of(found.focal_v_px), of(found.centre_h_px), of(found.centre_v_px));
}

std::string OutliersText(const campaign::CalibrateRequest& request,
                         const campaign::CalibrateResult& result) {
  const auto& outliers = result.calibration.outliers;
  const auto columns = static_cast<std::size_t>(result.board.columns);
  std::string text;
  for (std::size_t i = 0; i < outliers.size() && i < kShownOutliers; ++i) {
    text += fmt::format("  outlier: row {}, column {} of {}, {:.2f} px from its place\n",
                        outliers[i].corner / columns, outliers[i].corner % columns,
                        report::Printable(campaign::ImageOf(request, outliers[i]).string()),
                        outliers[i].residual_px.norm());
  }
  if (outliers.size() > kShownOutliers) {
    text += fmt::format("  and {} more outliers\n", outliers.size() - kShownOutliers);
  }
  return text;
}

std::string CalibrationText(const campaign::CalibrateRequest& request,
                            const campaign::CalibrateResult& result) {
  const vision::Calibration& found = result.calibration;
  std::string text = fmt::format(
      "{} corners in {} images of {} x {} pixels, {:.4f} px from their places (root mean square)\n",
      found.corners, request.images.size() + request.right.size(), result.size.columns,
      result.size.rows, found.rms_px);
  for (std::size_t i = 0; i < found.cameras.size(); ++i) text += CalibratedCameraText(result, i);
  if (found.cameras.size() == 2) {
    const vision::Estimate baseline_m = vision::BaselineOf(found);
    text += fmt::format("baseline {:.5f} +- {:.5f} m\n", baseline_m.value, baseline_m.sd);
  }
  text += result.surveyed ? "in the frame of the surveyed targets\n"
                          : "in the frame of the first camera: x right, y down, z ahead\n";
  text += OutliersText(request, result);
  for (const std::string& note : result.notes) text += fmt::format("  note: {}\n", note);
  return text + FilesText(result.files);
}

void CheckCalibrateRequest(const campaign::CalibrateRequest& request) {
  const char* missing = nullptr;
  if (request.out.empty()) missing = "--out";
  if (request.target.empty()) missing = "--target";
  if (request.images.empty()) missing = "IMAGE";
  if (missing == nullptr) return;
  throw core::UserError(missing, "is missing",
                        "rockyard calibrate IMAGE... --target FILE --out FOLDER; see rockyard "
                        "calibrate --help");
}

void Calibrate(CalibrateOptions& options) {
  options.request.lens =
      options.model == "cahv" ? vision::EstimatedLens::kCahv : vision::EstimatedLens::kCahvor;
  CheckCalibrateRequest(options.request);
  const campaign::CalibrateResult result = [&] {
    const BusyLine busy("calibrating");
    return campaign::CalibrateCameras(options.request);
  }();
  if (options.json) {
    PrintJson(core::DumpJson(campaign::CalibrateJson(options.request, result)));
    return;
  }
  Print(CalibrationText(options.request, result));
}

}  // namespace

void AddCalibrateCommand(CLI::App& app) {
  auto options = std::make_shared<CalibrateOptions>();
  campaign::CalibrateRequest& request = options->request;
  CLI::App* command = app.add_subcommand(
      "calibrate", "Estimates a camera, or the two of a stereo pair, from images of a chessboard");
  command->footer(
      "The target, as JSON: {\"rows\": 6, \"columns\": 9, \"spacing_m\": 0.03}, of inner corners, "
      "one number odd\nand one even; with \"poses\" where they were surveyed "
      "(src/vision/README.md). The cameras that are written\nare those that `rockyard stereo "
      "--cameras` reads.\n\n" +
      app.get_footer());
  command->add_option("IMAGE", request.images,
                      "images of the target by the camera, or by the left one of a pair");
  command->add_option("--right", request.right,
                      "images by the right camera, of the same targets in the same order");
  command->add_option("--target", request.target, "file that describes the chessboard");
  command->add_option("--out", request.out, "folder for the results; it is created");
  AddExistingFiles(*command, request.existing);
  command->add_option("--model", options->model, "cahvor, or cahv: without distortion (cahvor)")
      ->check(CLI::IsMember({"cahv", "cahvor"}));
  command
      ->add_option("--white", request.white,
                   "sample that becomes white (default: the largest that the file can hold)")
      ->check(CLI::Range(1, 65535));
  command->add_flag("--json", options->json, "for programs");
  command->callback([options] { Calibrate(*options); });
}

}  // namespace rockyard::app
