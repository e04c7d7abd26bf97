#include "reference/oracle/step_truth.h"

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <utility>

#include "core/types/check.h"
#include "core/types/impact.h"
#include "core/types/mesh_edges.h"
#include "reference/oracle/elementary_impact.h"
#include "reference/oracle/floating_point.h"
#include "reference/oracle/oracle.h"
#include "reference/oracle/surface_tree.h"

namespace contactcheck::oracle {
namespace {

void add_once(std::vector<std::uint32_t>& list, std::uint32_t item) {
  if (list.empty() || list.back() != item) list.push_back(item);
}

template <typename Record>
void add_contact(std::vector<Record>& list, const Record& record) {
  if (list.size() == kMostContacts) refuse_many_contacts(kMostContacts);
  list.push_back(record);
}

/// The earlier of two certified intervals: that of the smaller of two times.
void take_earlier(FirstImpact& first, const Impact& impact) {
  first.earliest = std::min(first.earliest, impact.earliest);
  first.latest = std::min(first.latest, impact.latest);
}

}  // namespace

struct StepOracle::Impl {
  /// The elements of a mesh, and which triangles have them.
  struct Elements {
    explicit Elements(const BodyShape& shape);

    std::vector<Edge> edges;
    std::vector<std::array<std::uint32_t, 3>> of_triangle;  ///< edges; MeshEdges::kNone: no edge
    std::vector<std::vector<std::uint32_t>> at_vertex, at_edge;  ///< triangles, ascending
    std::vector<std::uint32_t> place;  ///< of each vertex: the first one welded to it, or itself
  };

  explicit Impl(const std::vector<Body>& bodies) {
    std::map<const BodyShape*, std::shared_ptr<const Elements>> made;
    for (const Body& body : bodies) {
      std::shared_ptr<const Elements>& of_shape = made[body.shape.get()];
      if (!of_shape) of_shape = std::make_shared<const Elements>(*body.shape);
      elements.push_back(of_shape);
      shapes.push_back(body.shape);
      trees.emplace_back(body.shape->mesh);
    }
  }

  std::span<const Vec3> start(std::uint32_t body) const {
    return step->start.bodies[body].vertices;
  }
  std::span<const Vec3> end(std::uint32_t body) const { return step->end.bodies[body].vertices; }

  template <typename Vertices>
  Aabb swept_box(std::uint32_t body, const Vertices& vertices) const {
    Aabb box;
    for (const std::uint32_t v : vertices) {
      box.extend(start(body)[v]);
      box.extend(end(body)[v]);
    }
    return box;
  }

  Impact ask(ImpactKind kind, const std::array<std::uint32_t, 4>& bodies,
             const std::array<std::uint32_t, 4>& vertices) const {
    ImpactQuery query{kind, {}, {}};
    for (std::size_t i = 0; i < 4; ++i) {
      query.start[i] = start(bodies[i])[vertices[i]];
      query.end[i] = end(bodies[i])[vertices[i]];
    }
    return elementary_impact(query);
  }

  bool share(std::uint32_t body, std::span<const std::uint32_t> some,
             std::span<const std::uint32_t> others) const {
    const std::vector<std::uint32_t>& place = elements[body]->place;
    for (const std::uint32_t v : some)
      for (const std::uint32_t w : others)
        if (place[v] == place[w]) return true;
    return false;
  }

  /// Calls `meet(vertex of a, triangle of b, impact)`.
  template <typename Meet>
  void vertices_with_triangles(std::uint32_t a, std::uint32_t b, Meet&& meet) const {
    for (std::uint32_t v = 0; v < elements[a]->at_vertex.size(); ++v) {
      if (elements[a]->at_vertex[v].empty()) continue;
      const Aabb box = swept_box(a, std::array{v});
      any_triangle(
          trees[b], [&](const Aabb& other) { return other.overlaps(box); },
          [&](std::uint32_t t) {
            const Triangle& corners = shapes[b]->mesh.triangles[t];
            if (a == b && share(a, std::array{v}, corners)) return false;
            const Impact impact = ask(ImpactKind::vertex_triangle, {a, b, b, b},
                                      {v, corners[0], corners[1], corners[2]});
            if (impact.contact) meet(v, t, impact);
            return false;
          });
    }
  }

  /// Calls `meet(edge of a, edge of b, impact)`, of one body with the lower edge first. An edge of
  /// b is looked at with the first triangle that has it.
  template <typename Meet>
  void edges_with_edges(std::uint32_t a, std::uint32_t b, Meet&& meet) const {
    const Elements &of_a = *elements[a], &of_b = *elements[b];
    for (std::uint32_t e = 0; e < of_a.edges.size(); ++e) {
      const Aabb box = swept_box(a, of_a.edges[e]);
      any_triangle(
          trees[b], [&](const Aabb& other) { return other.overlaps(box); },
          [&](std::uint32_t t) {
            std::array<std::uint32_t, 3> sides = of_b.of_triangle[t];
            std::sort(sides.begin(), sides.end());
            const auto last = std::unique(sides.begin(), sides.end());
            for (auto f = sides.begin(); f != last; ++f) {
              if (*f == MeshEdges::kNone || of_b.at_edge[*f].front() != t) continue;
              const Edge &p = of_a.edges[e], &q = of_b.edges[*f];
              if (a == b && (*f <= e || share(a, p, q))) continue;
              if (!swept_box(b, q).overlaps(box)) continue;
              const Impact impact =
                  ask(ImpactKind::edge_edge, {a, a, b, b}, {p[0], p[1], q[0], q[1]});
              if (impact.contact) meet(e, *f, impact);
            }
            return false;
          });
    }
  }

  void judge_pair(std::uint32_t a, std::uint32_t b, StepTruth& truth);
  void judge_own(std::uint32_t body, StepTruth& truth) const;

  std::vector<std::shared_ptr<const BodyShape>> shapes;
  std::vector<std::shared_ptr<const Elements>> elements;
  std::vector<SurfaceTree> trees;
  const Step* step = nullptr;
};

StepOracle::Impl::Elements::Elements(const BodyShape& shape)
    : at_vertex(shape.mesh.vertices.size()), place(shape.mesh.vertices.size()) {
  MeshEdges found = mesh_edges(shape.mesh.triangles);
  edges = std::move(found.edges);
  of_triangle = std::move(found.of_triangle);
  at_edge.resize(edges.size());
  for (std::uint32_t t = 0; t < of_triangle.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t vertex = shape.mesh.triangles[t][i], edge = of_triangle[t][i];
      add_once(at_vertex[vertex], t);
      if (edge != MeshEdges::kNone) add_once(at_edge[edge], t);
      place[vertex] = shape.linked()[t][i];
    }
}

// `truth.contacts.impact_triangles` has the pairs that touch at the start already.
void StepOracle::Impl::judge_pair(std::uint32_t a, std::uint32_t b, StepTruth& truth) {
  if (!trees[a].bounds().overlaps(trees[b].bounds())) return;
  ContactSet& out = truth.contacts;
  FirstImpact first{{a, b}, false, 2, 2};
  const auto triangles = [&](const std::vector<std::uint32_t>& of_a,
                             const std::vector<std::uint32_t>& of_b) {
    for (const std::uint32_t s : of_a)
      for (const std::uint32_t t : of_b) add_contact(out.impact_triangles, {a, b, s, t});
  };
  vertices_with_triangles(a, b, [&](std::uint32_t v, std::uint32_t t, const Impact& impact) {
    take_earlier(first, impact);
    add_contact(out.impact_vertices, {a, b, v, t});
    triangles(elements[a]->at_vertex[v], {t});
  });
  vertices_with_triangles(b, a, [&](std::uint32_t v, std::uint32_t t, const Impact& impact) {
    take_earlier(first, impact);
    add_contact(out.impact_vertices, {b, a, v, t});
    triangles({t}, elements[b]->at_vertex[v]);
  });
  edges_with_edges(a, b, [&](std::uint32_t e, std::uint32_t f, const Impact& impact) {
    take_earlier(first, impact);
    add_contact(out.impact_edges, {a, b, e, f});
    triangles(elements[a]->at_edge[e], elements[b]->at_edge[f]);
  });
  if (first.latest <= 1) truth.first.push_back(first);
}

void StepOracle::Impl::judge_own(std::uint32_t body, StepTruth& truth) const {
  vertices_with_triangles(body, body, [&](std::uint32_t v, std::uint32_t t, const Impact&) {
    add_contact(truth.contacts.self_impact_vertices, {body, body, v, t});
  });
  edges_with_edges(body, body, [&](std::uint32_t e, std::uint32_t f, const Impact&) {
    add_contact(truth.contacts.self_impact_edges, {body, e, f});
  });
}

StepOracle::StepOracle(const std::vector<Body>& bodies) : impl_(std::make_unique<Impl>(bodies)) {}
StepOracle::~StepOracle() = default;

StepTruth StepOracle::judge(const Step& step, const std::vector<ElementPair>& at_start,
                            WantedSteps wanted) {
  const FloatingPointGuard guard;
  const auto count = static_cast<std::uint32_t>(impl_->shapes.size());
  CONTACTCHECK_INVARIANT(step.start.bodies.size() == count && step.end.bodies.size() == count,
                         "one state per body at both ends");
  impl_->step = &step;
  for (std::uint32_t b = 0; b < count; ++b) {
    const std::size_t vertices = impl_->shapes[b]->mesh.vertices.size();
    CONTACTCHECK_INVARIANT(impl_->start(b).size() == vertices && impl_->end(b).size() == vertices,
                           "the oracle needs every deformed vertex at both ends");
    impl_->trees[b].refit(impl_->start(b), impl_->end(b));
  }
  StepTruth truth;
  if (wanted.between) {
    truth.contacts.impact_triangles = at_start;
    std::vector<BodyPair> touching;
    for (const ElementPair& pair : at_start)
      if (const BodyPair bodies{pair.body_a, pair.body_b};
          touching.empty() || touching.back() != bodies)
        touching.push_back(bodies);
    for (std::uint32_t a = 0; a < count; ++a)
      for (std::uint32_t b = a + 1; b < count; ++b) impl_->judge_pair(a, b, truth);
    // Bodies that touch at the start have their first contact there.
    std::erase_if(truth.first, [&](const FirstImpact& first) {
      return std::binary_search(touching.begin(), touching.end(), first.bodies);
    });
    for (const BodyPair& bodies : touching) truth.first.push_back({bodies, true, 0, 0});
  }
  for (std::uint32_t b = 0; wanted.own && b < count; ++b) impl_->judge_own(b, truth);
  std::sort(truth.first.begin(), truth.first.end(),
            [](const FirstImpact& x, const FirstImpact& y) { return x.bodies < y.bodies; });
  truth.contacts.canonicalize();
  CONTACTCHECK_INVARIANT(truth.contacts.impacts.size() == truth.first.size(),
                         "elements and bodies agree");
  return truth;
}

}  // namespace contactcheck::oracle
