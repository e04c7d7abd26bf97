// Converts NumPy arrays to our types and back. Other input is refused with the caller's name for
// it, the place and the value.
#pragma once

#include <pybind11/numpy.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/types/mesh.h"
#include "core/types/vec3.h"

namespace contactcheck::python {

namespace py = pybind11;

/// (n, 3) numbers, read as doubles; float64 in C order is copied once. @throws InputError for other
/// shapes and types, for numbers that a double rounds, and for NaN and infinity unless `any_value`
std::vector<Vec3> read_points(const py::object& object, const std::string& name,
                              bool any_value = false);
/// The same, into a vector whose memory is reused.
void read_points(const py::object& object, const std::string& name, std::vector<Vec3>& out,
                 bool any_value = false);

/// (m, 3) indices of vertices, of any integer type; or as VTK has them, in one row: 3, a, b, c, ...
/// Indices out of range are refused, or with `any_value` become ~0. @throws InputError
std::vector<Triangle> read_triangles(const py::object& object, const std::string& name,
                                     std::size_t vertices, bool any_value = false);

/// A table of one row per item; `row` gives its N numbers.
template <typename T, std::size_t N, typename Items, typename Row>
py::array_t<T> table(const Items& items, Row&& row) {
  py::array_t<T> out({static_cast<py::ssize_t>(items.size()), static_cast<py::ssize_t>(N)});
  T* to = out.mutable_data();
  for (const auto& item : items)
    for (const auto value : row(item)) *to++ = static_cast<T>(value);
  return out;
}

/// A row of one number per item.
template <typename T, typename Items, typename Value>
py::array_t<T> column(const Items& items, Value&& value) {
  py::array_t<T> out(static_cast<py::ssize_t>(items.size()));
  T* to = out.mutable_data();
  for (const auto& item : items) *to++ = static_cast<T>(value(item));
  return out;
}

/// (n, 3)
py::array_t<double> points_table(const std::vector<Vec3>& points);

}  // namespace contactcheck::python
