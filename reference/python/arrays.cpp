#include "reference/python/arrays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/types/check.h"

namespace contactcheck::python {
namespace {

constexpr py::ssize_t kMostRows = std::numeric_limits<std::int32_t>::max();

py::array array_of(const py::object& object, const std::string& name, const char* kinds,
                   const std::string& wanted) {
  py::array out;
  try {
    out = py::module_::import("numpy").attr("asarray")(object);
  } catch (const py::error_already_set& error) {
    // Others, such as of memory, are the caller's to see.
    if (!error.matches(PyExc_TypeError) && !error.matches(PyExc_ValueError)) throw;
    throw InputError(name + ": " + wanted + " wanted, got an object of type " +
                     py::str(py::type::of(object).attr("__name__")).cast<std::string>());
  }
  const std::string allowed = kinds;
  if (allowed.find(out.dtype().kind()) == std::string::npos || out.dtype().itemsize() > 8)
    throw InputError(name + ": " + wanted + " wanted, got dtype " +
                     py::str(out.dtype()).cast<std::string>());
  return out;
}

std::string shape_of(const py::array& array) {
  return py::str(array.attr("shape")).cast<std::string>();
}

void check_shape(const py::array& array, const std::string& name, const char* wanted) {
  if (array.ndim() != 2 || array.shape(1) != 3)
    throw InputError(name + " has shape " + shape_of(array) + "; it must be " + wanted);
  if (array.shape(0) > kMostRows)
    throw InputError(name + " has " + std::to_string(array.shape(0)) + " rows; at most " +
                     std::to_string(kMostRows) + " can be judged");
}

std::string place(const std::string& name, std::size_t row, std::size_t column) {
  return name + "[" + std::to_string(row) + ", " + std::to_string(column) + "]";
}

// In C order and native; the array itself where it is so.
template <typename Number>
using Plain = py::array_t<Number, py::array::c_style | py::array::forcecast>;

template <typename Index>
std::vector<Triangle> read_indices(const py::array& array, const std::string& name,
                                   std::size_t vertices, bool any_value) {
  const Plain<Index> indices(array);
  const Index* from = indices.data();
  std::vector<Triangle> out(static_cast<std::size_t>(indices.shape(0)));
  for (std::size_t t = 0; t < out.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k, ++from) {
      // A negative number is a very large one here.
      const bool known = static_cast<std::make_unsigned_t<Index>>(*from) < vertices;
      if (!known && !any_value)
        throw InputError(place(name, t, k) + " is " + std::to_string(*from) + "; the mesh has " +
                         std::to_string(vertices) + " vertices, counted from 0");
      out[t][k] = known ? static_cast<std::uint32_t>(*from) : ~0u;
    }
  return out;
}

// Beyond 2^53 a double rounds them. Compared as the whole numbers that they are: as a double 2^53 +
// 1 is 2^53, and as a signed number the largest unsigned one is -1.
template <typename Number>
void check_whole_numbers(const py::array& array, const std::string& name) {
  constexpr Number kLargest = Number{1} << 53;
  const Plain<Number> numbers(array);
  for (py::ssize_t i = 0; i < numbers.size(); ++i)
    if (numbers.data()[i] > kLargest ||
        (std::is_signed_v<Number> && numbers.data()[i] < Number{0} - kLargest))
      throw InputError(
          place(name, static_cast<std::size_t>(i) / 3, static_cast<std::size_t>(i) % 3) + " is " +
          std::to_string(numbers.data()[i]) + "; a double would round it");
}

// 3, a, b, c, 3, d, e, f, ...: what VTK and pyvista call faces.
py::array without_counts(const py::array& row, const std::string& name) {
  if (row.shape(0) % 4 == 0) {
    const py::array rows = row.attr("reshape")(-1, 4);
    const py::object counts = rows[py::make_tuple(py::ellipsis(), 0)];
    if (counts.attr("__eq__")(3).attr("all")().cast<bool>())
      return rows[py::make_tuple(py::ellipsis(), py::slice(1, 4, 1))];
  }
  throw InputError(name + " has shape " + shape_of(row) +
                   "; it must be (m, 3), or one row of 3, a, b, c for every triangle");
}

}  // namespace

void read_points(const py::object& object, const std::string& name, std::vector<Vec3>& out,
                 bool any_value) {
  const py::array given = array_of(object, name, "fiu", "an (n, 3) array of numbers");
  check_shape(given, name, "(n, 3)");
  if (given.dtype().kind() == 'i' && given.dtype().itemsize() == 8)
    check_whole_numbers<std::int64_t>(given, name);
  if (given.dtype().kind() == 'u' && given.dtype().itemsize() == 8)
    check_whole_numbers<std::uint64_t>(given, name);
  const Plain<double> doubles(given);
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  const double* from = doubles.data();
  const auto count = static_cast<std::size_t>(doubles.size());
  out.resize(count / 3);
  std::copy_n(from, count, out.empty() ? nullptr : out.front().data());
  // 0 times NaN or infinity is NaN; Eigen makes SIMD of it.
  const bool finite = (Eigen::Map<const Eigen::ArrayXd>(from, doubles.size()) * 0.0).sum() == 0.0;
  for (std::size_t i = 0; !finite && !any_value && i < count; ++i)
    if (!std::isfinite(from[i]))
      throw InputError(place(name, i / 3, i % 3) + " is " +
                       py::str(py::float_(from[i])).cast<std::string>() +
                       "; coordinates must be finite numbers");
}

std::vector<Vec3> read_points(const py::object& object, const std::string& name, bool any_value) {
  std::vector<Vec3> out;
  read_points(object, name, out, any_value);
  return out;
}

std::vector<Triangle> read_triangles(const py::object& object, const std::string& name,
                                     std::size_t vertices, bool any_value) {
  py::array given = array_of(object, name, "iu", "an (m, 3) array of integers");
  if (given.ndim() == 1 && given.shape(0) > 0) given = without_counts(given, name);
  check_shape(given, name, "(m, 3)");
  if (py::isinstance<py::array_t<std::int32_t>>(given))
    return read_indices<std::int32_t>(given, name, vertices, any_value);
  if (py::isinstance<py::array_t<std::uint64_t>>(given))
    return read_indices<std::uint64_t>(given, name, vertices, any_value);
  return read_indices<std::int64_t>(given, name, vertices, any_value);
}

py::array_t<double> points_table(const std::vector<Vec3>& points) {
  return table<double, 3>(points, [](const Vec3& p) { return std::array{p[0], p[1], p[2]}; });
}

}  // namespace contactcheck::python
