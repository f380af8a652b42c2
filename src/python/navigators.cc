#include <pybind11/stl.h>
#include <unistd.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "navigation/navigator_fault.h"
#include "plugin/answerer.h"
#include "plugin/foreign_navigator.h"
#include "python/errors.h"
#include "python/held.h"
#include "python/parts.h"

namespace rockyard::python {
namespace {

namespace py = pybind11;
using navigation::FaultKind;
using navigation::NavigatorFault;

// A session of rockyard.inprocess, which answers the messages of navigators' processes. Nothing
// limits what it uses: it is code of this process, as the one who asked for it knows.
class Session final : public plugin::Answerer {
 public:
  explicit Session(const Held& make) : starter_(getpid()) {
    const py::gil_scoped_acquire lock;
    try {
      session_.Take(make.get()());
    } catch (const py::error_already_set& error) {
      throw NavigatorFault(FaultKind::kThrew, TextOf(error));
    }
  }

  std::string Ask(std::string_view message, const navigation::LimitParams& /*limits*/,
                  double /*left_cpu_s*/) override {
    const py::gil_scoped_acquire lock;
    ++asked_;
    try {
      const py::object answer = session_.get()(py::bytes(message.data(), message.size()));
      used_s_ = session_.get().attr("used_s").cast<double>();
      return answer.cast<std::string>();
    } catch (const py::error_already_set& error) {
      throw NavigatorFault(FaultKind::kThrew, TextOf(error));
    } catch (const py::cast_error& error) {
      throw NavigatorFault(FaultKind::kMessage, error.what());
    }
  }
  std::int64_t asked() const override { return asked_; }
  double used_s() const override { return used_s_; }
  bool usable() const override { return starter_ == getpid(); }

 private:
  Held session_;
  pid_t starter_;
  std::int64_t asked_ = 0;
  double used_s_ = 0.0;
};

}  // namespace

void BindNavigators(py::module_& module) {
  ScenarioClass(module).def(
      "add_navigator",
      [](OpenScenario& scenario, const std::string& name, const std::string& identity,
         const py::object& make) {
        const auto held = std::make_shared<const Held>(make);
        const py::gil_scoped_release released;
        scenario.values.navigators().Add(std::make_unique<plugin::ForeignKind>(
            plugin::OpenAnswerer(name, [held] { return std::make_unique<Session>(*held); })));
        scenario.AddProgram(identity);
      },
      py::arg("name"), py::arg("identity"), py::arg("make"));
}

}  // namespace rockyard::python
