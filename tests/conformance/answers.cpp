#include "tests/conformance/answers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <type_traits>

#include "core/types/mesh_edges.h"
#include "tests/conformance/detectors.h"

namespace contactcheck::test {
namespace {

// A unit normal in single precision is off by about 1e-7.
constexpr double kUnitTolerance = 1e-5;

auto key(const PieceContact& c) {
  return std::tuple(c.pieces, c.depth, c.normal.x(), c.normal.y(), c.normal.z());
}
auto key(const VertexContact& c) {
  return std::tuple(c.where, c.depth, c.normal.x(), c.normal.y(), c.normal.z());
}

// Several contacts of one pair may come in any order.
template <typename Contact>
bool same_contacts(std::vector<Contact> a, std::vector<Contact> b) {
  const auto before = [](const Contact& x, const Contact& y) { return key(x) < key(y); };
  std::sort(a.begin(), a.end(), before);
  std::sort(b.begin(), b.end(), before);
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Contact& x, const Contact& y) { return key(x) == key(y); });
}

bool same_ids(const BodyImpact& a, const BodyImpact& b) { return a.bodies == b.bodies; }
template <typename T>
bool same_ids(const T& a, const T& b) {
  return a == b;
}

// Of contacts with depths and of impacts with times: the rest of them is compared apart.
bool same_sets(const ContactSet& a, const ContactSet& b) {
  bool same = true;
  for_each_list(
      [&same](ContactList, const auto& x, const auto& y) {
        using Entry = typename std::decay_t<decltype(x)>::value_type;
        if constexpr (!std::is_same_v<Entry, PieceContact> && !std::is_same_v<Entry, VertexContact>)
          same = same && std::equal(x.begin(), x.end(), y.begin(), y.end(),
                                    [](const Entry& p, const Entry& q) { return same_ids(p, q); });
      },
      a, b);
  return same;
}

bool same_times(const ContactSet& a, const ContactSet& b) {
  return std::equal(a.impacts.begin(), a.impacts.end(), b.impacts.begin(), b.impacts.end(),
                    [](const BodyImpact& x, const BodyImpact& y) { return x.time == y.time; });
}

std::vector<ElementPair> pieces_of(const ContactSet& set) {
  std::vector<ElementPair> pieces;
  for (const PieceContact& c : set.piece_contacts) pieces.push_back(c.pieces);
  return pieces;
}

std::vector<VertexInBody> vertices_of(const ContactSet& set) {
  std::vector<VertexInBody> vertices;
  for (const VertexContact& c : set.vertex_contacts) vertices.push_back(c.where);
  return vertices;
}

// The set as it reads when body b is called last - b.
ContactSet renamed(ContactSet set, std::uint32_t last) {
  const auto rename = [last](std::uint32_t& body) { body = last - body; };
  const auto rename_pair = [&](ElementPair& p) { rename(p.body_a), rename(p.body_b); };
  for (BodyPair& p : set.bodies) rename(p.a), rename(p.b);
  for (BodyImpact& p : set.impacts) rename(p.bodies.a), rename(p.bodies.b);
  for (std::vector<ElementPair>* pairs :
       {&set.cells, &set.triangles, &set.impact_triangles, &set.impact_edges})
    for (ElementPair& p : *pairs) rename_pair(p);
  for (VertexInBody& v : set.vertices) rename(v.body), rename(v.in);
  for (std::vector<NearPair>* pairs :
       {&set.near, &set.self_near, &set.impact_vertices, &set.self_impact_vertices})
    for (NearPair& p : *pairs) rename(p.body), rename(p.other);
  for (std::vector<SelfPair>* pairs : {&set.self, &set.self_cells, &set.self_impact_edges})
    for (SelfPair& p : *pairs) rename(p.body);
  for (std::uint32_t& body : set.self_bodies) rename(body);
  for (PieceContact& c : set.piece_contacts) rename_pair(c.pieces);
  for (VertexContact& c : set.vertex_contacts) rename(c.where.body), rename(c.where.in);
  set.canonicalize();
  return set;
}

template <typename T>
void sort_unique(std::vector<T>& items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

bool mirrored_contacts(const ContactSet& a, const ContactSet& b) {
  auto pieces_a = pieces_of(a), pieces_b = pieces_of(b);
  auto vertices_a = vertices_of(a), vertices_b = vertices_of(b);
  sort_unique(pieces_a), sort_unique(pieces_b);
  sort_unique(vertices_a), sort_unique(vertices_b);
  return pieces_a == pieces_b && vertices_a == vertices_b;
}

// Counts what a set names and the scene lacks.
class IdCheck {
 public:
  explicit IdCheck(const std::vector<Body>& bodies) : bodies_(bodies) {}

  bool pair(std::uint32_t a, std::uint32_t b) {
    const bool good = a < bodies_.size() && b < bodies_.size() && a != b;
    bad_ += good ? 0 : 1;
    return good;
  }
  void cells(const ElementPair& p) {
    if (!pair(p.body_a, p.body_b)) return;
    bad_ += p.a >= cells_of(p.body_a) || p.b >= cells_of(p.body_b) ? 1 : 0;
  }
  void triangles(const ElementPair& p) {
    if (!pair(p.body_a, p.body_b)) return;
    bad_ += p.a >= triangles_of(p.body_a) || p.b >= triangles_of(p.body_b) ? 1 : 0;
  }
  void edges(const ElementPair& p) {
    if (!pair(p.body_a, p.body_b)) return;
    bad_ += p.a >= edges_of(p.body_a) || p.b >= edges_of(p.body_b) ? 1 : 0;
  }
  void vertex(const VertexInBody& v) {
    if (!pair(v.body, v.in)) return;
    bad_ += v.vertex >= bodies_[v.body].shape->mesh.vertices.size() ? 1 : 0;
  }
  void self(const SelfPair& p) { own(p, &IdCheck::triangles_of); }
  void self_cells(const SelfPair& p) { own(p, &IdCheck::cells_of); }
  void self_edges(const SelfPair& p) { own(p, &IdCheck::edges_of); }
  void self_near(const NearPair& p) {
    const bool good = p.body < bodies_.size() && p.other == p.body &&
                      p.vertex < bodies_[p.body].shape->mesh.vertices.size() &&
                      p.triangle < triangles_of(p.body);
    bad_ += good ? 0 : 1;
  }
  void near(const NearPair& p) {
    vertex({p.body, p.other, p.vertex});
    if (p.other < bodies_.size()) bad_ += p.triangle >= triangles_of(p.other) ? 1 : 0;
  }
  std::uint64_t bad() const { return bad_; }

 private:
  void own(const SelfPair& p, std::size_t (IdCheck::*count_of)(std::uint32_t) const) {
    const bool good = p.body < bodies_.size() && p.a < (this->*count_of)(p.body) &&
                      p.b < (this->*count_of)(p.body) && p.a != p.b;
    bad_ += good ? 0 : 1;
  }
  std::size_t triangles_of(std::uint32_t body) const {
    return bodies_[body].shape->mesh.triangles.size();
  }
  std::size_t cells_of(std::uint32_t body) const {
    const auto& lattice = bodies_[body].shape->lattice;
    return lattice ? lattice->cells.size() : 0;
  }

  std::size_t edges_of(std::uint32_t body) const {
    const auto [place, is_new] = edges_.try_emplace(body, 0);
    if (is_new) place->second = mesh_edges(bodies_[body].shape->mesh.triangles).edges.size();
    return place->second;
  }

  const std::vector<Body>& bodies_;
  mutable std::map<std::uint32_t, std::size_t> edges_;  // counted once per body
  std::uint64_t bad_ = 0;
};

bool usable(double depth, const Vec3& normal) {
  return std::isfinite(depth) && depth >= 0.0 && std::abs(normal.norm() - 1.0) <= kUnitTolerance;
}

template <typename T>
bool holds(const std::vector<T>& sorted, const T& item) {
  return std::binary_search(sorted.begin(), sorted.end(), item);
}

bool contacts_are_reported(const ContactSet& set) {
  for (const ElementPair& p : pieces_of(set))
    if (!holds(set.triangles, p) && !holds(set.cells, p)) return false;
  for (const VertexInBody& v : vertices_of(set))
    if (!holds(set.bodies, {std::min(v.body, v.in), std::max(v.body, v.in)})) return false;
  return true;
}

// A question about bodies alone may leave the elements out.
bool agree(const ContactSet& own, const ContactSet& other, Question question) {
  if (question == Question::kSelf)
    return other.bodies.empty() && other.triangles.empty() && other.cells.empty();
  if (own.bodies != other.bodies || !contacts_are_reported(other)) return false;
  return question == Question::kBody ||
         (own.triangles == other.triangles && own.cells == other.cells);
}

}  // namespace

Answers ask_again(Detector& detector, Moment of) {
  Answers answers;
  for (Question question : detector.semantics().questions) {
    if (!is_of(question, of)) continue;
    ContactSet& set = answers[question];
    detector.query(question, set);
    set.canonicalize();
  }
  return answers;
}

Answers ask(Detector& detector, const FrameData& data, std::size_t index) {
  Frame frame = data.frame(index);
  if (!detector.needs_vertices())
    for (BodyState& body : frame.bodies) body.vertices = {};
  detector.update(frame);
  return ask_again(detector);
}

Step step_of(const Case& scene, std::size_t index, const Detector& detector) {
  Step step = {scene.frames[index].frame(index), scene.frames[index + 1].frame(index + 1)};
  if (!detector.needs_vertices())
    for (Frame* end : {&step.start, &step.end})
      for (BodyState& body : end->bodies) body.vertices = {};
  return step;
}

Answers ask(Detector& detector, const Case& scene, Moment of, std::size_t index) {
  if (of == Moment::kFrame) return ask(detector, scene.frames[index], index);
  const Step step = step_of(scene, index, detector);
  detector.update_step(step);
  return ask_again(detector, of);
}

bool same(const Answers& a, const Answers& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.first == y.first && same_sets(x.second, y.second) && same_times(x.second, y.second) &&
           same_contacts(x.second.piece_contacts, y.second.piece_contacts) &&
           same_contacts(x.second.vertex_contacts, y.second.vertex_contacts);
  });
}

bool mirrored(const Answers& a, const Answers& b, std::size_t bodies) {
  const auto last = static_cast<std::uint32_t>(bodies - 1);
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](const auto& x, const auto& y) {
    const ContactSet other = renamed(y.second, last);
    return x.first == y.first && same_sets(x.second, other) && mirrored_contacts(x.second, other);
  });
}

std::string text(const Answers& answers) {
  std::string out;
  for (const auto& [question, set] : answers) {
    const auto add = [&](const char* kind, std::size_t count) {
      if (count > 0) out += std::string(" ") + std::to_string(count) + " " + kind;
    };
    out += (out.empty() ? "" : "; ") + std::string(name_of(question)) + ":";
    add("pairs of bodies", set.bodies.size());
    add("pairs of cells", set.cells.size());
    add("pairs of triangles", set.triangles.size());
    add("vertices", set.vertices.size());
    add("near pairs", set.near.size());
    add("pairs of one body's triangles", set.self.size());
    add("pairs of one body's cells", set.self_cells.size());
    add("near pairs of one body", set.self_near.size());
    add("bodies that touch themselves", set.self_bodies.size());
    add("impacts of bodies", set.impacts.size());
    add("impacts of triangles", set.impact_triangles.size());
    add("impacts of vertices", set.impact_vertices.size());
    add("impacts of edges", set.impact_edges.size());
    add("impacts of one body's vertices", set.self_impact_vertices.size());
    add("impacts of one body's edges", set.self_impact_edges.size());
    add("contacts of pieces", set.piece_contacts.size());
    add("contacts of vertices", set.vertex_contacts.size());
  }
  return out;
}

std::uint64_t invalid_ids(const ContactSet& set, const std::vector<Body>& bodies) {
  IdCheck check(bodies);
  for (const BodyPair& p : set.bodies) check.pair(p.a, p.b);
  for (const ElementPair& p : set.cells) check.cells(p);
  for (const ElementPair& p : set.triangles) check.triangles(p);
  for (const VertexInBody& v : set.vertices) check.vertex(v);
  for (const NearPair& p : set.near) check.near(p);
  for (const SelfPair& p : set.self) check.self(p);
  for (const SelfPair& p : set.self_cells) check.self_cells(p);
  for (const NearPair& p : set.self_near) check.self_near(p);
  for (const BodyImpact& p : set.impacts) check.pair(p.bodies.a, p.bodies.b);
  for (const ElementPair& p : set.impact_triangles) check.triangles(p);
  for (const NearPair& p : set.impact_vertices) check.near(p);
  for (const ElementPair& p : set.impact_edges) check.edges(p);
  for (const NearPair& p : set.self_impact_vertices) check.self_near(p);
  for (const SelfPair& p : set.self_impact_edges) check.self_edges(p);
  for (const ElementPair& p : pieces_of(set))
    holds(set.cells, p) ? check.cells(p) : check.triangles(p);
  for (const VertexInBody& v : vertices_of(set)) check.vertex(v);
  return check.bad();
}

std::uint64_t unusable_contacts(const ContactSet& set) {
  std::uint64_t bad = 0;
  for (const PieceContact& c : set.piece_contacts) bad += usable(c.depth, c.normal) ? 0 : 1;
  for (const VertexContact& c : set.vertex_contacts) bad += usable(c.depth, c.normal) ? 0 : 1;
  return bad;
}

std::uint64_t unusable_times(const ContactSet& set) {
  std::uint64_t bad = 0;
  for (const BodyImpact& impact : set.impacts)
    bad += !impact.time || (*impact.time >= 0.0 && *impact.time <= 1.0) ? 0 : 1;
  return bad;
}

std::uint64_t lists_of_other_questions(const ContactSet& set, Question question) {
  std::uint64_t bad = 0;
  for_each_list(
      [&](ContactList list, const auto& entries) {
        const bool own_impacts =
            list == ContactList::kSelfImpactVertices || list == ContactList::kSelfImpactEdges;
        const bool answers =
            is_of_step(list) == is_of_steps(question) &&
            (!is_of_step(list) || own_impacts == (question == Question::kSelfImpacts));
        bad += answers || entries.empty() ? 0 : 1;
      },
      set);
  return bad;
}

std::uint64_t contradictions(const Answers& answers, const Semantics& semantics) {
  const ContactSet& own = answers.at(semantics.questions.front());
  std::uint64_t count = 0;
  for (const auto& [question, set] : answers) count += agree(own, set, question) ? 0 : 1;
  return count;
}

}  // namespace contactcheck::test
