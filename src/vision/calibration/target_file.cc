#include "vision/calibration/target_file.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "core/archive.h"
#include "core/error.h"
#include "core/json_file.h"
#include "core/numbers.h"

namespace rockyard::vision {
namespace {

using core::JsonValue;
using core::Problem;
using core::Setting;

struct BoardPose {
  std::array<double, 3> position_m = {core::kNaN, core::kNaN, core::kNaN};
  std::array<double, 4> rotation_wxyz = {core::kNaN, core::kNaN, core::kNaN, core::kNaN};

  void Visit(core::FieldVisitor& v) {
    v.FixedReals("position_m", position_m, Setting("origin of the board in A, m", {-1e6, 1e6}));
    v.FixedReals("rotation_wxyz", rotation_wxyz,
                 Setting("unit quaternion of X_AT", {-1.001, 1.001}));
    v.Require("position_m", std::isfinite(position_m[0]), "is missing", "give x, y and z in m");
    double squared = 0.0;
    for (const double part : rotation_wxyz) squared += part * part;
    v.Require("rotation_wxyz", std::fabs(std::sqrt(squared) - 1.0) <= 1e-3,
              "is missing or not of length 1", "give the unit quaternion w, x, y, z");
  }

  math::Transform X_AT() const {
    const auto& [w, x, y, z] = rotation_wxyz;
    math::Transform pose = math::Transform::Identity();
    pose.linear() = Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
    pose.translation() = math::Vector3(position_m[0], position_m[1], position_m[2]);
    return pose;
  }
};

// Reads `json` into `params`, and adds problems with `place` before their paths.
template <typename Params>
void ReadInto(const JsonValue& json, const std::string& place, Params& params,
              std::vector<Problem>& problems) {
  try {
    core::ReadParams(json, params);
  } catch (const core::UserError& error) {
    for (Problem problem : error.problems()) {
      problem.path = place + problem.path;
      problems.push_back(std::move(problem));
    }
  }
}

}  // namespace

Target LoadTarget(const std::filesystem::path& path) {
  JsonValue json = core::LoadJsonFileAlone(path);
  const std::string file = path.string() + ": ";
  std::vector<Problem> problems;
  Target target;
  if (const JsonValue* poses = json.Find("poses")) {
    if (!poses->Is(JsonValue::Type::kList) || poses->list().empty()) {
      throw core::UserError(file + "poses", "is no list of poses",
                            "give a pose for each image, or leave it out");
    }
    for (std::size_t i = 0; i < poses->list().size(); ++i) {
      BoardPose pose;
      ReadInto(poses->list()[i], fmt::format("{}poses[{}].", file, i), pose, problems);
      target.surveyed_X_AT.push_back(pose.X_AT());
    }
    json.Erase("poses");
  }
  ReadInto(json, file, target.board, problems);
  if (!problems.empty()) throw core::UserError(std::move(problems));
  return target;
}

}  // namespace rockyard::vision
