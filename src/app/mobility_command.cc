// The command `rockyard mobility`: how a rover gets on on slopes and over steps.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/output_files.h"
#include "app/progress_line.h"
#include "app/run_display.h"
#include "campaign/mobility/mobility_charts.h"
#include "campaign/mobility/mobility_files.h"
#include "core/error.h"
#include "core/json_text.h"
#include "core/text.h"
#include "report/line_text.h"

namespace rockyard::app {
namespace {

using campaign::MobilityCase;
using campaign::SlopePoint;

struct MobilityOptions {
  campaign::MobilityRequest request;
  std::string slopes = "0:25:1";
  std::string fidelity = "quasi_static";
  std::string out;
  campaign::ExistingFiles existing = campaign::ExistingFiles::kRefuse;
  bool no_steps = false;
  bool json = false;
};

std::vector<double> Numbers(std::string_view text, char separator) {
  std::vector<double> numbers;
  while (true) {
    const std::size_t end = std::min(text.find(separator), text.size());
    const auto number = core::FiniteNumber(text.substr(0, end));
    if (!number) return {};
    numbers.push_back(*number);
    if (end == text.size()) return numbers;
    text.remove_prefix(end + 1);
  }
}

// Returns the slopes of "FROM:TO:BY" or "A,B,C".
std::vector<double> SlopesOf(const std::string& text) {
  constexpr double kMost = 1000.0;
  if (text.find(':') == std::string::npos) {
    std::vector<double> slopes = Numbers(text, ',');
    if (!slopes.empty()) return slopes;
  } else if (const std::vector<double> of = Numbers(text, ':');
             of.size() == 3 && of[2] > 0.0 && of[1] >= of[0] && (of[1] - of[0]) / of[2] < kMost) {
    std::vector<double> slopes;
    const int count = static_cast<int>((of[1] - of[0]) / of[2] + 1e-9);
    for (int i = 0; i <= count; ++i) slopes.push_back(of[0] + i * of[2]);
    return slopes;
  }
  throw core::UserError("--slopes", fmt::format("cannot be \"{}\"", text),
                        "give FROM:TO:BY in degrees, such as 0:25:1, or a list such as 0,5,10");
}

std::string SlopeWords(double deg) {
  return deg >= campaign::kSteepest_deg ? fmt::format("over {:g}", deg)
                                        : fmt::format("{:.1f}", deg);
}

std::string BandWords(const MobilityCase& of, double campaign::SoilCurves::*value) {
  if (of.draws.empty()) return "";
  const campaign::DrawnBand band =
      campaign::BandOver(of, [&](const campaign::SoilCurves& curves) { return curves.*value; });
  return fmt::format("{:.1f} .. {:.1f}", band.low, band.high);
}

std::string CaseName(const MobilityCase& of) {
  return of.load == 1.0 ? of.soil : fmt::format("{} x {:g}", of.soil, of.load);
}

std::string LimitsText(const campaign::MobilityRequest& request,
                       const campaign::MobilityResult& result) {
  std::string text = fmt::format("\n{:<22}{:>22}{:>15}{:>16}{:>15}{:>14}\n", "soil",
                                 fmt::format("slip below {:g} % [deg]", 100.0 * request.slip_limit),
                                 request.draws > 0 ? "band" : "", "gets on [deg]",
                                 request.draws > 0 ? "band" : "", request.steps ? "step [m]" : "");
  for (const MobilityCase& of : result.cases) {
    text += fmt::format(
        "{:<22}{:>22}{:>15}{:>16}{:>15}{:>14}\n", CaseName(of), SlopeWords(of.curves.limit_deg),
        BandWords(of, &campaign::SoilCurves::limit_deg), SlopeWords(of.curves.climbs_deg),
        BandWords(of, &campaign::SoilCurves::climbs_deg),
        of.curves.step_m ? fmt::format("{:.3f}", *of.curves.step_m) : "");
  }
  return text;
}

template <typename Values>
double TotalOf(const Values& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

std::string SlopeLine(const MobilityCase& of, double slope_deg, std::size_t i) {
  const SlopePoint& up = of.curves.slopes[0][i];
  const SlopePoint& across = of.curves.slopes[2][i];
  const auto state = [](const SlopePoint& point) {
    return core::EnumNames<campaign::SlopeState>::kNames.at(static_cast<std::size_t>(point.state));
  };
  std::string text = fmt::format("{:<22}{:>6.4g}", CaseName(of), slope_deg);
  text += up.has_values
              ? fmt::format("{:>9.1f}{:>10.1f}{:>10.2f}{:>9.2f}", 100.0 * up.slip,
                            1e3 * TotalOf(up.sinkage_m) / static_cast<double>(up.sinkage_m.size()),
                            TotalOf(up.torque_Nm), TotalOf(up.power_W))
              : fmt::format("{:>9}{:>10}{:>10}{:>9}", "-", "-", "-", "-");
  text += fmt::format("  {:<8}", state(up));
  text += across.has_values ? fmt::format("{:>8.1f}{:>12.1f}", 100.0 * across.slip,
                                          math::RadToDeg(across.side_slip_rad))
                            : fmt::format("{:>8}{:>12}", "-", "-");
  return text + fmt::format("  {}\n", state(across));
}

// Six slopes of each case at most; the files have all.
std::string SlopesText(const campaign::MobilityResult& result) {
  std::string text =
      fmt::format("\n{:<28}{:<46}{}\n{:<22}{:>6}{:>9}{:>10}{:>10}{:>9}  {:<8}{:>8}{:>12}\n", "",
                  "  straight up", "  across", "soil", "[deg]", "slip [%]", "sink [mm]", "M [Nm]",
                  "P [W]", "", "slip [%]", "side [deg]");
  const std::size_t slopes = result.slopes_deg.size();
  const std::size_t every = std::max<std::size_t>(1, (slopes + 3) / 5);
  for (const MobilityCase& of : result.cases) {
    for (std::size_t i = 0; i < slopes; i += every) text += SlopeLine(of, result.slopes_deg[i], i);
  }
  return text;
}

std::string MobilityText(const campaign::MobilityRequest& request,
                         const campaign::MobilityResult& result,
                         std::span<const campaign::OutputFile> files) {
  std::string text = fmt::format("mobility of {}\n", report::Printable(result.source.name));
  for (const std::string& line : campaign::MobilityHead(request, result)) {
    text += "  " + line + "\n";
  }
  text = report::Wrapped(text);
  return text + LimitsText(request, result) + SlopesText(result) + FilesText(files);
}

ExitCode Mobility(MobilityOptions& options) {
  campaign::MobilityRequest& request = options.request;
  request.slopes_deg = SlopesOf(options.slopes);
  request.steps = !options.no_steps;
  request.fidelity =
      options.fidelity == "multibody" ? rover::Fidelity::kMultibody : rover::Fidelity::kQuasiStatic;
  std::optional<campaign::OutputFolder> folder;
  if (!options.out.empty()) {
    folder.emplace(options.out, options.existing, campaign::MobilityPlan(request));
  }
  ProgressLine line(stderr);
  const auto show = [&](std::size_t done, std::size_t planned) {
    const std::string text = fmt::format("  {}/{} curves", done, planned);
    if (done == planned) {
      line.FinishText(text);
    } else {
      line.ShowText(text);
    }
  };
  const campaign::MobilityResult result = campaign::StudyMobility(request, show, StopBySignal());
  if (result.outcome != ExitCode::kDone) {
    PrintNote("interrupted: nothing is written");
    return result.outcome;
  }
  if (folder) campaign::WriteMobility(request, result, *folder);
  const std::vector<campaign::OutputFile> files =
      folder ? folder->files() : std::vector<campaign::OutputFile>();
  if (options.json) {
    PrintJson(core::DumpJson(campaign::MobilityJson(request, result, files)));
  } else {
    Print(MobilityText(request, result, files));
  }
  return result.outcome;
}

void AddSoilOptions(CLI::App& command, MobilityOptions& options) {
  campaign::MobilityRequest& request = options.request;
  command
      .add_option("--soil", request.soils,
                  "preset of terrain.ground.soil, or own: that of the scenario; repeat (default: "
                  "landscaping_sand, mars_drift and hard_ground)")
      ->allow_extra_args(false);
  command
      .add_option("--draws", request.draws,
                  "soils drawn by terrain.ground.soil.spread around each, for bands (20); 0: none")
      ->check(CLI::Range(0, 1000));
  command.add_option("--seed", request.seed, "of these draws (1)")
      ->check(CLI::Range(std::uint64_t{0},
                         static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())));
  command.add_option("--load", request.loads, "factor of all masses of the rover; repeat (1)")
      ->allow_extra_args(false)
      ->check(CLI::Range(0.01, 100.0));
}

}  // namespace

void AddMobilityCommand(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<MobilityOptions>();
  campaign::MobilityRequest& request = options->request;
  CLI::App* command = app.add_subcommand(
      "mobility",
      "Charts how a rover gets on: slip, torque, power and sinkage on slopes, pull of a wheel, "
      "steepest slope and highest step");
  command->footer(
      "Points, as CSV: a line of names, of soil, way (up, down, across), slope_deg, slip, "
      "side_slip_deg,\nsinkage_mm, torque_Nm, wheel_torque_Nm, power_W, pull_per_load; then the "
      "points. docs/mobility.md says\nhow all of it is meant.\n\n" +
      app.get_footer());
  command
      ->add_option("ROVER", request.rover,
                   "scenario or rover file (scenarios/rovers), its name, the folder of a run, or "
                   "a URDF file")
      ->required();
  command->add_option("--set", request.overrides, "PATH=VALUE: changes the scenario; repeat")
      ->allow_extra_args(false);
  command->add_option("--out", options->out,
                      "folder for charts and tables; it is made (default: nothing is written)");
  AddExistingFiles(*command, options->existing);
  command->add_option("--slopes", options->slopes, "deg: FROM:TO:BY, or A,B,C (0:25:1)");
  AddSoilOptions(*command, *options);
  command
      ->add_option("--slip-limit", request.slip_limit,
                   "slip up to which a slope counts as climbed (0.8)")
      ->check(CLI::Range(0.01, 1.0));
  command->add_option("--points", request.points, "CSV file of measured points to draw in");
  command->add_flag("--no-steps", options->no_steps, "looks for no highest step");
  command
      ->add_option("--fidelity", options->fidelity,
                   "of the rover on slopes: quasi_static or multibody (quasi_static)")
      ->check(CLI::IsMember({"quasi_static", "multibody"}));
  command
      ->add_option("--threads", request.threads,
                   "threads (default: all of the machine); results do not depend on them")
      ->check(CLI::Range(1, 256));
  command->add_flag("--json", options->json, "for programs");
  command->callback([options, &exit_code] { exit_code = Mobility(*options); });
}

}  // namespace rockyard::app
