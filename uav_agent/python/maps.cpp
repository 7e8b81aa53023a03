#include "uav_agent/python/maps.hpp"

#include <pybind11/stl.h>

#include <cmath>
#include <limits>
#include <string_view>

#include "uav_agent/python/values.hpp"

namespace skein::agent::python {
namespace {

/// Numeric: places farther away are in cells without a valid number.
constexpr double kFarthest_m = 1e5;
constexpr double kLongest_m = 1e4, kWidest_m = 50.0;  ///< segments; radii around them; chosen: bounds the CPU time
constexpr std::int64_t kMostCubes = 64'000'000;       ///< memory

struct MapOfCall {
  std::shared_ptr<Call> call;
  const MapQueries& ask() const { return *call->order().maps; }
};
struct PythonOccupancyMap : MapOfCall {
  const OccupancyMap& map() const { return call->in("inputs.map").map; }
};
struct PythonWorldMap : MapOfCall {
  const WorldMap& map() const { return *call->in("inputs.world_map").world_map; }
};
struct PythonFreeSpace : MapOfCall {
  const FreeSpace& map() const { return *call->in("inputs.space").space; }
};

[[noreturn]] void refuse(const std::string& name, const std::string& wanted) {
  throw py::value_error(name + ": must be " + wanted);
}

void check_places(const Eigen::Ref<const Eigen::ArrayXd>& numbers, const char* name) {
  if ((numbers.abs() <= kFarthest_m).all()) return;  // false for NaN
  refuse(name, "finite numbers within 100 km");
}

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

Numbers numbers_of(const py::object& value, const char* name) {
  const auto given = py::array::ensure(value);
  const bool is_real = given && std::string_view("fiu").find(given.dtype().kind()) != std::string_view::npos;
  const auto numbers = is_real ? Numbers::ensure(given) : Numbers();
  if (!is_real || !numbers) {
    PyErr_Clear();
    refuse(name, "an array of numbers");
  }
  check_places(Eigen::Map<const Eigen::ArrayXd>(numbers.data(), numbers.size()), name);
  return numbers;
}

Vector3d place_of(const py::object& value, const char* name) {
  const Numbers numbers = numbers_of(value, name);
  if (numbers.ndim() != 1 || numbers.shape(0) != 3) refuse(name, "three numbers");
  return Eigen::Map<const Vector3d>(numbers.data());
}

Vector3d direction_of(const py::object& value) {
  const Vector3d direction = place_of(value, "direction");
  constexpr double kLeast = 1e-9;  // numeric
  if (direction.norm() < kLeast) refuse("direction", "a vector that is not zero");
  return direction.normalized();
}

double within_reach(double value, double most, const char* name) {
  if (!(value >= 0.0 && value <= most)) refuse(name, "within [0, " + std::to_string(static_cast<int>(most)) + "] m");
  return value;
}

int rays_of(int rays) {
  // Format: a map does not count more rays than this (maps/ray_blocks.hpp).
  if (rays < 1 || rays > 20) refuse("rays", "within [1, 20]");
  return rays;
}

struct Segment {
  Segment(const py::object& a, const py::object& b) : a_W(place_of(a, "a_W")), b_W(place_of(b, "b_W")) {
    if ((b_W - a_W).norm() > kLongest_m) refuse("b_W", "within 10 km of a_W");
  }
  const Vector3d a_W, b_W;
};

/// Calls `ask` for one place, or for each of N places.
template <class T, class Ask>
py::object at_each(const py::object& value, const Ask& ask) {
  const Numbers numbers = numbers_of(value, "p_W");
  if (numbers.ndim() == 1 && numbers.shape(0) == 3) return py::cast(ask(Eigen::Map<const Vector3d>(numbers.data())));
  if (numbers.ndim() != 2 || numbers.shape(1) != 3) refuse("p_W", "of shape (3,) or (N, 3)");
  py::array_t<T> answers(numbers.shape(0));
  T* const out = answers.mutable_data();
  for (py::ssize_t i = 0; i < numbers.shape(0); ++i) out[i] = ask(Eigen::Map<const Vector3d>(numbers.data(i, 0)));
  return answers;
}

py::array_t<double> rows(const std::vector<Vector3d>& places) {
  py::array_t<double> array({static_cast<py::ssize_t>(places.size()), py::ssize_t{3}});
  double* out = array.mutable_data();
  for (const Vector3d& place : places) {
    for (const double number : place) *out++ = number;
  }
  return array;
}

OrientedBox read_box(const py::object& value) {
  OrientedBox box;
  box.center = place_of(value.attr("center"), "box.center");
  box.size = place_of(value.attr("size"), "box.size").cwiseAbs();
  const Numbers axes = numbers_of(value.attr("R_WO"), "box.R_WO");
  if (axes.ndim() != 2 || axes.shape(0) != 3 || axes.shape(1) != 3) refuse("box.R_WO", "of shape (3, 3)");
  box.R_WO = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(axes.data());
  return box;
}

py::array_t<std::uint8_t> window_of(const PythonWorldMap& self, const py::object& lowest_W,
                                    const std::array<std::int64_t, 3>& cubes) {
  for (const std::int64_t count : cubes) {
    if (count < 1 || count > kMostCubes) refuse("cubes", "three numbers of at least 1");
  }
  if (cubes[0] > kMostCubes / cubes[1] || cubes[0] * cubes[1] > kMostCubes / cubes[2]) {
    refuse("cubes", "64 million cubes at most");
  }
  py::array_t<std::uint8_t> spaces({cubes[0], cubes[1], cubes[2]});
  self.ask().read_window(self.map(), place_of(lowest_W, "lowest_W"),
                         {static_cast<int>(cubes[0]), static_cast<int>(cubes[1]), static_cast<int>(cubes[2])},
                         spaces.mutable_data());
  return spaces;
}

void register_occupancy_map(py::module_& module) {
  using Self = PythonOccupancyMap;
  using Object = py::object;
  py::class_<Self>(module, "OccupancyMap")
      .def_property_readonly("resolution_m", [](const Self& self) { return self.ask().resolution_m(self.map()); })
      .def_property_readonly("occupied_cells", [](const Self& self) { return self.ask().occupied_cells(self.map()); })
      .def_property_readonly("revision", [](const Self& self) { return self.ask().revision(self.map()); })
      .def_property_readonly("key_frames", [](const Self& self) { return self.ask().key_frames(self.map()); })
      .def(
          "occupied",
          [](const Self& self, const Object& p_W) {
            const OccupancyMap& map = self.map();
            return at_each<bool>(p_W, [&](const Vector3d& p) { return self.ask().occupied(map, p); });
          },
          py::arg("p_W"))
      .def(
          "known_free",
          [](const Self& self, const Object& p_W, int rays) {
            const OccupancyMap& map = self.map();
            rays_of(rays);
            return at_each<bool>(p_W, [&](const Vector3d& p) { return self.ask().known_free(map, p, rays); });
          },
          py::arg("p_W"), py::arg("rays") = 3)
      .def(
          "distance_to_occupied",
          [](const Self& self, const Object& p_W, double max_distance) {
            const OccupancyMap& map = self.map();
            within_reach(max_distance, kWidest_m, "max_distance");
            return at_each<double>(p_W, [&](const Vector3d& p) {
              return self.ask()
                  .distance_to_occupied(map, p, max_distance)
                  .value_or(std::numeric_limits<double>::infinity());
            });
          },
          py::arg("p_W"), py::arg("max_distance"))
      .def(
          "segment_clear",
          [](const Self& self, const Object& a_W, const Object& b_W, double radius) {
            const Segment way(a_W, b_W);
            return self.ask().segment_clear(self.map(), way.a_W, way.b_W, within_reach(radius, kWidest_m, "radius"));
          },
          py::arg("a_W"), py::arg("b_W"), py::arg("radius"))
      .def(
          "cast",
          [](const Self& self, const Object& from_W, const Object& direction, double max_distance, double radius) {
            return self.ask().cast(self.map(), place_of(from_W, "from_W"), direction_of(direction),
                                   within_reach(max_distance, kLongest_m, "max_distance"),
                                   within_reach(radius, kWidest_m, "radius"));
          },
          py::arg("from_W"), py::arg("direction"), py::arg("max_distance"), py::arg("radius"))
      .def(
          "occupied_in",
          [](const Self& self, const Object& box) { return rows(self.ask().occupied_in(self.map(), read_box(box))); },
          py::arg("box"))
      .def(
          "octomap_bytes",
          [](const Self& self, int rays) { return py::bytes(self.ask().octomap_bytes(self.map(), rays_of(rays))); },
          py::arg("rays") = 3);
}

void register_world_map(py::module_& module) {
  using Self = PythonWorldMap;
  using Object = py::object;
  py::class_<Self>(module, "WorldMap")
      .def_property_readonly("cell_m", [](const Self& self) { return self.ask().cell_m(self.map()); })
      .def(
          "at",
          [](const Self& self, const Object& p_W) {
            const WorldMap& map = self.map();
            return at_each<std::uint8_t>(
                p_W, [&](const Vector3d& p) { return static_cast<std::uint8_t>(self.ask().at(map, p)); });
          },
          py::arg("p_W"))
      .def(
          "structure_distance_m",
          [](const Self& self, const Object& p_W) {
            const WorldMap& map = self.map();
            return at_each<double>(p_W, [&](const Vector3d& p) { return self.ask().structure_distance_m(map, p); });
          },
          py::arg("p_W"))
      .def(
          "tube_free",
          [](const Self& self, const Object& a_W, const Object& b_W, double radius_m) {
            const Segment way(a_W, b_W);
            return self.ask().tube_free(self.map(), way.a_W, way.b_W, within_reach(radius_m, kWidest_m, "radius_m"));
          },
          py::arg("a_W"), py::arg("b_W"), py::arg("radius_m"))
      .def(
          "ball_free",
          [](const Self& self, const Object& p_W, double radius_m, double lowest_m) {
            if (!(std::abs(lowest_m) <= kFarthest_m)) refuse("lowest_m", "a finite number within 100 km");
            return self.ask().ball_free(self.map(), place_of(p_W, "p_W"), within_reach(radius_m, kWidest_m, "radius_m"),
                                        lowest_m);
          },
          py::arg("p_W"), py::arg("radius_m"), py::arg("lowest_m"))
      .def(
          "clear_way_m",
          [](const Self& self, const Object& from_W, const Object& direction, double reach_m) {
            return self.ask().clear_way_m(self.map(), place_of(from_W, "from_W"), direction_of(direction),
                                          within_reach(reach_m, kLongest_m, "reach_m"));
          },
          py::arg("from_W"), py::arg("direction"), py::arg("reach_m"))
      .def("window", &window_of, py::arg("lowest_W"), py::arg("cubes"))
      .def("regions", [](const Self& self) { return rows(self.ask().regions(self.map())); });
}

void register_free_space(py::module_& module) {
  using Self = PythonFreeSpace;
  using Object = py::object;
  py::class_<Self>(module, "FreeSpace")
      .def(
          "free",
          [](const Self& self, const Object& p_W) {
            const FreeSpace& space = self.map();
            return at_each<bool>(p_W, [&](const Vector3d& p) { return self.ask().free(space, p); });
          },
          py::arg("p_W"))
      .def(
          "segment_free",
          [](const Self& self, const Object& a_W, const Object& b_W) {
            const Segment way(a_W, b_W);
            return self.ask().segment_free(self.map(), way.a_W, way.b_W);
          },
          py::arg("a_W"), py::arg("b_W"))
      .def(
          "cost",
          [](const Self& self, const Object& p_W) {
            const FreeSpace& space = self.map();
            return at_each<double>(p_W, [&](const Vector3d& p) { return self.ask().cost(space, p); });
          },
          py::arg("p_W"))
      .def(
          "sees",
          [](const Self& self, const Object& a_W, const Object& b_W, double radius) {
            const Segment way(a_W, b_W);
            return self.ask().sees(self.map(), way.a_W, way.b_W, within_reach(radius, kWidest_m, "radius"));
          },
          py::arg("a_W"), py::arg("b_W"), py::arg("radius"));
}

}  // namespace

void register_maps(py::module_& module) {
  register_occupancy_map(module);
  register_world_map(module);
  register_free_space(module);
}

py::object occupancy_map_of(const std::shared_ptr<Call>& call) { return py::cast(PythonOccupancyMap{{call}}); }

py::object world_map_of(const std::shared_ptr<Call>& call) {
  if (call->in("inputs.world_map").world_map == nullptr) return py::none();
  return py::cast(PythonWorldMap{{call}});
}

py::object free_space_of(const std::shared_ptr<Call>& call) {
  if (call->in("inputs.space").space == nullptr) return py::none();
  return py::cast(PythonFreeSpace{{call}});
}

}  // namespace skein::agent::python
