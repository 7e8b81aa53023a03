#include "uav_agent/python/call.hpp"

#include "uav_agent/python/interpreter.hpp"

namespace skein::agent::python {

const PlannerInput& Call::in(const std::string& what) const {
  if (in_ != nullptr) return *in_;
  const std::string text = what + ": plan() has returned since; read what you need during the call, and keep copies";
  PyErr_SetString(interpreter().words.gone_error.ptr(), text.c_str());
  throw py::error_already_set();
}

py::array Call::view(const std::string& name, const py::dtype& type, std::vector<py::ssize_t> shape,
                     std::vector<py::ssize_t> strides, const void* data) {
  py::capsule holder(this, [](void*) {});
  static const char nothing = 0;
  py::array array(type, std::move(shape), std::move(strides), data != nullptr ? data : &nothing, holder);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  views_.emplace_back(name, std::move(holder));
  return array;
}

std::string Call::kept() const {
  const auto first = [this]() -> std::string {
    for (const auto& [name, holder] : views_) {
      if (holder.ref_count() > 1) return name;
    }
    return {};
  };
  if (first().empty()) return {};
  py::module_::import("gc").attr("collect")();  // frees cycles of objects that no variable refers to
  return first();
}

}  // namespace skein::agent::python
