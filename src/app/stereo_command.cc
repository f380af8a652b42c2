// The command `rockyard stereo`: matches the two images of a stereo pair.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstddef>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <string>

#include "app/commands.h"
#include "app/console.h"
#include "app/output_files.h"
#include "app/progress_line.h"
#include "campaign/stereo/match_pair.h"
#include "core/archive.h"
#include "core/error.h"
#include "core/json_text.h"
#include "report/line_text.h"
#include "report/parameter_table.h"
#include "vision/stereo/disparity.h"
#include "vision/stereo/row_alignment.h"
#include "vision/stereo/stereo_params.h"

namespace rockyard::app {
namespace {

struct StereoOptions {
  campaign::StereoRequest request;
  std::optional<double> nearest_m;
  std::optional<double> farthest_m;
  bool parameters = false;
  bool json = false;
};

std::string RangeText(const campaign::StereoResult& result) {
  const vision::CorrelatorParams& range = result.params.correlator;
  const std::int64_t most_px = range.min_disparity_px + range.disparities - 1;
  std::string text = fmt::format("disparities {} to {} px", range.min_disparity_px, most_px);
  // The largest disparity gives no match: the best match must have a neighbour on either side.
  if (result.cameras && most_px > 1) {
    text += fmt::format(
        ", {:.2f} m and farther",
        result.cameras->focal_px * result.cameras->baseline_m / static_cast<double>(most_px - 1));
  }
  return text;
}

std::string AlignmentText(const vision::RowAlignment& alignment) {
  return fmt::format(
      "rows of the right image moved by {:+.2f} px, {:+.2f} px per 1000 columns, {:+.2f} px per "
      "1000 "
      "rows: {} of {} matches agree within {:.2f} px (root mean square)\n",
      -alignment.correction.offset_px, -1000.0 * alignment.correction.per_column,
      -1000.0 * alignment.correction.per_row, alignment.agreeing, alignment.matches,
      alignment.rms_px);
}

std::string ScoreText(const vision::StereoScore& score) {
  std::string text = fmt::format("  of {} known pixels {:.1f} % have a disparity; of these bad:\n",
                                 score.known, 100.0 * score.Density());
  for (std::size_t i = 0; i < vision::kBadThresholds_px.size(); ++i) {
    text += fmt::format("    by more than {:g} px {:6.2f} %\n", vision::kBadThresholds_px[i],
                        100.0 * score.BadShare(i));
  }
  return text + fmt::format("    mean error {:+.3f} px, root mean square {:.3f} px\n",
                            score.mean_error_px, score.rms_error_px);
}

std::string DropsText(const campaign::StereoResult& result) {
  const auto all = static_cast<double>(
      std::accumulate(result.counts.begin(), result.counts.end(), std::int64_t{0}));
  std::string text = fmt::format("  {:.1f} % of the pixels have a disparity; dropped by\n",
                                 100.0 * result.Density());
  for (std::size_t i = 1; i < result.counts.size(); ++i) {
    text += fmt::format("    {:<14} {:5.1f} %\n", vision::kDropNames[i],
                        100.0 * static_cast<double>(result.counts[i]) / all);
  }
  return text;
}

std::string ResultText(const campaign::StereoRequest& request,
                       const campaign::StereoResult& result) {
  std::string text;
  const auto eye = [&](const char* name, const std::filesystem::path& path, std::size_t i) {
    return fmt::format("{:<6} {}: {}\n", name, report::Printable(path.string()), result.read[i]);
  };
  text += eye("left", request.left, 0) + eye("right", request.right, 1);
  if (result.alignment) text += AlignmentText(*result.alignment);
  text += fmt::format("{} x {} pixels{}, {}\n", result.size.columns, result.size.rows,
                      result.cameras
                          ? fmt::format(", aligned: focal length {:.1f} px, baseline {:.4f} m",
                                        result.cameras->focal_px, result.cameras->baseline_m)
                          : std::string(", taken as aligned"),
                      RangeText(result));
  text += DropsText(result);
  if (result.score) text += ScoreText(*result.score);
  for (const std::string& note : result.notes) text += fmt::format("  note: {}\n", note);
  return text + FilesText(result.files);
}

void CheckRequest(const StereoOptions& options) {
  for (const auto& [name, path] : {std::pair{"LEFT", &options.request.left},
                                   {"RIGHT", &options.request.right},
                                   {"--out", &options.request.out}}) {
    if (path->empty()) {
      throw core::UserError(name, "is missing",
                            "rockyard stereo LEFT RIGHT --out FOLDER; see rockyard stereo --help");
    }
  }
  if (options.farthest_m && !options.nearest_m) {
    throw core::UserError("--farthest", "needs --nearest", "give both, or --nearest alone");
  }
  if (options.farthest_m && *options.farthest_m < *options.nearest_m) {
    throw core::UserError("--farthest", "is nearer than --nearest",
                          fmt::format("give at least {} m", *options.nearest_m));
  }
}

void Stereo(StereoOptions& options) {
  if (options.parameters) {
    Print(
        report::ParametersMarkdown(core::ListParams<vision::StereoPipelineParams>().parameters()));
    return;
  }
  CheckRequest(options);
  if (options.nearest_m) {
    options.request.depths = {*options.nearest_m,
                              options.farthest_m.value_or(std::numeric_limits<double>::infinity())};
  }
  const campaign::StereoResult result = [&] {
    const BusyLine busy("matching the images");
    return campaign::MatchPair(options.request);
  }();
  if (options.json) {
    PrintJson(core::DumpJson(campaign::StereoJson(options.request, result)));
    return;
  }
  Print(ResultText(options.request, result));
}

void AddRangeOptions(CLI::App& command, StereoOptions& options) {
  command
      .add_option(
          "--nearest", options.nearest_m,
          "m, depth from which on matches are searched; needs --cameras (default: an eighth "
          "of the image's width in pixels)")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--farthest", options.farthest_m,
                  "m, depth up to which matches are searched (default: infinity)")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--param", options.request.settings,
                  "PATH=VALUE: changes a parameter of the matching; repeat")
      ->allow_extra_args(false);
  command.add_flag("--parameters", options.parameters,
                   "lists what --param changes, and does nothing else");
}

}  // namespace

void AddStereoCommand(CLI::App& app) {
  auto options = std::make_shared<StereoOptions>();
  campaign::StereoRequest& request = options->request;
  CLI::App* command = app.add_subcommand(
      "stereo",
      "Matches two images of a stereo pair: disparities, and with their cameras points and a map");
  command->footer(
      "Images: PNG, JPEG, PGM, PPM, and with GDAL PDS3, PDS4, VICAR. Cameras: CAHV, CAHVOR, "
      "CAHVORE or a\ndistorted pinhole, as JSON or as flight calibrations have them "
      "(src/vision/README.md).\n\n" +
      app.get_footer());
  command->add_option("LEFT", request.left, "image of the left eye");
  command->add_option("RIGHT", request.right, "image of the right eye, of the same size");
  command->add_option("--out", request.out, "folder for the results; it is created");
  AddExistingFiles(*command, request.existing);
  command->add_option(
      "--cameras", request.cameras,
      "file with the cameras of both images (default: the pair is taken as aligned: "
      "what is in a row of one image is in that row of the other)");
  command->add_flag("--align", request.align,
                    "without cameras: moves the rows of the right image to where matches of the "
                    "two put them");
  AddRangeOptions(*command, *options);
  command
      ->add_option("--white", request.white,
                   "sample that becomes white (default: the largest that the file can hold)")
      ->check(CLI::Range(1, 65535));
  command->add_option("--reference", request.reference,
                      "known disparities of the left image, PFM, PNG or PGM: what is wrong is "
                      "counted");
  command
      ->add_option("--reference-samples", request.reference_samples_a_px,
                   "samples a pixel of disparity in that file (1; Middlebury has 4 or 16)")
      ->check(CLI::PositiveNumber);
  command->add_option("--cell", request.cell_m, "m, side of a cell of the elevation map (0.1)")
      ->check(CLI::PositiveNumber);
  command->add_option("--threads", request.threads, "threads (1); results do not depend on them")
      ->check(CLI::Range(1, 256));
  command->add_flag("--json", options->json, "for programs");
  command->callback([options] { Stereo(*options); });
}

}  // namespace rockyard::app
