// What `rockyard cylinder` does, for that command: two colour images to the place and the
// orientation of the coloured cylinder (Matthies 1995, section 5 and appendix A). No record depends
// on it: the experiment cylinder_sighting calls the finders itself.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "campaign/output_folder.h"
#include "core/fields.h"
#include "core/json_value.h"
#include "vision/cylinder/cylinder_sighting.h"
#include "vision/cylinder/published_finder_params.h"
#include "vision/cylinder/robust_finder_params.h"
#include "vision/image.h"

namespace rockyard::campaign {

enum class CylinderFinder {
  kRobust,     // vision/cylinder/robust_finder.h
  kPublished,  // vision/cylinder/published_finder.h
};

struct CylinderParams {
  vision::ColourCylinder cylinder;
  vision::RobustFinderParams robust;
  vision::PublishedFinderParams published;

  void Visit(core::FieldVisitor& v);
};

struct CylinderRequest {
  std::filesystem::path left;
  std::filesystem::path right;
  std::filesystem::path cameras;
  std::filesystem::path out;  // a folder, which is made; empty: no files
  ExistingFiles existing = ExistingFiles::kRefuse;
  CylinderFinder finder = CylinderFinder::kRobust;
  std::vector<std::string> settings;  // PATH=VALUE of CylinderParams
};

struct CylinderResult {
  CylinderParams params;
  std::array<std::string, 2> read;  // what was read and done, left and right
  vision::CylinderFinding finding;
  std::vector<OutputFile> files;
};

// Reads both images and the cameras, looks for the cylinder and, where the request names a folder,
// writes regions.png and cylinder.json. Throws core::UserError, before anything is written, for
// whatever is wrong with the input: files that cannot be read, grey images, images of two sizes or
// of another size than their cameras, one image twice, settings that mean nothing, and for the
// robust finder an axis that stands far from upwards in the image. A cylinder that is not found is
// no error: the finding says why.
CylinderResult FindCylinderInFiles(const CylinderRequest& request);

// Reads a colour image file as 8 bits of each primary, round(255 sample / full scale); `what`
// becomes what was read and done. Throws core::UserError.
vision::ColourImage ReadColour(const std::filesystem::path& path, std::string& what);

// Returns the file cylinder.json, described in src/campaign/README.md. Programs read it (--json).
// Must stay: its members; others may only be added.
core::JsonValue CylinderJson(const CylinderRequest& request, const CylinderResult& result);

}  // namespace rockyard::campaign
