#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/types/check.h"
#include "reference/adapters/register.h"
#include "reference/oracle/floating_point.h"
#include "reference/python/arrays.h"
#include "reference/python/judge.h"
#include "reference/results/results_json.h"

namespace contactcheck::python {
namespace {

const DetectorCatalog& catalog() {
  static const DetectorCatalog standard = adapters::standard_catalog();
  return standard;
}

Question question_named(const std::string& name) {
  std::string known;
  for (const Question question : kQuestions) {
    if (name == name_of(question)) return question;
    known += (known.empty() ? "\"" : ", \"") + std::string(name_of(question)) + "\"";
  }
  throw InputError("no question is called \"" + name + "\"; there are " + known);
}

// One detector on one scene after another. One call at a time: the lock of Python is not held.
class PyDetector {
  // A detector that has thrown is only destroyed; bad arguments never reach it.
  template <typename Call>
  auto guarded(Call&& call) {
    const std::lock_guard lock(mutex_);
    const oracle::FloatingPointGuard guard;  // also of what the detector leaves behind
    try {
      return call();
    } catch (const InputError&) {
      throw;
    } catch (...) {
      detector_.reset();
      state_ = State::kNone;
      throw;
    }
  }

 public:
  explicit PyDetector(const std::string& name) : spec_(catalog().parse(name)) {
    const DetectorInfo& info = *catalog().find(spec_.id);
    if (!info.absent_because.empty()) throw Unavailable(spec_.id + ": " + info.absent_because);
    detector_ = catalog().make(spec_);
  }

  const std::string& name() const { return spec_.name; }

  std::string declares() {
    return guarded([&] {
      nlohmann::ordered_json out = results::to_json(made().semantics());
      out["needs_vertices"] = made().needs_vertices();
      return out.dump();
    });
  }

  // A new detector: each is prepared once.
  void prepare(const std::vector<std::pair<std::string, Shape>>& bodies,
               const std::vector<std::string>& questions) {
    guarded([&] {
      std::vector<Question> asked;
      for (const std::string& question : questions) asked.push_back(question_named(question));
      state_ = State::kNone;
      detector_.reset();  // before its bodies
      bodies_.clear();
      for (const auto& [name, shape] : bodies) bodies_.push_back({name, shape.body});
      detector_ = catalog().make(spec_);
      if (!asked.empty()) detector_->expect(asked);
      detector_->prepare(bodies_);
      state_ = State::kPrepared;
      nodes_.assign(bodies_.size(), {});
      vertices_.assign(bodies_.size(), {});
    });
  }

  /// A frame that is refused, even while it is read, leaves none to ask about.
  void forget_frame() {
    guarded([&] {
      if (state_ == State::kUpdated) state_ = State::kPrepared;
    });
  }

  /// Memory for the positions of the next frame: that of the frame before the last.
  std::vector<std::vector<Vec3>> spare() {
    const std::lock_guard lock(spare_mutex_);
    return std::exchange(spare_, {});
  }

  void update(std::vector<std::vector<Vec3>> positions, double time) {
    guarded([&] {
      require(State::kPrepared, "prepare() comes before update()");
      if (positions.size() != bodies_.size())
        throw InputError("positions: " + std::to_string(positions.size()) + " arrays for " +
                         std::to_string(bodies_.size()) + " bodies");
      frame_.bodies.resize(bodies_.size());
      for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const BodyShape& shape = *bodies_[i].shape;
        const std::size_t wanted = shape.lattice ? shape.node_count() : shape.given_vertex_count();
        if (positions[i].size() != wanted)
          throw InputError("positions[" + std::to_string(i) + "] has " +
                           std::to_string(positions[i].size()) + " rows; \"" + bodies_[i].name +
                           "\" has " + std::to_string(wanted) +
                           (shape.lattice ? " nodes" : " vertices"));
        if (!shape.lattice) positions[i] = shape.given.kept(std::move(positions[i]));
      }
      for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const BodyShape& shape = *bodies_[i].shape;
        std::swap(nodes_[i], positions[i]);
        frame_.bodies[i] = {nodes_[i], {}};
        if (!made().needs_vertices()) continue;
        if (shape.lattice) {
          vertices_[i].resize(shape.mesh.vertices.size());
          map_body(shape, nodes_[i], vertices_[i]);
        }
        frame_.bodies[i].vertices = shape.lattice ? vertices_[i] : nodes_[i];
      }
      frame_.time = time;
      made().update(frame_);
      ++frame_.index;
      state_ = State::kUpdated;
    });
    const std::lock_guard lock(spare_mutex_);
    spare_ = std::move(positions);
  }

  void query(const std::string& name, ContactSet& out) {
    guarded([&] {
      const Question question = question_named(name);
      if (is_of_steps(question))
        throw InputError("the question \"" + name +
                         "\" is about a step between two frames; run() asks it of scenes");
      require(State::kUpdated, "update() comes before query()");
      if (!made().semantics().answers(question))
        throw InputError(spec_.name + " does not answer the question \"" + name + "\"");
      out.clear();
      made().query(question, out);
      out.canonicalize();
      number_vertices(out);
    });
  }

  std::vector<std::string> notes() {
    return guarded([&] { return detector_ ? detector_->notes() : std::vector<std::string>(); });
  }

 private:
  enum class State { kNone, kPrepared, kUpdated };

  Detector& made() {
    if (!detector_) throw InputError(spec_.name + " failed before; prepare() begins anew");
    return *detector_;
  }

  // As the meshes were given.
  void number_vertices(ContactSet& out) const {
    const auto number = [&](std::uint32_t body, std::uint32_t& vertex) {
      vertex = bodies_[body].shape->given.number_of(vertex);
    };
    for (VertexInBody& v : out.vertices) number(v.body, v.vertex);
    for (NearPair& p : out.near) number(p.body, p.vertex);
    for (NearPair& p : out.self_near) number(p.body, p.vertex);
    for (VertexContact& c : out.vertex_contacts) number(c.where.body, c.where.vertex);
  }

  void require(State state, const char* order) {
    made();
    if (state_ < state) throw InputError(order);
  }

  std::mutex mutex_, spare_mutex_;
  std::vector<std::vector<Vec3>> spare_;
  DetectorSpec spec_;
  std::vector<Body> bodies_;
  std::vector<std::vector<Vec3>> nodes_, vertices_;
  Frame frame_;
  std::unique_ptr<Detector> detector_;  // destroyed before what it looks at
  State state_ = State::kNone;
};

using Quad = std::array<std::uint32_t, 4>;

Quad row_of(const ElementPair& p) { return {p.body_a, p.body_b, p.a, p.b}; }
Quad row_of(const SelfPair& p) { return {p.body, p.body, p.a, p.b}; }
Quad row_of(const NearPair& p) { return {p.body, p.other, p.vertex, p.triangle}; }

// Between bodies, and of bodies with themselves.
template <typename Pairs, typename Own>
std::vector<Quad> rows_of(const Pairs& pairs, const Own& own) {
  std::vector<Quad> out;
  out.reserve(pairs.size() + own.size());
  for (const auto& pair : pairs) out.push_back(row_of(pair));
  for (const auto& pair : own) out.push_back(row_of(pair));
  return out;
}

// The lists of the pipe's answer (reference/plugin/README.md), by the same names.
py::dict lists_of(const ContactSet& found) {
  std::vector<std::array<std::uint32_t, 2>> bodies;
  for (const BodyPair& p : found.bodies) bodies.push_back({p.a, p.b});
  for (const std::uint32_t body : found.self_bodies) bodies.push_back({body, body});
  const auto same = [](const auto& row) { return row; };
  const auto vertex = [](const VertexInBody& v) { return std::array{v.body, v.in, v.vertex}; };
  const auto depth = [](const auto& contact) { return contact.depth; };
  const auto normal = [](const auto& contact) {
    return std::array{contact.normal[0], contact.normal[1], contact.normal[2]};
  };
  py::dict out;
  out["bodies"] = table<std::int32_t, 2>(bodies, same);
  out["triangles"] = table<std::int32_t, 4>(rows_of(found.triangles, found.self), same);
  out["cells"] = table<std::int32_t, 4>(rows_of(found.cells, found.self_cells), same);
  out["vertices"] = table<std::int32_t, 3>(found.vertices, vertex);
  out["near"] = table<std::int32_t, 4>(rows_of(found.near, found.self_near), same);
  out["piece_contacts"] = table<std::int32_t, 4>(
      found.piece_contacts, [](const PieceContact& c) { return row_of(c.pieces); });
  out["piece_depths"] = column<double>(found.piece_contacts, depth);
  out["piece_normals"] = table<double, 3>(found.piece_contacts, normal);
  out["vertex_contacts"] = table<std::int32_t, 3>(
      found.vertex_contacts, [&](const VertexContact& c) { return vertex(c.where); });
  out["vertex_depths"] = column<double>(found.vertex_contacts, depth);
  out["vertex_normals"] = table<double, 3>(found.vertex_contacts, normal);
  return out;
}

}  // namespace

void add_detector(py::module_& module) {
  using Released = py::call_guard<py::gil_scoped_release>;
  py::class_<PyDetector>(module, "Detector")
      .def(py::init<const std::string&>(), Released())
      .def_property_readonly("name", &PyDetector::name)
      .def("declares", &PyDetector::declares, Released())
      .def("prepare", &PyDetector::prepare, Released())
      .def("update",
           [](PyDetector& self, const py::tuple& positions, double time) {
             {
               const py::gil_scoped_release released;
               self.forget_frame();
             }
             std::vector<std::vector<Vec3>> arrays = self.spare();
             arrays.resize(positions.size());
             for (std::size_t i = 0; i < arrays.size(); ++i)
               read_points(positions[i], "positions[" + std::to_string(i) + "]", arrays[i]);
             const py::gil_scoped_release released;
             self.update(std::move(arrays), time);
           })
      .def("query",
           [](PyDetector& self, const std::string& question) {
             thread_local ContactSet found;  // for its memory
             {
               const py::gil_scoped_release released;
               self.query(question, found);
             }
             return lists_of(found);
           })
      .def("notes", &PyDetector::notes, Released());
  module.def("detectors", [] {
    std::vector<std::string> out;
    for (const DetectorInfo& info : catalog().all())
      if (info.absent_because.empty()) out.push_back(info.id);
    return out;
  });
}

}  // namespace contactcheck::python
