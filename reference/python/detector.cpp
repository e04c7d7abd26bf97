#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/types/check.h"
#include "core/types/mesh_edges.h"
#include "reference/adapters/register.h"
#include "reference/oracle/floating_point.h"
#include "reference/python/arrays.h"
#include "reference/python/judge.h"
#include "reference/results/results_json.h"
#include "reference/text/counted.h"

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
      start_ = end_ = {};
      edges_.clear();
      for (const Body& body : bodies_)
        edges_.push_back(answers_steps() ? mesh_edges(body.shape->mesh.triangles) : MeshEdges());
    });
  }

  void forget_frame() {
    guarded([&] {
      if (state_ > State::kPrepared) state_ = State::kPrepared;
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
      take(positions, "positions", start_);
      start_.frame.time = time;
      made().update(start_.frame);
      ++start_.frame.index;
      state_ = State::kUpdated;
    });
    keep_spare(std::move(positions));
  }

  void update_step(std::vector<std::vector<Vec3>> start, std::vector<std::vector<Vec3>> end,
                   double start_time, double end_time) {
    guarded([&] {
      require(State::kPrepared, "prepare() comes before update_step()");
      if (!answers_steps())
        throw InputError(spec_.name + " does not answer about steps between two frames");
      if (!(start_time < end_time))
        throw InputError("the end of a step comes after its start: start_time=" +
                         std::to_string(start_time) + ", end_time=" + std::to_string(end_time));
      take(start, "start", start_);
      take(end, "end", end_);
      start_.frame.time = start_time;
      end_.frame.time = end_time;
      end_.frame.index = start_.frame.index + 1;
      made().update_step({start_.frame, end_.frame});
      ++start_.frame.index;
      state_ = State::kStepped;
    });
    keep_spare(std::move(start));
  }

  void query(const std::string& name, ContactSet& out) {
    guarded([&] {
      const Question question = question_named(name);
      const bool of_step = is_of_steps(question);
      require(State::kPrepared,
              of_step ? "update_step() comes before query()" : "update() comes before query()");
      if (state_ != (of_step ? State::kStepped : State::kUpdated))
        throw InputError("the question \"" + name + "\" is about a " +
                         (of_step ? "step: update_step()" : "frame: update()") +
                         " comes before query()");
      if (!made().semantics().answers(question))
        throw InputError(spec_.name + " does not answer the question \"" + name + "\"");
      out.clear();
      made().query(question, out);
      out.canonicalize();
      number_vertices(out);
    });
  }

  /// The ends of an edge, in the order of their numbers in the mesh as it was given.
  std::array<std::uint32_t, 2> ends_of(std::uint32_t body, std::uint32_t edge) const {
    const auto& [a, b] = edges_[body].edges[edge];
    const GivenVertices& given = bodies_[body].shape->given;
    return {given.number_of(a), given.number_of(b)};
  }

  std::vector<std::string> notes() {
    return guarded([&] { return detector_ ? detector_->notes() : std::vector<std::string>(); });
  }

 private:
  enum class State { kNone, kPrepared, kUpdated, kStepped };

  /// A frame that is held until the next one comes in its place.
  struct Held {
    std::vector<std::vector<Vec3>> nodes, vertices;
    Frame frame;
  };

  bool answers_steps() {
    const Semantics semantics = made().semantics();
    return std::any_of(semantics.questions.begin(), semantics.questions.end(), is_of_steps);
  }

  /// Leaves in `positions` those that were held before. `name`: of the argument.
  void take(std::vector<std::vector<Vec3>>& positions, const std::string& name, Held& held) {
    if (positions.size() != bodies_.size())
      throw InputError(name + ": " + text::counted(positions.size(), "array") + " for " +
                       text::counted(bodies_.size(), "body", "bodies"));
    held.nodes.resize(bodies_.size());
    held.vertices.resize(bodies_.size());
    held.frame.bodies.resize(bodies_.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const BodyShape& shape = *bodies_[i].shape;
      const std::size_t wanted = shape.lattice ? shape.node_count() : shape.given_vertex_count();
      if (positions[i].size() != wanted)
        throw InputError(name + "[" + std::to_string(i) + "] has " +
                         std::to_string(positions[i].size()) + " rows; \"" + bodies_[i].name +
                         "\" has " + std::to_string(wanted) +
                         (shape.lattice ? " nodes" : " vertices"));
      if (!shape.lattice) positions[i] = shape.given.kept(std::move(positions[i]));
    }
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const BodyShape& shape = *bodies_[i].shape;
      std::swap(held.nodes[i], positions[i]);
      held.frame.bodies[i] = {held.nodes[i], {}};
      if (!made().needs_vertices()) continue;
      if (shape.lattice) {
        held.vertices[i].resize(shape.mesh.vertices.size());
        map_body(shape, held.nodes[i], held.vertices[i]);
      }
      held.frame.bodies[i].vertices = shape.lattice ? held.vertices[i] : held.nodes[i];
    }
  }

  void keep_spare(std::vector<std::vector<Vec3>> positions) {
    const std::lock_guard lock(spare_mutex_);
    spare_ = std::move(positions);
  }

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
    for (NearPair& p : out.impact_vertices) number(p.body, p.vertex);
    for (NearPair& p : out.self_impact_vertices) number(p.body, p.vertex);
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
  std::vector<MeshEdges> edges_;        // per body, of a detector that answers about steps
  Held start_, end_;                    // the frame, or both ends of the step
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
py::dict lists_of(const ContactSet& found, const PyDetector& detector) {
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
  const auto edges = [&](const Quad& row) {
    const auto first = detector.ends_of(row[0], row[2]), second = detector.ends_of(row[1], row[3]);
    return std::array{row[0], row[1], first[0], first[1], second[0], second[1]};
  };
  out["impacts"] = table<std::int32_t, 2>(found.impacts, [](const BodyImpact& i) {
    return std::array{i.bodies.a, i.bodies.b};
  });
  out["impact_times"] =
      column<double>(found.impacts, [](const BodyImpact& i) { return i.time.value_or(-1.0); });
  out["impact_triangles"] =
      table<std::int32_t, 4>(rows_of(found.impact_triangles, std::vector<SelfPair>()), same);
  out["impact_vertices"] =
      table<std::int32_t, 4>(rows_of(found.impact_vertices, found.self_impact_vertices), same);
  out["impact_edges"] =
      table<std::int32_t, 6>(rows_of(found.impact_edges, found.self_impact_edges), edges);
  return out;
}

// A frame that is refused, even while it is read, leaves none to ask about.
std::vector<std::vector<Vec3>> read_positions(PyDetector& detector, const py::tuple& positions,
                                              const std::string& name) {
  {
    const py::gil_scoped_release released;
    detector.forget_frame();
  }
  std::vector<std::vector<Vec3>> arrays = detector.spare();
  arrays.resize(positions.size());
  for (std::size_t i = 0; i < arrays.size(); ++i)
    read_points(positions[i], name + "[" + std::to_string(i) + "]", arrays[i]);
  return arrays;
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
             auto arrays = read_positions(self, positions, "positions");
             const py::gil_scoped_release released;
             self.update(std::move(arrays), time);
           })
      .def("update_step",
           [](PyDetector& self, const py::tuple& start, const py::tuple& end, double start_time,
              double end_time) {
             auto first = read_positions(self, start, "start");
             auto last = read_positions(self, end, "end");
             const py::gil_scoped_release released;
             self.update_step(std::move(first), std::move(last), start_time, end_time);
           })
      .def("query",
           [](PyDetector& self, const std::string& question) {
             thread_local ContactSet found;  // for its memory
             {
               const py::gil_scoped_release released;
               self.query(question, found);
             }
             return lists_of(found, self);
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
