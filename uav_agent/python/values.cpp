#include "uav_agent/python/values.hpp"

#include <cmath>
#include <cstring>
#include <string_view>

namespace skein::agent::python {
namespace {

/// Describes a value in a few words, for messages: its repr() and type, or only its shape or type if it is large.
std::string described(py::handle value) {
  if (value.is_none()) return "None";
  constexpr std::size_t kLongest = 60;  // chosen
  const std::string type = Py_TYPE(value.ptr())->tp_name;
  if (py::isinstance<py::array>(value)) {
    const auto array = py::reinterpret_borrow<py::array>(value);
    const std::string shape = py::str(array.attr("shape")), element_type = py::str(array.dtype());
    if (array.size() > 3) return "an array of shape " + shape + " of " + element_type;
  }
  std::string text;
  try {
    text = py::repr(value);
  } catch (py::error_already_set&) {
    return "a " + type;
  }
  if (text.size() > kLongest) return "a " + type;
  return text + (py::isinstance<py::array>(value) ? "" : " (" + type + ")");
}

/// The value as a number, also from NumPy's scalars. @returns NaN if it is not a real number, or is a bool.
double number_in(py::handle value) {
  if (PyFloat_Check(value.ptr()) != 0) return PyFloat_AS_DOUBLE(value.ptr());
  if (PyNumber_Check(value.ptr()) == 0 || PyBool_Check(value.ptr()) != 0) return std::nan("");
  if (std::string_view(Py_TYPE(value.ptr())->tp_name).starts_with("numpy.complex")) return std::nan("");
  const double number = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    return std::nan("");
  }
  return number;
}

/// Whether the array's memory has the layout of a Vector3d: three adjacent doubles in this machine's byte order.
bool is_like_vector3d(const py::array& array) {
  constexpr char kNative = '=';
  return array.ndim() == 1 && array.shape(0) == 3 && array.dtype().num() == py::detail::npy_api::NPY_DOUBLE_ &&
         array.dtype().byteorder() == kNative && array.strides(0) == sizeof(double) &&
         (array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_) != 0;
}

/// Whether the elements are floating-point numbers or integers (kinds of NumPy: f; i and, without sign, u).
bool has_real_numbers(const py::array& array) {
  return std::string_view("fiu").find(array.dtype().kind()) != std::string::npos;
}

}  // namespace

std::string Place::text() const {
  if (index_ >= 0) return parent_->text() + "[" + std::to_string(index_) + "]";
  return parent_ != nullptr ? parent_->text() + "." + name_ : name_;
}

void Place::refuse(const std::string& wanted, py::handle value) const {
  throw WrongOutput(text() + ": must be " + wanted + ", not " + described(value));
}

py::object to_array(const Vector3d& vector) {
  py::array_t<double> array(3);
  std::memcpy(array.mutable_data(), vector.data(), 3 * sizeof(double));
  return array;
}

py::object to_array(const Matrix3d& matrix) {
  py::array_t<double> array({3, 3});
  for (py::ssize_t i = 0; i < 3; ++i) {
    for (py::ssize_t j = 0; j < 3; ++j) array.mutable_at(i, j) = matrix(i, j);
  }
  return array;
}

py::object to_text(const std::string& bytes) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "surrogateescape"));
}

Vector3d read_vector(py::handle value, const Place& place) {
  constexpr const char* kWanted = "three finite numbers";
  Vector3d vector = Vector3d::Constant(std::nan(""));
  if (py::isinstance<py::array>(value)) {
    const auto array = py::reinterpret_borrow<py::array>(value);
    if (is_like_vector3d(array)) {
      vector = Eigen::Map<const Vector3d>(static_cast<const double*>(array.data()));
    } else if (array.ndim() == 1 && array.shape(0) == 3 && has_real_numbers(array)) {
      for (py::ssize_t i = 0; i < 3; ++i) vector[i] = number_in(array[py::int_(i)]);
    }
  } else if (PyTuple_Check(value.ptr()) != 0 || PyList_Check(value.ptr()) != 0) {
    const py::tuple items = read_list(value, place, kWanted);
    for (std::size_t i = 0; items.size() == 3 && i < 3; ++i) {
      vector[static_cast<Eigen::Index>(i)] = number_in(items[i]);
    }
  }
  if (!vector.allFinite()) place.refuse(kWanted, value);
  return vector;
}

double read_number(py::handle value, const Place& place) {
  const double number = number_in(value);
  if (!std::isfinite(number)) place.refuse("a finite number", value);
  return number;
}

std::int64_t read_integer(py::handle value, const Place& place) {
  if (PyIndex_Check(value.ptr()) != 0 && PyBool_Check(value.ptr()) == 0) {
    const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
    int overflow = 0;
    const long long number = index ? PyLong_AsLongLongAndOverflow(index.ptr(), &overflow) : -1;
    const bool failed = !index || overflow != 0 || (number == -1 && PyErr_Occurred() != nullptr);
    PyErr_Clear();
    if (!failed) return number;
  }
  place.refuse("an integer of 64 bits", value);
}

bool read_bool(py::handle value, const Place& place) {
  if (value.ptr() == Py_True || value.ptr() == Py_False) return value.ptr() == Py_True;
  if (std::string(Py_TYPE(value.ptr())->tp_name).starts_with("numpy.bool")) return PyObject_IsTrue(value.ptr()) == 1;
  place.refuse("True or False", value);
}

std::string read_text(py::handle value, const Place& place) {
  if (PyUnicode_Check(value.ptr()) == 0) place.refuse("a text", value);
  const auto bytes =
      py::reinterpret_steal<py::object>(PyUnicode_AsEncodedString(value.ptr(), "utf-8", "surrogateescape"));
  if (!bytes) {
    PyErr_Clear();
    place.refuse("a text that UTF-8 can encode", value);
  }
  std::string text = bytes.cast<std::string>();
  if (text.find('\0') != std::string::npos) place.refuse("a text without NUL", value);
  return text;
}

std::string read_bytes(py::handle value, const Place& place) {
  if (PyBytes_Check(value.ptr()) == 0) place.refuse("bytes", value);
  return value.cast<std::string>();
}

py::tuple read_list(py::handle value, const Place& place, const std::string& of) {
  if (PyTuple_Check(value.ptr()) == 0 && PyList_Check(value.ptr()) == 0) {
    place.refuse("a list or tuple of " + of, value);
  }
  auto items = py::reinterpret_steal<py::tuple>(PySequence_Tuple(value.ptr()));
  if (!items) throw py::error_already_set();
  return items;
}

}  // namespace skein::agent::python
