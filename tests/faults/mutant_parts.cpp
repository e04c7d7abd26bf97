// Parts of core that no contact hangs on, or that a detector uses in its own way only.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/broad/body_pairs.h"
#include "core/broad/spatial_hash.h"
#include "core/deform/ffd_aabb.h"
#include "core/types/contact_set.h"
#include "core/types/mesh_topology.h"
#include "tests/faults/mutant_checks.h"
#include "tests/support/random_triangles.h"

namespace contactcheck::test {
namespace {

// Random pairs, in both orientations and repeated.
std::vector<ElementPair> loose_pairs(TriangleSource& random) {
  const auto id = [&](int count) { return static_cast<std::uint32_t>(random.below(count)); };
  std::vector<ElementPair> pairs;
  for (int i = 0; i < 200; ++i) {
    const std::uint32_t a = id(4), b = (a + 1 + id(3)) % 4;
    pairs.push_back({a, b, id(5), id(5)});
  }
  return pairs;
}

void check_canonical_sets(MutantFindings& out) {
  TriangleSource random(51);
  const std::vector<ElementPair> pairs = loose_pairs(random);
  std::vector<ElementPair> expected = pairs;
  for (ElementPair& p : expected)
    if (p.body_b < p.body_a) p = {p.body_b, p.body_a, p.b, p.a};
  std::sort(expected.begin(), expected.end());
  expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
  std::vector<BodyPair> bodies;
  for (const ElementPair& p : expected)
    if (bodies.empty() || bodies.back() != BodyPair{p.body_a, p.body_b})
      bodies.push_back({p.body_a, p.body_b});

  out.enter({"loose-pairs", 0, "ContactSet", "canonical"});
  ContactSet set;
  set.triangles = pairs;
  set.canonicalize();
  out.expect(set.triangles == expected, "triangle pairs are not oriented, sorted and unique");
  out.expect(set.bodies == bodies, "triangle pairs do not imply their body pairs");
  ContactSet only_bodies;
  for (const ElementPair& p : pairs) only_bodies.bodies.push_back({p.body_a, p.body_b});
  only_bodies.canonicalize();
  out.expect(only_bodies.bodies == bodies, "body pairs are not oriented, sorted and unique");
}

void check_grid_coordinates(MutantFindings& out) {
  TriangleSource random(52);
  for (std::size_t i = 0; i < 2000; ++i) {
    out.enter({"coordinates", i, "grid_coordinate", "bucket"});
    const double x = i % 4 == 0 ? random.below(9) - 4 : 8.0 * random.unit();
    const double edge = i % 3 == 0 ? 0.5 : 1.0 + 0.5 * random.unit();
    out.expect(static_cast<double>(grid_coordinate(x, edge)) == std::floor(x / edge),
               "not the floor of the quotient");
  }
}

// Few cells in each direction, and cells so far out that products of their coordinates wrap.
GridKey random_key(TriangleSource& random) {
  const auto coordinate = [&]() -> std::int64_t {
    const std::int64_t far = std::int64_t{1} << 61;
    const std::int64_t near = random.below(7) - 3;
    return random.below(4) == 0 ? (random.below(2) == 0 ? far : -far) + near : near;
  };
  const std::int64_t x = coordinate(), y = coordinate();
  return {x, y, coordinate()};
}

void check_buckets(MutantFindings& out) {
  for (std::uint32_t size : {0u, 1u, 16u}) {
    TriangleSource random(53);
    SpatialHash hash(size);
    std::vector<GridKey> keys;
    for (std::uint32_t id = 0; id < 400; ++id) {
      keys.push_back(random_key(random));
      hash.insert(keys.back(), id);
    }
    hash.build();
    for (std::size_t i = 0; i < keys.size(); ++i) {
      out.enter({"keys", i, "SpatialHash", "bucket"});
      std::vector<std::uint32_t> truth, found;
      for (std::uint32_t id = 0; id < keys.size(); ++id)
        if (keys[id] == keys[i]) truth.push_back(id);
      hash.for_each(keys[i], [&](std::uint32_t id) { found.push_back(id); });
      std::sort(found.begin(), found.end());
      out.expect_same(truth, found);
    }
  }
}

// Boxes with integer ends: many touch and none more.
void check_candidate_bodies(MutantFindings& out) {
  TriangleSource random(54);
  for (std::size_t f = 0; f < 30; ++f) {
    std::vector<Aabb> boxes;
    for (int i = 0; i < 20; ++i) {
      boxes.push_back(random.grid_box(2));
      const double away = 4.0 * random.below(5);
      boxes.back().lo[static_cast<int>(f % 3)] += away;
      boxes.back().hi[static_cast<int>(f % 3)] += away;
    }
    out.enter({"integer-boxes", f, "find_candidate_bodies", "body"});
    std::vector<BodyPair> truth, found;
    for (std::uint32_t a = 0; a < boxes.size(); ++a)
      for (std::uint32_t b = a + 1; b < boxes.size(); ++b)
        if ((boxes[a].lo.array() <= boxes[b].hi.array()).all() &&
            (boxes[b].lo.array() <= boxes[a].hi.array()).all())
          truth.push_back({a, b});
    find_candidate_bodies(boxes, found);
    out.expect_same(truth, found);
  }
}

// A triangle alone, with corners on planes between cells: a cell's box holds every corner that the
// closed cell holds. (All these coordinates are short.)
void check_ffd_aabbs(MutantFindings& out) {
  TriangleSource random(55);
  for (std::size_t i = 0; i < 60; ++i) {
    out.enter({"corners-on-planes", i, "ffd_aabbs", "box"});
    const TriangleMesh mesh = triangle_mesh(
        0.25 * random.grid_point(4), 0.25 * random.grid_point(4), 0.25 * random.grid_point(4));
    std::array<std::vector<double>, 3> lines;
    lines.fill({-2, -1, 0, 1, 2});
    const auto shape = make_shape_on_lines(mesh, lines);
    const std::vector<Aabb> boxes = ffd_aabbs(mesh, *shape->lattice, shape->embedding);
    for (std::uint32_t cell = 0; cell < boxes.size(); ++cell) {
      const Aabb of_cell = shape->lattice->cell_box(cell);
      for (std::uint32_t v : mesh.triangles[0]) {
        const Vec3 local = mesh.vertices[v] - of_cell.lo;  // cells have sides of 1
        const bool held = (local.array() >= 0.0).all() && (local.array() <= 1.0).all();
        out.expect(!held || boxes[cell].contains(local), "a corner in the cell is not in its box");
      }
    }
  }
}

void check_topology_of(const std::string& name, const TriangleMesh& mesh, bool solid,
                       MeshDefectKind kind, std::size_t defects, MutantFindings& out) {
  out.enter({name, 0, "analyse_topology", "solid"});
  const MeshTopology topology = analyse_topology(mesh);
  out.expect(topology.solid == solid, solid ? "a solid is taken for none" : "taken for a solid");
  out.expect(topology.count(kind) == defects, std::string("wrong number of ") + name_of(kind));
}

void check_topology(MutantFindings& out) {
  const TriangleMesh whole = sphere_mesh(Vec3::Zero(), 1.0, 1);
  check_topology_of("sphere", whole, true, MeshDefectKind::kBoundaryEdge, 0, out);
  TriangleMesh open = whole, turned = whole, doubled = whole;
  open.triangles.pop_back();
  check_topology_of("open-sphere", open, false, MeshDefectKind::kBoundaryEdge, 3, out);
  std::swap(turned.triangles[5][0], turned.triangles[5][1]);
  check_topology_of("sphere-with-a-turned-triangle", turned, false,
                    MeshDefectKind::kInconsistentOrientation, 3, out);
  doubled.triangles.push_back(doubled.triangles[0]);
  check_topology_of("sphere-with-a-double-triangle", doubled, false,
                    MeshDefectKind::kNonManifoldEdge, 3, out);
  TriangleMesh flat = whole;
  flat.vertices.push_back(Vec3(9, 9, 9));
  flat.triangles.push_back({0, 0, 1});
  check_topology_of("sphere-with-a-repeated-index", flat, false, MeshDefectKind::kRepeatedIndex, 1,
                    out);
}

}  // namespace

void check_small_parts(MutantFindings& out) {
  check_canonical_sets(out);
  check_grid_coordinates(out);
  check_buckets(out);
  check_candidate_bodies(out);
  check_ffd_aabbs(out);
  check_topology(out);
}

}  // namespace contactcheck::test
