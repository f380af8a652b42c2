// The command `rockyard vo`: the path of the cameras of a sequence of stereo pairs.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/console.h"
#include "app/output_files.h"
#include "app/progress_line.h"
#include "app/run_display.h"
#include "campaign/odometry/estimate_path.h"
#include "campaign/odometry/odometry_files.h"
#include "core/archive.h"
#include "core/error.h"
#include "core/json_text.h"
#include "math/angles.h"
#include "report/line_text.h"
#include "report/parameter_table.h"

namespace rockyard::app {
namespace {

struct VoOptions {
  campaign::OdometryRequest request;
  std::string predict = "steady";
  std::int64_t count = 0;
  std::int64_t pictured = -1;
  bool parameters = false;
  bool json = false;
  bool quiet = false;
};

std::string SegmentsText(const campaign::OdometryRequest& request,
                         const vision::MeanSegmentError& segments) {
  return fmt::format("  {} segments of {}: {:.3f} % of the way, {:.5f} deg/m\n", segments.segments,
                     request.lengths_m.empty()
                         ? "100, 200, ..., 800 m (KITTI)"
                         : fmt::format("{:g} m", fmt::join(request.lengths_m, ", ")),
                     100.0 * segments.translation, math::RadToDeg(segments.rotation_rad_per_m));
}

std::string PathErrorsText(const campaign::OdometryRequest& request,
                           const campaign::PathErrors& errors) {
  std::string text =
      fmt::format("against the truth, {} pairs over {:.2f} m:\n  {:.4f} m off at the end",
                  errors.pairs, errors.distance_m, errors.end_error_m);
  if (errors.distance_m > 0.0) {
    text += fmt::format(", {:.2f} % of the way", 100.0 * errors.end_error_m / errors.distance_m);
  }
  text += "\n";
  if (errors.segments) text += SegmentsText(request, *errors.segments);
  text += fmt::format(
      "  absolute error (root mean square): {:.4f} m with the first poses made equal, {:.4f} m "
      "after a rigid alignment\n",
      errors.absolute_first_m->rms, errors.absolute_rigid_m->rms);
  if (errors.relative_m) {
    text +=
        fmt::format("  relative error over {} step{} (root mean square): {:.4f} m, {:.4f} deg\n",
                    request.delta, request.delta == 1 ? "" : "s", errors.relative_m->rms,
                    math::RadToDeg(errors.relative_rad->rms));
  }
  if (errors.normalized) {
    text += fmt::format(
        "  squared errors of the motions over their covariance: {:.2f} on average (6 if it is "
        "right), {:.1f} % above its 95 % point\n",
        errors.normalized->mean, 100.0 * errors.normalized_above_95);
  }
  return text;
}

std::string GapsText(const campaign::OdometryResult& result) {
  const std::int64_t gaps = result.Gaps();
  const auto motions = std::ssize(result.steps) - 1;
  std::string text = fmt::format("{} of {} pairs have a motion", motions - gaps, motions);
  const std::vector<std::int64_t> reasons = campaign::ReasonCounts(result);
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    if (reasons[i] == 0) continue;
    text += fmt::format(", {} {}", reasons[i], core::EnumNames<vision::NoMotion>::kNames[i]);
  }
  return text + "\n";
}

std::string StageTimesText(const campaign::OdometryResult& result) {
  std::string text = "median times:";
  for (std::size_t i = 0; i < campaign::kPairStageNames.size(); ++i) {
    const auto times = campaign::StageTimes(result, static_cast<campaign::PairStage>(i));
    if (times)
      text += fmt::format(" {} {:.2f} ms,", campaign::kPairStageNames[i], 1e3 * times->median);
  }
  text.back() = '\n';
  return text;
}

std::string VoText(const campaign::OdometryRequest& request,
                   const campaign::OdometryResult& result) {
  std::string text = fmt::format(
      "{} of {} pairs of {}, {}\n{} x {} pixels{}: focal length {:.1f} px, baseline {:.4f} m\n",
      result.steps.size(), result.pairs_there, report::Printable(request.sequence.string()),
      result.layout, result.cameras.size.columns, result.cameras.size.rows,
      result.resampled ? " after alignment" : ", aligned as they are", result.cameras.focal_px,
      result.cameras.baseline_m);
  text += GapsText(result);
  text += fmt::format("a way of {:.3f} m\n", result.Distance_m());
  if (result.errors) text += PathErrorsText(request, *result.errors);
  text += StageTimesText(result);
  for (const std::string& note : result.notes) text += fmt::format("  note: {}\n", note);
  return text + FilesText(result.files);
}

void CheckVoRequest(VoOptions& options) {
  campaign::OdometryRequest& request = options.request;
  for (const auto& [name, path] :
       {std::pair{"SEQUENCE", &request.sequence}, {"--out", &request.out}}) {
    if (path->empty()) {
      throw core::UserError(name, "is missing",
                            "rockyard vo SEQUENCE --cameras FILE --out FOLDER; see rockyard vo "
                            "--help");
    }
  }
  if (options.count > 0) request.count = options.count;
  if (options.pictured >= 0) request.pictured = options.pictured;
  if (options.predict == "none") {
    request.prediction = campaign::Prediction::kNone;
  } else if (options.predict != "steady") {
    request.prediction = campaign::Prediction::kFile;
    request.predicted = options.predict;
  }
}

ExitCode Vo(VoOptions& options) {
  if (options.parameters) {
    Print(report::ParametersMarkdown(core::ListParams<vision::OdometerParams>().parameters()));
    return ExitCode::kDone;
  }
  CheckVoRequest(options);
  ProgressLine line(stderr);
  const auto show = [&](std::int64_t done, std::int64_t planned, std::int64_t gaps) {
    const std::string text = fmt::format("  {}/{} pairs, {} without a motion", done, planned, gaps);
    if (done == planned) {
      line.FinishText(text);
    } else {
      line.ShowText(text);
    }
  };
  const campaign::OdometryResult result = campaign::EstimatePath(
      options.request, options.quiet ? campaign::OdometryProgress() : show, StopBySignal());
  if (options.json) {
    PrintJson(core::DumpJson(campaign::OdometryJson(options.request, result)));
  } else if (!options.quiet) {
    Print(VoText(options.request, result));
  }
  return result.outcome;
}

void AddWhichPairs(CLI::App& command, VoOptions& options) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
  command.add_option("--first", options.request.first, "the pair to begin with, from 0 (0)")
      ->check(CLI::Range(std::int64_t{0}, kMost));
  command.add_option("--every", options.request.every, "takes every Nth pair (1)")
      ->check(CLI::Range(std::int64_t{1}, kMost));
  command.add_option("--count", options.count, "takes so many pairs (default: all)")
      ->check(CLI::Range(std::int64_t{2}, kMost));
}

void AddTruthOptions(CLI::App& command, VoOptions& options) {
  command.add_option("--truth", options.request.truth,
                     "file of true poses of the cameras' outer frame: KITTI's form (twelve numbers "
                     "a pair) or TUM's (time, position, quaternion)");
  command
      .add_option("--lengths", options.request.lengths_m,
                  "m, lengths of the segments whose errors are told, from every pair on (default: "
                  "100 to 800 from every tenth, as KITTI)")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  command.add_option("--delta", options.request.delta, "steps of the relative pose error (1)")
      ->check(CLI::Range(1, 1000000));
}

void AddMatchingOptions(CLI::App& command, VoOptions& options) {
  command.add_option("--predict", options.predict,
                     "where a pair is expected: none, steady (the last step once more), or a file "
                     "with a pose for every pair, such as of wheels (steady)");
  command
      .add_option("--param", options.request.settings,
                  "PATH=VALUE: changes a parameter of the odometry; repeat")
      ->allow_extra_args(false);
  command.add_flag("--parameters", options.parameters,
                   "lists what --param changes, and does nothing else");
  command.add_option("--seed", options.request.seed, "of the random draws of RANSAC (1)");
  command
      .add_option("--white", options.request.white,
                  "sample that becomes white (default: the largest that the file can hold)")
      ->check(CLI::Range(1, 65535));
}

}  // namespace

void AddVoCommand(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<VoOptions>();
  campaign::OdometryRequest& request = options->request;
  CLI::App* command = app.add_subcommand(
      "vo", "Visual odometry: how the cameras of a sequence of stereo pairs moved");
  command->footer(
      "Sequences: a folder with left and right, image_0 and image_1 (KITTI) or image_l and "
      "image_r, of\nequal names; a folder of EuRoC (mav0/cam0/data.csv); or a text file with two "
      "paths a line. Cameras: as\nof `rockyard stereo`. The path begins at the identity, in the "
      "cameras' outer frame.\n\n" +
      app.get_footer());
  command->add_option("SEQUENCE", request.sequence, "folder or list of the pairs of images");
  command->add_option("--out", request.out, "folder for the results; it is created");
  AddExistingFiles(*command, request.existing, true);
  command->add_option("--cameras", request.cameras,
                      "file with the cameras of both images (default: KITTI's calib.txt in the "
                      "sequence)");
  AddTruthOptions(*command, *options);
  AddWhichPairs(*command, *options);
  AddMatchingOptions(*command, *options);
  command
      ->add_option("--picture", options->pictured,
                   "the pair whose features are drawn (default: the middle one)")
      ->check(CLI::Range(0, std::numeric_limits<std::int32_t>::max()));
  CLI::Option* json = command->add_flag("--json", options->json, "for programs");
  command->add_flag("--quiet", options->quiet, "print nothing but errors")->excludes(json);
  command->callback([options, &exit_code] { exit_code = Vo(*options); });
}

}  // namespace rockyard::app
