#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <cstring>
#include <stdexcept>
#include <string>

#include "peer.h"

namespace rockyard::rover {
namespace {

using math::Vector3;

std::string Text(const Vector3& v) { return fmt::format("{} {} {}", v.x(), v.y(), v.z()); }

std::string Inertial(const BodyMass& mass) {
  return fmt::format("<inertial pos='{}' mass='{}' diaginertia='{}'/>", Text(mass.com_B),
                     mass.mass_kg, Text(mass.inertia_kg_m2));
}

// Grounds are of type 1, rocks of type 2.
std::string Geom(const Part& part) {
  const double margin_m = part.margin_m;
  const std::string meets =
      fmt::format("contype='0' conaffinity='{}'", part.meets == Meets::kEverything ? 3 : 2);
  switch (part.core) {
    case Core::kPoint:
      return fmt::format("<geom type='sphere' {} pos='{}' size='{}'/>", meets, Text(part.a_B),
                         margin_m);
    case Core::kSegment:
      if (part.a_B == part.b_B) {
        return fmt::format("<geom type='sphere' {} pos='{}' size='{}'/>", meets, Text(part.a_B),
                           margin_m);
      }
      return fmt::format("<geom type='capsule' {} fromto='{} {}' size='{}'/>", meets,
                         Text(part.a_B), Text(part.b_B), margin_m);
    case Core::kCylinder:
      return fmt::format("<geom type='cylinder' {} zaxis='0 1 0' size='{} {}'/>", meets,
                         part.b_B.x() + margin_m, part.b_B.y() + margin_m);
    case Core::kBox:
      return fmt::format("<geom type='box' {} pos='{}' size='{}'/>", meets, Text(part.a_B),
                         Text(part.b_B + Vector3::Constant(margin_m)));
  }
  return {};
}

// The body and all that it carries.
std::string Body(const PeerScene& scene, int body) {
  std::string text;
  if (body == kChassis) {
    text = "<body><freejoint/>" + Inertial(scene.chassis);
  } else {
    const auto joint = static_cast<std::size_t>(body);
    text = fmt::format("<body pos='{}'><joint name='j{}' axis='0 1 0'/>",
                       Text(scene.FromParent(joint)), body) +
           Inertial(scene.links[joint].mass);
  }
  for (const Part& part : scene.parts) {
    if (part.body == body) text += Geom(part);
  }
  for (int child = 0; child < kJoints; ++child) {
    if (scene.links[static_cast<std::size_t>(child)].parent == body) text += Body(scene, child);
  }
  return text + "</body>";
}

std::string Model(const PeerScene& scene, bool firm) {
  std::string text = fmt::format(
      "<mujoco><compiler angle='radian'/><option timestep='{}' iterations='{}' gravity='0 0 {}' "
      "cone='{}' impratio='{}'/>"
      "<default><geom friction='0.8 0 0'/></default><worldbody>"
      "<geom type='plane' size='0 0 1' contype='1' conaffinity='0'/>",
      scene.step_s, scene.iterations, -scene.params.physics.gravity_m_s2,
      firm ? "elliptic" : "pyramidal", firm ? 10 : 1);
  for (const Ball& ball : scene.balls) {
    text += fmt::format("<geom type='sphere' contype='2' conaffinity='0' pos='{}' size='{}'/>",
                        Text(ball.center_W), ball.radius_m);
  }
  // Wheels follow an angle as a constraint: velocity servos of 100 Nm s/rad act beside the
  // solver, not in it, and at 60 Hz drive the rover twice as far.
  text += Body(scene, kChassis) + "</worldbody><equality>";
  for (int joint = kFirstWheel; joint < kJoints; ++joint) {
    text += fmt::format("<joint joint1='j{}' polycoef='0 0 0 0 0'/>", joint);
  }
  return text + "<joint joint1='j0' joint2='j1' polycoef='0 -1 0 0 0'/></equality></mujoco>";
}

struct ModelDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DataDeleter {
  void operator()(mjData* data) const { mj_deleteData(data); }
};

class Mujoco : public Peer {
 public:
  Mujoco(const PeerScene& scene, bool firm) {
    const std::string text = Model(scene, firm);
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "rover.xml", static_cast<int>(text.size()));
    std::memcpy(files->filedata[0], text.data(), text.size());
    std::array<char, 1000> error{};
    model_.reset(mj_loadXML("rover.xml", files.get(), error.data(), error.size()));
    mj_deleteVFS(files.get());
    if (!model_) throw std::runtime_error(error.data());
    data_.reset(mj_makeData(model_.get()));
  }

  void Step(double rate_rad_s) override {
    angle_rad_ += rate_rad_s * model_->opt.timestep;
    for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
      model_->eq_data[mjNEQDATA * i] = angle_rad_;
    }
    mj_step(model_.get(), data_.get());
  }

  math::Transform X_WR() const override {
    const mjtNum* q = data_->qpos;
    math::Transform X = math::Transform::Identity();
    X.linear() = Eigen::Quaterniond(q[3], q[4], q[5], q[6]).toRotationMatrix();
    X.translation() << q[0], q[1], q[2];
    return X;
  }

  messages::PerWheel<double> WheelAngles() const override {
    messages::PerWheel<double> angles{};
    for (std::size_t i = 0; i < messages::kWheelCount; ++i) {
      const std::string name = fmt::format("j{}", static_cast<std::size_t>(kFirstWheel) + i);
      const int joint = mj_name2id(model_.get(), mjOBJ_JOINT, name.c_str());
      angles[i] = data_->qpos[model_->jnt_qposadr[joint]];
    }
    return angles;
  }

 private:
  std::unique_ptr<mjModel, ModelDeleter> model_;
  std::unique_ptr<mjData, DataDeleter> data_;
  double angle_rad_ = 0.0;
};

}  // namespace

std::unique_ptr<Peer> MakeMujoco(const PeerScene& scene, bool firm) {
  return std::make_unique<Mujoco>(scene, firm);
}

}  // namespace rockyard::rover
