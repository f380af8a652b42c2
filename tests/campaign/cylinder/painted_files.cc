#include "campaign/cylinder/painted_files.h"

#include <fstream>

#include "core/json_text.h"
#include "image_files/png_file.h"
#include "math/angles.h"
#include "vision/cameras/camera_file.h"
#include "vision/cylinder/painted_cylinder.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

void WriteBytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace

CylinderRequest WritePaintedPair(const fs::path& folder) {
  const vision::PaintedPair pair = Paint(vision::SceneAt(2.0, math::DegToRad(30.0)));
  CylinderRequest request;
  request.left = folder / "left.png";
  request.right = folder / "right.png";
  request.cameras = folder / "cameras.json";
  WriteBytes(request.left, image_files::EncodePng(pair.left));
  WriteBytes(request.right, image_files::EncodePng(pair.right));
  WriteBytes(request.cameras,
             core::DumpJson(vision::CameraPairJson({pair.cameras.left, pair.cameras.right})));
  return request;
}

}  // namespace rockyard::campaign
