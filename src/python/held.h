// An object of Python that C++ keeps, and lets go from whatever thread.
#pragma once

#include <pybind11/pybind11.h>

#include <utility>

namespace rockyard::python {

// Holds a reference. get() and Take() need the interpreter's lock, the end of it takes the lock by
// itself; an interpreter that has ended keeps what it had.
class Held {
 public:
  Held() = default;
  explicit Held(pybind11::object object) : object_(std::move(object)) {}
  ~Held() {
    if (!object_) return;
    if (Py_IsInitialized() == 0) {
      object_.release();
      return;
    }
    const pybind11::gil_scoped_acquire lock;
    object_ = {};
  }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;

  void Take(pybind11::object object) { object_ = std::move(object); }
  const pybind11::object& get() const { return object_; }

 private:
  pybind11::object object_;
};

}  // namespace rockyard::python
