// rockyard render
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>

#include "app/busy_line.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/scenario_names.h"
#include "campaign/shell_word.h"
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
};

std::string ResultText(const campaign::RenderRequest& request,
                       const campaign::RenderResult& result) {
  std::string text = fmt::format(
      "{} x {} pixels each, exposed for {:.4g} s, with the rover at x {:.2f} m, y {:.2f} m, "
      "heading "
      "{:.1f} deg\n  both eyes see what {:.1f} % of the left image's pixels show",
      result.size.columns, result.size.rows, result.exposure_s, result.pose.x_m, result.pose.y_m,
      math::RadToDeg(result.pose.heading_rad), 100.0 * result.seen_by_both);
  if (result.nearest_m > 0.0) text += fmt::format(", from {:.2f} m on", result.nearest_m);
  text += "\n";
  for (const campaign::OutputFile& file : result.files) {
    text += fmt::format("  {} in {}\n", file.what, report::Printable(file.path.string()));
  }
  const auto in = [&](const char* name) {
    return campaign::ShellWord((request.out / name).string());
  };
  return text + fmt::format(
                    "  next: rockyard stereo {} {} --cameras {} --nearest {:.2f} --reference {} "
                    "--out {}\n",
                    in("left.png"), in("right.png"), in("cameras.json"),
                    std::max(result.nearest_m, 0.01), in("disparity.pfm"), in("stereo"));
}

void Render(RenderOptions& options) {
  if (options.request.out.empty()) {
    throw core::UserError("--out", "is missing", "name a folder for the images");
  }
  options.request.scenario = ScenarioFile(options.scenario);
  if (options.behind) options.request.direction = messages::LookDirection::kBehind;
  if (options.heading_deg) options.request.heading_rad = math::DegToRad(*options.heading_deg);
  const campaign::RenderResult result = [&] {
    const BusyLine busy("rendering the images");
    return campaign::RenderPair(options.request);
  }();
  Print(ResultText(options.request, result));
}

}  // namespace

void AddRenderCommand(CLI::App& app) {
  auto options = std::make_shared<RenderOptions>();
  campaign::RenderRequest& request = options->request;
  CLI::App* command = app.add_subcommand(
      "render",
      "Takes a picture with either stereo camera of a scenario's rover, with what is true of them");
  command->add_option("SCENARIO", options->scenario, "Scenario file or its name")->required();
  command->add_option("--out", request.out, "folder for what comes out; it is made");
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
  command->callback([options] { Render(*options); });
}

}  // namespace rockyard::app
