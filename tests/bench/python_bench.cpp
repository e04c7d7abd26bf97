// What Python adds: the same calls in C++ and through the module, on the same arrays. Both sides
// begin with arrays and end with arrays, so the conversion is part of what Python takes.

#include <benchmark/benchmark.h>
#include <pybind11/embed.h>
#include <pybind11/numpy.h>

#include <string>
#include <vector>

#include "core/detect/registry.h"
#include "reference/oracle/oracle.h"
#include "tests/bench/bench_bodies.h"
#include "tests/bench/register.h"
#include "tests/support/shapes.h"

namespace contactcheck::bench {
namespace {

namespace py = pybind11;

constexpr int kFrames = 60;

py::module_ contactcheck_module() {
  static const py::scoped_interpreter interpreter;
  py::module_::import("sys").attr("path").attr("insert")(0, CONTACTCHECK_PYTHON_FOLDER);
  return py::module_::import("contactcheck");
}

template <typename To, typename From>
py::array_t<To> rows_of(const std::vector<From>& rows) {
  py::array_t<To> out({static_cast<py::ssize_t>(rows.size()), py::ssize_t{3}});
  To* to = out.mutable_data();
  for (const From& row : rows)
    for (int k = 0; k < 3; ++k) *to++ = static_cast<To>(row[static_cast<std::size_t>(k)]);
  return out;
}

std::vector<Vec3> moved(std::vector<Vec3> points, const Vec3& offset) {
  for (Vec3& p : points) p += offset;
  return points;
}

// Where the two touch.
Vec3 beside(const BodyShape& shape) {
  return {0.5 * bounding_box(shape.mesh.vertices).extent().x(), 0, 0};
}

void contacts_in_cpp(benchmark::State& state) {
  const TriangleMesh a = large_body().shape->mesh;
  TriangleMesh b = a;
  b.vertices = moved(b.vertices, beside(*large_body().shape));
  std::size_t pairs = 0;
  for (auto _ : state) {
    const std::vector<Body> bodies = {{"a", make_bare_shape(a)}, {"b", make_bare_shape(b)}};
    const test::FrameData data = test::make_frame(bodies, {a.vertices, b.vertices});
    pairs = oracle::Oracle(bodies).judge(data.frame(), {}).surface.triangles.size();
  }
  state.counters["triangle_pairs"] = static_cast<double>(pairs);
}

void contacts_in_python(benchmark::State& state) {
  const py::object contacts = contactcheck_module().attr("contacts");
  const TriangleMesh& mesh = large_body().shape->mesh;
  const py::object va = rows_of<double>(mesh.vertices), f = rows_of<std::int32_t>(mesh.triangles);
  const py::object vb = rows_of<double>(moved(mesh.vertices, beside(*large_body().shape)));
  std::size_t pairs = 0;
  for (auto _ : state) pairs = py::len(contacts(va, f, vb, f));
  state.counters["triangle_pairs"] = static_cast<double>(pairs);
}

// One body stays where the first frame has it, the other comes nearer until they touch.
std::vector<std::vector<Vec3>> positions(const BodyShape& shape) {
  const std::vector<Vec3> rest = shape.lattice ? shape.lattice->rest_nodes() : shape.mesh.vertices;
  std::vector<std::vector<Vec3>> out = {rest};
  for (int i = 1; i <= kFrames; ++i)
    out.push_back(moved(rest, beside(shape) * (1.5 - 0.5 * i / kFrames)));
  return out;
}

std::shared_ptr<const BodyShape> shape_of(bool in_lattice) {
  return in_lattice ? large_body().shape : make_bare_shape(large_body().shape->mesh);
}

void detector_in_cpp(benchmark::State& state, bool in_lattice) {
  const auto shape = shape_of(in_lattice);
  DetectorCatalog catalog;
  register_core_detectors(catalog);
  const auto detector = catalog.make(catalog.parse("ffd-lazy"));
  const std::vector<Body> bodies = {{"a", shape}, {"b", shape}};
  detector->expect({Question::kTriangles});
  detector->prepare(bodies);
  const auto frames = positions(*shape);
  ContactSet found;
  std::size_t pairs = 0;
  for (auto _ : state) {
    pairs = 0;
    for (int i = 1; i <= kFrames; ++i) {
      Frame frame;
      for (const std::vector<Vec3>* nodes : {&frames[0], &frames[static_cast<std::size_t>(i)]})
        frame.bodies.push_back({*nodes, shape->lattice ? std::span<const Vec3>() : *nodes});
      detector->update(frame);
      found.clear();
      detector->query(Question::kTriangles, found);
      found.canonicalize();
      pairs += found.triangles.size();
    }
  }
  state.counters["triangle_pairs"] = static_cast<double>(pairs);
}

void detector_in_python(benchmark::State& state, bool in_lattice) {
  const py::module_ module = contactcheck_module();
  const auto shape = shape_of(in_lattice);
  const py::object v = rows_of<double>(shape->mesh.vertices);
  const py::object f = rows_of<std::int32_t>(shape->mesh.triangles);
  const py::object body =
      in_lattice ? module.attr("Lattice")(v, f, py::make_tuple(6, 6, 6)) : py::make_tuple(v, f);
  const py::object detector = module.attr("Detector")("ffd-lazy");
  detector.attr("prepare")(py::make_tuple(body, body), py::make_tuple("triangles"));
  std::vector<py::object> frames;
  for (const auto& second : positions(*shape)) frames.push_back(rows_of<double>(second));
  if (in_lattice && py::len(body.attr("nodes")) != py::len(frames[0]))
    return state.SkipWithError("the module's lattice is another one");
  std::size_t pairs = 0;
  for (auto _ : state) {
    pairs = 0;
    for (int i = 1; i <= kFrames; ++i) {
      detector.attr("update")(py::make_tuple(frames[0], frames[static_cast<std::size_t>(i)]));
      pairs += py::len(py::dict(detector.attr("query")("triangles"))["triangles"]);
    }
  }
  state.counters["triangle_pairs"] = static_cast<double>(pairs);
}

}  // namespace

void register_python_benchmarks() {
  const auto add = [](const char* name, auto call) {
    benchmark::RegisterBenchmark(name, call)->Unit(benchmark::kMillisecond);
  };
  add("python/contacts/c++", &contacts_in_cpp);
  add("python/contacts/python", &contacts_in_python);
  for (const bool in_lattice : {true, false}) {
    const std::string name = in_lattice ? "python/60 frames, lattices/" : "python/60 frames, bare/";
    add((name + "c++").c_str(), [=](auto& state) { detector_in_cpp(state, in_lattice); });
    add((name + "python").c_str(), [=](auto& state) { detector_in_python(state, in_lattice); });
  }
}

}  // namespace contactcheck::bench
