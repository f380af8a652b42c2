// The command `rockyard rover`: describes a rover, of a scenario or of a URDF file, or writes it as
// a URDF file or as a rover file.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/output_files.h"
#include "campaign/output_folder.h"
#include "campaign/rover_source.h"
#include "core/error.h"
#include "core/json_text.h"
#include "math/angles.h"
#include "report/line_text.h"
#include "rover/rover_layout_params.h"
#include "rover/rover_params.h"
#include "rover/urdf.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUrdfEnding = ".urdf";
constexpr const char* kRoverEnding = ".json";

struct RoverOptions {
  std::string scenario;
  std::vector<std::string> overrides;
  std::string out;
};

void CheckOut(const std::string& out) {
  if (out.empty()) return;
  const fs::path extension = fs::path(out).extension();
  if (extension != kUrdfEnding && extension != kRoverEnding) {
    throw core::UserError("--out", "does not end in .urdf or .json: " + out,
                          "name a URDF file (.urdf) or a rover file (.json)");
  }
  campaign::CheckOutputFile("--out", out);
}

std::string Line(std::string_view what, const std::string& text) {
  return fmt::format("  {:<18}{}\n", what, text);
}

std::string Dimensions(const rover::RoverParams& params) {
  const rover::RoverGeometryParams& g = params.geometry;
  const rover::RoverGeometry geometry = rover::MakeRoverGeometry(g);
  const auto steered = std::count(geometry.steered.begin(), geometry.steered.end(), true);
  const double track_m = geometry.wheel_R[0].y() - geometry.wheel_R[3].y();
  return Line("size", fmt::format("{:g} x {:g} x {:g} m", g.length_m, g.width_m, g.height_m)) +
         Line("clearance", fmt::format("{:g} m under the chassis", g.belly_clearance_m)) +
         Line("wheels", fmt::format("6 of radius {:g} m and width {:g} m, {} steered",
                                    g.wheel_radius_m, g.wheel_width_m, steered)) +
         Line("axles",
              fmt::format("{:g} m from front to rear, track {:g} m", g.wheelbase_m, track_m)) +
         Line("suspension",
              fmt::format("bogies at the {}; stops: rockers {:.0f} deg, bogies {:.0f} deg",
                          g.bogie_end == rover::BogieEnd::kFront ? "front" : "rear",
                          math::RadToDeg(g.rocker_limit_rad), math::RadToDeg(g.bogie_limit_rad)));
}

std::string MassesAndMotors(const rover::RoverParams& params) {
  const rover::RoverMasses m = rover::MakeRoverMasses(params);
  const rover::RoverDriveParams& drive = params.drive;
  const double rim_N = drive.stall_torque_Nm / params.geometry.wheel_radius_m;
  return Line("mass", fmt::format("{:g} kg: chassis {:g}, rockers 2 x {:g}, bogies 2 x {:g}, "
                                  "wheels 6 x {:g}",
                                  params.mass.total_kg, m.chassis.mass_kg, m.rocker.mass_kg,
                                  m.bogie.mass_kg, m.wheel.mass_kg)) +
         Line("speed", fmt::format("{:g} m/s at the rim of the fastest wheel", drive.speed_m_s)) +
         Line("drive motors",
              fmt::format("stall at {:g} Nm, {:.1f} N at the rim", drive.stall_torque_Nm, rim_N)) +
         Line("steering",
              fmt::format("to {:.0f} deg at {:.0f} deg/s", math::RadToDeg(drive.max_steer_rad),
                          math::RadToDeg(drive.steer_rate_rad_s)));
}

std::string Loads(const rover::RoverParams& params) {
  const messages::PerWheel<double> load_N = rover::StaticWheelLoads(params);
  return Line("wheel loads", fmt::format("front {:.1f} N, middle {:.1f} N, rear {:.1f} N on either "
                                         "side",
                                         load_N[0], load_N[1], load_N[2])) +
         Line("",
              fmt::format("on level ground at {:g} m/s2, by levers", params.physics.gravity_m_s2));
}

void ShowRover(const RoverOptions& options) {
  CheckOut(options.out);
  const campaign::RoverSource source = campaign::LoadRover(options.scenario, options.overrides);
  if (options.out.empty()) {
    Print(fmt::format("rover of {}\n", report::Printable(source.name)) + Dimensions(source.params) +
          MassesAndMotors(source.params) + Loads(source.params));
  } else if (fs::path(options.out).extension() == kUrdfEnding) {
    WriteNamedFile("URDF", options.out, rover::WriteUrdf(source.params));
  } else {
    WriteNamedFile("rover", options.out, core::DumpJson(source.group));
  }
  if (source.reading) Print(campaign::LeftOutText(source));
}

}  // namespace

void AddRoverCommand(CLI::App& app) {
  auto options = std::make_shared<RoverOptions>();
  CLI::App* command =
      app.add_subcommand("rover",
                         "Describes the rover of a scenario or of a URDF file, or writes it as a "
                         "URDF or rover file");
  command->footer(
      "Of a URDF file it also lists what rockyard's rover has not, and what the file does not "
      "say.\n"
      "scenarios/rovers/README.md tells how a scenario takes another rover.\n\n" +
      app.get_footer());
  command
      ->add_option("ROVER", options->scenario,
                   "scenario or rover file (scenarios/rovers), its name, the folder of a run, or a "
                   "URDF file")
      ->required();
  command->add_option("--set", options->overrides, "PATH=VALUE: changes the scenario; repeat")
      ->allow_extra_args(false);
  command->add_option(
      "--out", options->out,
      "file to write instead of the description: .urdf for other programs, .json for "
      "scenarios that extend it");
  command->callback([options] { ShowRover(*options); });
}

}  // namespace rockyard::app
