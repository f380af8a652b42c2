// The command `rockyard cylinder`: finds the coloured cylinder of a rover in two images.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "app/commands.h"
#include "app/console.h"
#include "app/output_files.h"
#include "campaign/cylinder/find_cylinder.h"
#include "core/archive.h"
#include "core/error.h"
#include "core/json_text.h"
#include "math/angles.h"
#include "report/line_text.h"
#include "report/parameter_table.h"

namespace rockyard::app {
namespace {

struct CylinderOptions {
  campaign::CylinderRequest request;
  bool published = false;
  bool parameters = false;
  bool json = false;
};

std::string SightingText(const vision::CylinderSighting& sighting) {
  const math::Vector3& p = sighting.p_LT_L;
  const Eigen::Vector4d sd = sighting.covariance.diagonal().cwiseSqrt();
  return fmt::format(
      "found\n"
      "  orientation {:.2f} deg, standard deviation {:.2f} deg: azimuth of the cameras in the "
      "cylinder's frame\n"
      "  centre ({:.4f}, {:.4f}, {:.4f}) m in the cameras' outer frame, standard deviations "
      "({:.4f}, {:.4f}, {:.4f}) m\n"
      "  distance {:.3f} m by stereo, {:.3f} m by size\n",
      math::RadToDeg(sighting.orientation_rad), math::RadToDeg(sd[3]), p.x(), p.y(), p.z(), sd[0],
      sd[1], sd[2], sighting.distance_by_stereo_m, sighting.distance_by_size_m);
}

std::string CylinderText(const campaign::CylinderRequest& request,
                         const campaign::CylinderResult& result) {
  std::string text =
      fmt::format("left   {}: {}\nright  {}: {}\n", report::Printable(request.left.string()),
                  result.read[0], report::Printable(request.right.string()), result.read[1]);
  text += result.finding.sighting ? SightingText(*result.finding.sighting)
                                  : fmt::format("not found ({}): {}\n",
                                                core::EnumNames<vision::CylinderMiss>::kNames.at(
                                                    static_cast<std::size_t>(result.finding.miss)),
                                                result.finding.reason);
  return text + FilesText(result.files);
}

void CheckCylinderRequest(const campaign::CylinderRequest& request) {
  for (const auto& [name, path] : {std::pair{"LEFT", &request.left},
                                   {"RIGHT", &request.right},
                                   {"--cameras", &request.cameras}}) {
    if (path->empty()) {
      throw core::UserError(
          name, "is missing",
          "rockyard cylinder LEFT RIGHT --cameras FILE; see rockyard cylinder --help");
    }
  }
}

ExitCode Cylinder(CylinderOptions& options) {
  if (options.parameters) {
    Print(report::ParametersMarkdown(core::ListParams<campaign::CylinderParams>().parameters()));
    return ExitCode::kDone;
  }
  CheckCylinderRequest(options.request);
  if (options.published) options.request.finder = campaign::CylinderFinder::kPublished;
  const campaign::CylinderResult result = campaign::FindCylinderInFiles(options.request);
  if (options.json) {
    PrintJson(core::DumpJson(campaign::CylinderJson(options.request, result)));
  } else {
    Print(CylinderText(options.request, result));
  }
  return result.finding.sighting ? ExitCode::kDone : ExitCode::kInconclusive;
}

}  // namespace

void AddCylinderCommand(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<CylinderOptions>();
  campaign::CylinderRequest& request = options->request;
  CLI::App* command = app.add_subcommand(
      "cylinder",
      "Finds the coloured cylinder of a rover in two colour images: place and orientation");
  command->footer(
      "Images: PNG, JPEG, PPM, and with GDAL PDS3, PDS4, VICAR, in colour. Cameras: as of "
      "`rockyard "
      "stereo`.\nA cylinder that is not found is inconclusive (exit code 4), with its reason.\n\n" +
      app.get_footer());
  command->add_option("LEFT", request.left, "image of the left eye");
  command->add_option("RIGHT", request.right, "image of the right eye, of the same size");
  command->add_option("--cameras", request.cameras, "file with the cameras of both images");
  command->add_flag("--published", options->published,
                    "the algorithm of Matthies 1995, appendix A, as it is: it does not check that "
                    "what it finds is a cylinder");
  command->add_option("--out", request.out,
                      "folder for a picture with the regions and a summary; it is made (default: "
                      "nothing is written)");
  AddExistingFiles(*command, request.existing);
  command->add_option("--param", request.settings, "PATH=VALUE: changes a parameter; repeat")
      ->allow_extra_args(false);
  command->add_flag("--parameters", options->parameters,
                    "lists what --param changes, and does nothing else");
  command->add_flag("--json", options->json, "for programs");
  command->callback([options, &exit_code] { exit_code = Cylinder(*options); });
}

}  // namespace rockyard::app
