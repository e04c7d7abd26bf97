#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "core/deform/body.h"
#include "core/types/check.h"
#include "core/types/contact_set.h"
#include "core/types/semantics.h"
#include "reference/plugin/contactcheck_plugin.h"
#include "reference/plugin/declaration.h"
#include "reference/plugin/library_object.h"
#include "reference/plugin/library_trace.h"
#include "reference/plugin/plugin_library.h"
#include "reference/plugin/step_answer.h"

namespace contactcheck::plugin {
namespace {

// What is passed without a copy must lie in memory as the header says.
static_assert(sizeof(Vec3) == 3 * sizeof(double));
static_assert(sizeof(Triangle) == 3 * sizeof(std::uint32_t));
static_assert(sizeof(CornerIds) == 8 * sizeof(std::uint32_t));
static_assert(std::is_same_v<std::uint32_t, decltype(ElementPair::a)>);

template <typename Ids>
const std::uint32_t* flat(const std::vector<Ids>& ids) {
  return ids.empty() ? nullptr : ids.front().data();
}

constexpr std::size_t kLongestMeaning = 200;  // bytes

// The host's side of contactcheck_answer. No exception may pass through the plug-in's frames, but
// for the end of memory, which ends the worker there as anywhere else.
ContactSet& answer_of(void* host) { return *static_cast<ContactSet*>(host); }

ElementPair pair_of(const contactcheck_element_pair& p) { return {p.body_a, p.body_b, p.a, p.b}; }
VertexInBody vertex_of(const contactcheck_vertex_in_body& v) { return {v.body, v.in, v.vertex}; }

template <typename From, typename To, typename Convert>
void append(const From* items, std::size_t count, std::vector<To>& out, Convert&& convert) {
  for (std::size_t i = 0; i < count; ++i) out.push_back(convert(items[i]));
}

void add_bodies(void* host, const contactcheck_body_pair* items, std::size_t count) noexcept {
  append(items, count, answer_of(host).bodies, [](const contactcheck_body_pair& p) {
    return BodyPair{p.a, p.b};
  });
}
void add_triangles(void* host, const contactcheck_element_pair* items, std::size_t count) noexcept {
  append(items, count, answer_of(host).triangles, pair_of);
}
void add_cells(void* host, const contactcheck_element_pair* items, std::size_t count) noexcept {
  append(items, count, answer_of(host).cells, pair_of);
}
void add_vertices(void* host, const contactcheck_vertex_in_body* items,
                  std::size_t count) noexcept {
  append(items, count, answer_of(host).vertices, vertex_of);
}
void add_near(void* host, const contactcheck_near_pair* items, std::size_t count) noexcept {
  append(items, count, answer_of(host).near, [](const contactcheck_near_pair& p) {
    return NearPair{p.body, p.other, p.vertex, p.triangle};
  });
}
void add_pieces(void* host, const contactcheck_piece_contact* items, std::size_t count) noexcept {
  append(items, count, answer_of(host).piece_contacts, [](const contactcheck_piece_contact& c) {
    return PieceContact{pair_of(c.pieces), c.depth, {c.normal[0], c.normal[1], c.normal[2]}};
  });
}
void add_vertex_contacts(void* host, const contactcheck_vertex_contact* items,
                         std::size_t count) noexcept {
  append(items, count, answer_of(host).vertex_contacts, [](const contactcheck_vertex_contact& c) {
    return VertexContact{vertex_of(c.where), c.depth, {c.normal[0], c.normal[1], c.normal[2]}};
  });
}

// The host's side of contactcheck_step_answer. Items that do not say "contact" are none.
StepAnswer& step_of(void* host) { return *static_cast<StepAnswer*>(host); }

std::optional<double> time_of(const contactcheck_impact& impact) {
  return (impact.has & CONTACTCHECK_HAS_TIME) != 0 ? std::optional(impact.time) : std::nullopt;
}

template <typename Item, typename Take>
void each_contact(const Item* items, std::size_t count, Take&& take) {
  for (std::size_t i = 0; i < count; ++i)
    if (items[i].impact.contact != 0) take(items[i]);
}

// The time of a pair of elements is one at which their bodies meet.
void add_time(StepAnswer& out, std::uint32_t a, std::uint32_t b,
              const contactcheck_impact& impact) {
  if (const auto time = time_of(impact); time && a != b) out.bodies.push_back({{a, b}, time});
}

void add_body_impacts(void* host, const contactcheck_body_impact* items,
                      std::size_t count) noexcept {
  each_contact(items, count, [&](const contactcheck_body_impact& item) {
    step_of(host).bodies.push_back({{item.bodies.a, item.bodies.b}, time_of(item.impact)});
  });
}
void add_triangle_impacts(void* host, const contactcheck_triangle_impact* items,
                          std::size_t count) noexcept {
  each_contact(items, count, [&](const contactcheck_triangle_impact& item) {
    step_of(host).triangles.push_back(pair_of(item.triangles));
    add_time(step_of(host), item.triangles.body_a, item.triangles.body_b, item.impact);
  });
}
void add_vertex_impacts(void* host, const contactcheck_vertex_face_impact* items,
                        std::size_t count) noexcept {
  each_contact(items, count, [&](const contactcheck_vertex_face_impact& item) {
    const contactcheck_near_pair& at = item.where;
    step_of(host).vertices.push_back({at.body, at.other, at.vertex, at.triangle});
    add_time(step_of(host), at.body, at.other, item.impact);
  });
}
void add_edge_impacts(void* host, const contactcheck_edge_edge_impact* items,
                      std::size_t count) noexcept {
  each_contact(items, count, [&](const contactcheck_edge_edge_impact& item) {
    step_of(host).edges.push_back(
        {item.body_a, item.body_b, {item.a[0], item.a[1]}, {item.b[0], item.b[1]}});
    add_time(step_of(host), item.body_a, item.body_b, item.impact);
  });
}

/// Numbers of points, one after the other.
const double* numbers(std::span<const Vec3> points) {
  return points.empty() ? nullptr : points.front().data();
}

/// A body as a plug-in sees it. Points into the body's shape, which it keeps.
class BodyView {
 public:
  explicit BodyView(const Body& from);
  BodyView(const BodyView&) = delete;
  BodyView& operator=(const BodyView&) = delete;

  const contactcheck_body& body() const { return body_; }

 private:
  Body from_;
  std::vector<Vec3> rest_nodes_;
  contactcheck_lattice lattice_ = {};
  contactcheck_body body_ = {};
};

BodyView::BodyView(const Body& from) : from_(from) {
  const TriangleMesh& mesh = from_.shape->mesh;
  body_.name = from_.name.c_str();
  body_.vertex_count = static_cast<std::uint32_t>(mesh.vertices.size());
  body_.triangle_count = static_cast<std::uint32_t>(mesh.triangles.size());
  body_.vertices = numbers(mesh.vertices);
  body_.triangles = flat(from_.shape->linked());
  if (!from_.shape->lattice) return;
  const Lattice& lattice = *from_.shape->lattice;
  const Embedding& embedding = from_.shape->embedding;
  rest_nodes_ = lattice.rest_nodes();
  lattice_.node_count = static_cast<std::uint32_t>(lattice.nodes.size());
  lattice_.cell_count = static_cast<std::uint32_t>(lattice.cells.size());
  lattice_.rest_nodes = numbers(rest_nodes_);
  lattice_.cell_nodes = flat(lattice.cell_nodes);
  lattice_.home_cell = embedding.home_cell.data();
  lattice_.local = numbers(embedding.local);
  lattice_.label_begin = embedding.label_begin.data();
  lattice_.label_cells = embedding.label_cells.data();
  body_.lattice = &lattice_;
}

/// As they are before a plug-in says anything.
contactcheck_semantics default_semantics() {
  contactcheck_semantics said = {};
  said.touching_counts = said.needs_vertices = 1;
  said.scale = 1.0;
  return said;
}

/// @throws InputError for what does not exist
Semantics semantics_of(const contactcheck_semantics& from) {
  Semantics s;
  s.levels = values_of(from.levels, kHeaderLevels, "levels");
  s.informative = values_of(from.informative, kHeaderLevels, "levels");
  if (from.question_count > std::size(from.questions))
    throw InputError("declares too many questions");
  for (std::uint32_t i = 0; i < from.question_count; ++i)
    s.questions.push_back(value_of(from.questions[i], kHeaderQuestions, "question"));
  s.solid = from.solid != 0;
  s.closed = from.touching_counts != 0;
  s.exact = from.exact != 0;
  s.margin = from.margin;
  s.precision = value_of(from.precision, kHeaderPrecisions, "precision");
  s.scale = from.scale;
  s.depth = value_of(from.depth_kind, kHeaderDepthKinds, "kind of depth");
  s.whole_cells = from.whole_cells != 0;
  if (from.means != nullptr) s.means = std::string(from.means).substr(0, kLongestMeaning);
  return s;
}

std::uint32_t number_of(Question question) {
  for (std::uint32_t i = 0; i < std::size(kHeaderQuestions); ++i)
    if (kHeaderQuestions[i] == question) return i;
  return CONTACTCHECK_ASK_TRIANGLES;
}

/// Functions that append to `out`.
contactcheck_answer answer_into(ContactSet& out) {
  return {&out,         add_bodies, add_triangles, add_cells,
          add_vertices, add_near,   add_pieces,    add_vertex_contacts};
}

class LibraryDetector : public Detector {
 public:
  LibraryDetector(const PluginLibrary& library, const Options& options)
      : object_(library, options) {
    semantics_ = declared();
  }

  const Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override { return needs_vertices_; }

  void prepare(const std::vector<Body>& bodies) override {
    views_.clear();
    for (const Body& body : bodies) views_.push_back(std::make_unique<BodyView>(body));
    bodies_.clear();
    for (const auto& view : views_) bodies_.push_back(view->body());
    states_.resize(bodies.size());
    stages_ = {};
    counts_ = {};
    ends_.resize(bodies.size());
    step_reader_.prepare(bodies);
    object_.call("prepare", table().prepare, bodies_.data(), count(bodies_));
    declare_again();
  }

  void update(const Frame& frame) override {
    CONTACTCHECK_INVARIANT(frame.bodies.size() == states_.size(), "one state per prepared body");
    point_to(frame, states_);
    const contactcheck_frame own = {frame.index, frame.time, count(states_), 0, states_.data()};
    object_.call("update", table().update, &own);
  }

  // Its one function for steps does all: the query calls it.
  void update_step(const Step& step) override {
    CONTACTCHECK_INVARIANT(
        step.start.bodies.size() == states_.size() && step.end.bodies.size() == states_.size(),
        "one state per prepared body at both ends");
    point_to(step.start, states_);
    point_to(step.end, ends_);
    step_ = {step.index(),   step.start.time, step.end.time, count(states_), 0,
             states_.data(), ends_.data()};
  }

  void query(Question question, ContactSet& out) override {
    if (is_of_steps(question)) {
      StepAnswer found;
      const contactcheck_step_answer sink = {&found, add_body_impacts, add_triangle_impacts,
                                             add_vertex_impacts, add_edge_impacts};
      object_.call("step", table().step, &step_, &sink);
      step_reader_.read(object_.name(), found, out);
      return;
    }
    const contactcheck_answer answer = answer_into(out);
    object_.call("query", table().query, number_of(question), &answer);
    if (question == Question::kSelf) read_self_answer(object_.name(), out);
  }

  StageTrace trace() override {
    if (table().trace == nullptr) return {};
    const contactcheck_trace sink = stages_.sink();
    object_.call("trace", table().trace, &sink);
    return stages_.checked(bodies_);
  }

  std::vector<Count> counts() override {
    if (table().counts == nullptr) return {};
    const contactcheck_counts sink = counts_.sink();
    object_.call("counts", table().counts, &sink);
    return counts_.checked();
  }

  std::optional<double> reported_ns() const override {
    if (table().own_ms == nullptr) return std::nullopt;
    return reported_ns_of(table().own_ms(object_.get()));
  }

 private:
  const contactcheck_plugin& table() const { return object_.table(); }

  template <typename Items>
  static std::uint32_t count(const Items& items) {
    return static_cast<std::uint32_t>(items.size());
  }

  void point_to(const Frame& frame, std::vector<contactcheck_body_state>& states) const {
    for (std::size_t b = 0; b < states.size(); ++b)
      states[b] = {numbers(frame.bodies[b].nodes),
                   needs_vertices_ ? numbers(frame.bodies[b].vertices) : nullptr};
  }

  // Frames and steps are claimed apart; one that answers steps alone has vertices and is of
  // doubles.
  Semantics declared() {
    try {
      Semantics s;
      if (table().declare != nullptr) {
        contactcheck_semantics said = default_semantics();
        object_.call("declare", table().declare, &said);
        s = semantics_of(said);
        needs_vertices_ = said.needs_vertices != 0;
      }
      if (table().declare_impacts != nullptr) add_steps(s);
      if (table().declare == nullptr && s.levels.empty()) return s;  // it answers queries alone
      const std::string fault = semantics_fault(s);
      if (!fault.empty()) throw InputError("declares what does not fit together: " + fault);
      return s;
    } catch (const InputError& e) {
      throw InputError(object_.name() + " " + e.what());
    }
  }

  void add_steps(Semantics& s) {
    contactcheck_impact_semantics said = {};
    object_.call("declare_impacts", table().declare_impacts, &said);
    const std::vector<Level> levels =
        values_of(said.levels, kHeaderImpacts, "levels within a step");
    if (levels.empty()) return;
    if (table().step == nullptr || table().prepare == nullptr)
      throw InputError("declares levels within a step and has no function prepare or step");
    s.levels.insert(s.levels.end(), levels.begin(), levels.end());
    s.tolerance = {said.tolerance, said.tolerance_of_start};
    if (table().declare == nullptr)
      s.precision = value_of(said.precision, kHeaderPrecisions, "precision");
    const auto own = std::count_if(levels.begin(), levels.end(), is_self_impact);
    if (own < static_cast<std::ptrdiff_t>(levels.size())) s.questions.push_back(Question::kImpacts);
    if (own > 0) s.questions.push_back(Question::kSelfImpacts);
  }

  void declare_again() {
    const Semantics before = semantics_;
    const bool needed_vertices = needs_vertices_;
    semantics_ = declared();
    require_same_claims(object_.name(), before, semantics_);
    if (needed_vertices != needs_vertices_) refuse_change(object_.name(), "needs_vertices");
  }

  Semantics semantics_;
  bool needs_vertices_ = true;
  std::vector<std::unique_ptr<BodyView>> views_;  ///< what bodies_ point into
  std::vector<contactcheck_body> bodies_;
  std::vector<contactcheck_body_state> states_, ends_;  ///< of a frame; at both ends of a step
  contactcheck_step step_ = {};
  StepAnswerReader step_reader_;
  TraceCollector stages_;
  CountsCollector counts_;
  LibraryObject object_;  ///< last, so that it goes first: destroy() may still read the bodies
};

}  // namespace

std::unique_ptr<Detector> make_library_detector(const PluginLibrary& library,
                                                const Options& options) {
  return std::make_unique<LibraryDetector>(library, options);
}

}  // namespace contactcheck::plugin
