// The command `rockyard render`: pictures of a scenario's stereo cameras, one pair or a sequence.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "app/commands.h"
#include "app/console.h"
#include "app/output_files.h"
#include "app/progress_line.h"
#include "app/run_display.h"
#include "campaign/odometry/render_sequence.h"
#include "campaign/output_folder.h"
#include "campaign/scenario_names.h"
#include "campaign/stereo/render_pair.h"
#include "core/error.h"
#include "math/angles.h"
#include "report/line_text.h"

namespace rockyard::app {
namespace {

struct RenderOptions {
  campaign::RenderRequest request;
  std::string scenario;
  std::optional<double> heading_deg;
  bool behind = false;

  // For a sequence of pairs, which `pairs` asks for.
  std::optional<std::int64_t> pairs;
  double step_m = 0.25;
  std::optional<double> turn_deg;
  double period_s = 1.0;
  double slip = 0.0;
  bool route = false;
};

// The largest turn on the spot between two pairs of a route, where --turn-deg is absent; as in
// MER's drives by visual odometry (Maimone, Cheng and Matthies 2007). The help of --turn-deg names
// it.
constexpr double kRouteTurn_deg = 18.0;

std::string ResultText(const campaign::RenderRequest& request,
                       const campaign::RenderResult& result) {
  std::string text = fmt::format(
      "{} x {} pixels each, exposed for {:.4g} s, with the rover at x {:.2f} m, y {:.2f} m, "
      "heading "
      "{:.1f} deg\n  both eyes see what {:.1f} % of the left image's pixels show",
      result.size.columns, result.size.rows, result.exposure_s, result.pose.x_m, result.pose.y_m,
      math::RadToDeg(result.pose.heading_rad), 100.0 * result.seen_by_both);
  if (result.nearest_m > 0.0) text += fmt::format(", from {:.2f} m on", result.nearest_m);
  text += "\n" + FilesText(result.files);
  const auto in = [&](const char* name) {
    return campaign::ShellWord((request.out / name).string());
  };
  return text + fmt::format(
                    "  next: rockyard stereo {} {} --cameras {} --nearest {:.2f} --reference {} "
                    "--out {}\n",
                    in("left.png"), in("right.png"), in("cameras.json"),
                    std::max(result.nearest_m, 0.01), in("disparity.pfm"), in("stereo"));
}

std::string SequenceText(const campaign::RenderRequest& request,
                         const campaign::SequenceResult& result) {
  std::string text =
      fmt::format("{} of {} pairs of {} x {} pixels, over {:.2f} m\n", result.pairs, result.planned,
                  result.size.columns, result.size.rows, result.distance_m);
  text += fmt::format("  pairs in {} and {}\n", report::Printable((request.out / "left").string()),
                      report::Printable((request.out / "right").string()));
  text += FilesText(result.files);
  const auto in = [&](const char* name) {
    return campaign::ShellWord((request.out / name).string());
  };
  return text + fmt::format("  next: rockyard vo {} --cameras {} --truth {} --out {}\n",
                            campaign::ShellWord(request.out.string()), in("cameras.json"),
                            in("poses.txt"), in("vo"));
}

campaign::SequenceRequest SequenceOf(const RenderOptions& options) {
  const double turn_deg = options.turn_deg.value_or(options.route ? kRouteTurn_deg : 0.0);
  if (options.route && (options.step_m <= 0.0 || turn_deg <= 0.0)) {
    throw core::UserError("--route", "needs --step-m and --turn-deg above 0",
                          "leave them out, or give steps that lead somewhere");
  }
  if (options.route && (options.request.x_m || options.request.y_m || options.heading_deg)) {
    throw core::UserError("--route", "begins at the start of the course",
                          "leave --x, --y and --heading out, or set course.start_x_m and so on");
  }
  return {.scene = options.request,
          .way = options.route ? campaign::SequenceWay::kRoute : campaign::SequenceWay::kCircle,
          .pairs = *options.pairs,
          .step_m = options.step_m,
          .turn_rad = math::DegToRad(turn_deg),
          .period_s = options.period_s,
          .slip = options.slip};
}

ExitCode RenderMany(const RenderOptions& options) {
  ProgressLine line(stderr);
  const campaign::SequenceResult result = campaign::RenderSequence(
      SequenceOf(options),
      [&](std::int64_t done, std::int64_t planned) {
        line.ShowText(fmt::format("  {}/{} pairs", done, planned));
        if (done == planned) line.FinishText(fmt::format("  {}/{} pairs", done, planned));
      },
      StopBySignal());
  Print(SequenceText(options.request, result));
  return result.outcome;
}

ExitCode Render(RenderOptions& options) {
  if (options.request.out.empty()) {
    throw core::UserError("--out", "is missing", "name a folder for the images");
  }
  if (!options.pairs && (options.route || options.turn_deg)) {
    throw core::UserError("--pairs", "is missing", "say how many pairs a sequence has");
  }
  if (!options.pairs && options.request.existing == campaign::ExistingFiles::kResume) {
    throw core::UserError("--resume", "needs --pairs",
                          "take the one pair anew with --force in place of --resume");
  }
  options.request.scenario = campaign::ScenarioFile(options.scenario);
  if (options.behind) options.request.direction = messages::LookDirection::kBehind;
  if (options.heading_deg) options.request.heading_rad = math::DegToRad(*options.heading_deg);
  if (options.pairs) return RenderMany(options);
  const campaign::RenderResult result = [&] {
    const BusyLine busy("rendering the images");
    return campaign::RenderPair(options.request);
  }();
  Print(ResultText(options.request, result));
  return ExitCode::kDone;
}

void AddSequenceOptions(CLI::App& command, RenderOptions& options) {
  command
      .add_option("--pairs", options.pairs,
                  "takes a sequence of so many pairs (of a route: at most), for rockyard vo")
      ->check(CLI::Range(1, 1000000));
  command.add_option("--step-m", options.step_m, "m from pair to pair; 0: it stands (0.25)")
      ->check(CLI::Range(-100.0, 100.0));
  command
      .add_option("--turn-deg", options.turn_deg,
                  "deg by which the heading grows from pair to pair (0); of a route the largest "
                  "turn on the spot between two pairs (18)")
      ->check(CLI::Range(-180.0, 180.0));
  command.add_flag("--route", options.route,
                   "goes from the start of the course to its goal, around the rocks");
  command
      .add_option("--slip", options.slip,
                  "share of the commanded steps that the ground takes: wheels.txt is longer (0)")
      ->check(CLI::Range(-0.99, 0.99));
  command.add_option("--period-s", options.period_s, "s from pair to pair, for times.txt (1)")
      ->check(CLI::Range(1e-9, 1e9));
}

}  // namespace

void AddRenderCommand(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<RenderOptions>();
  campaign::RenderRequest& request = options->request;
  CLI::App* command = app.add_subcommand(
      "render",
      "Takes a picture with either stereo camera of a scenario's rover, with what is true of "
      "them, or a sequence of pairs on its way");
  command->add_option("SCENARIO", options->scenario, "Scenario file or its name")->required();
  command->add_option("--out", request.out, "folder for the results; it is created");
  AddExistingFiles(*command, request.existing, true);
  command
      ->add_option("--trial", request.trial, "Trial index, from 0: its rocks, textures and noise")
      ->capture_default_str();
  command->add_option("--seed", request.seed, "Campaign seed; the scenario's by default");
  command->add_option("--set", request.overrides, "Override: PATH=VALUE, may be repeated")
      ->allow_extra_args(false);
  command->add_flag("--behind", options->behind, "the pair at the rear (default: at the front)");
  command->add_option("--x", request.x_m, "m, of the rover (default: of the start)");
  command->add_option("--y", request.y_m, "m, of the rover (default: of the start)");
  command->add_option("--heading", options->heading_deg,
                      "deg, of the rover (default: of the start)");
  AddSequenceOptions(*command, *options);
  command->callback([options, &exit_code] { exit_code = Render(*options); });
}

}  // namespace rockyard::app
