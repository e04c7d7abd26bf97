#include "reference/oracle/closed_chain.h"

#include <gmock/gmock.h>

#include <cmath>
#include <optional>

#include "tests/reference/oracle/meshes.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {
namespace {

using oracle::OpenEdge, oracle::SurfaceChain;
using testing::ElementsAre;

SurfaceChain chain_of(const TriangleMesh& mesh) {
  return oracle::surface_chain(mesh.triangles, mesh.vertices);
}
bool closed_as_written(const TriangleMesh& mesh) {
  return oracle::surface_chain_as_written(mesh.triangles, mesh.vertices.size()).closed();
}

TriangleMesh without_triangle(TriangleMesh mesh, std::size_t triangle) {
  mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(triangle));
  return mesh;
}

// A tetrahedron whose edge 0-1 has its middle, vertex 4, in one of the two triangles there.
TriangleMesh tetrahedron_with_split_edge() {
  return {{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 0, 0}},
          {{0, 2, 1}, {0, 4, 3}, {4, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}

TEST(ClosedChain, BoxIsClosedAndHasOneComponent) {
  const SurfaceChain chain = chain_of(unit_box_mesh(2));
  EXPECT_TRUE(chain.closed());
  EXPECT_THAT(chain.component, testing::Each(0u));
  EXPECT_EQ(chain.component_vertex.size(), 1u);
}

TEST(ClosedChain, MissingTriangleOpensItsFirstEdgeThatAnotherTriangleRuns) {
  const TriangleMesh box = unit_box_mesh(1);
  for (std::size_t t = 0; t < box.triangles.size(); ++t) {
    const TriangleMesh open = without_triangle(box, t);
    for (const TriangleMesh& mesh : {open, with_own_corners(open)}) {
      const SurfaceChain chain = chain_of(mesh);
      ASSERT_TRUE(chain.open) << t;
      const Vec3 from = mesh.vertices[chain.open->from], to = mesh.vertices[chain.open->to];
      const auto has = [&](const Vec3& p) {
        return std::ranges::any_of(box.triangles[t],
                                   [&](std::uint32_t v) { return box.vertices[v] == p; });
      };
      EXPECT_TRUE(has(from) && has(to) && from != to) << t;
      EXPECT_TRUE(std::ranges::count(mesh.triangles[chain.open->triangle], chain.open->from) == 1);
    }
  }
}

TEST(ClosedChain, FirstOpenEdgeIsTheFirstTrianglesFirst) {
  const TriangleMesh one = triangle_mesh(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  EXPECT_EQ(chain_of(one).open, (OpenEdge{0, 0, 1}));
  // Triangle 2 misses its second edge, from vertex 2 to 3.
  const TriangleMesh tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                 {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}}};
  EXPECT_EQ(chain_of(tetrahedron).open, (OpenEdge{0, 0, 2}));
}

TEST(ClosedChain, TurnedTriangleIsOpen) {
  TriangleMesh box = unit_box_mesh(1);
  std::swap(box.triangles[3][0], box.triangles[3][1]);
  EXPECT_FALSE(chain_of(box).closed());
  EXPECT_FALSE(closed_as_written(box));
}

TEST(ClosedChain, CornersOfTheirOwnAreOneVertexWhereTheyAreAtOnePlace) {
  const TriangleMesh stl = with_own_corners(sphere_mesh(Vec3(1, 2, 3), 2.0, 2));
  EXPECT_FALSE(closed_as_written(stl));
  const SurfaceChain chain = chain_of(stl);
  EXPECT_TRUE(chain.closed());
  EXPECT_EQ(chain.component_vertex.size(), 1u);
  for (std::uint32_t v = 0; v < chain.welded.size(); ++v) {
    EXPECT_LE(chain.welded[v], v);
    EXPECT_EQ(stl.vertices[chain.welded[v]], stl.vertices[v]);
  }
}

TEST(ClosedChain, MinusZeroIsZero) {
  TriangleMesh box = with_own_corners(unit_box_mesh(1));
  for (std::size_t v = 0; v < box.vertices.size(); v += 2)
    for (double& x : box.vertices[v])
      if (x == 0.0) x = -0.0;
  EXPECT_TRUE(chain_of(box).closed());
}

TEST(ClosedChain, OneUlpBetweenVerticesIsAGap) {
  TriangleMesh box = with_own_corners(unit_box_mesh(1));
  ASSERT_TRUE(chain_of(box).closed());
  for (const double x : {std::nextafter(0.0, 1.0), std::nextafter(1.0, 2.0)}) {
    TriangleMesh torn = box;
    double& moved = torn.vertices[4].x();
    if (std::abs(moved - x) > 0.5) continue;
    moved = x;
    EXPECT_FALSE(chain_of(torn).closed());
  }
}

TEST(ClosedChain, RepeatedCornersDoNotHinder) {
  TriangleMesh box = unit_box_mesh(1);
  box.triangles.insert(box.triangles.begin(), {{3, 3, 5}, {0, 1, 0}, {2, 7, 7}, {4, 4, 4}});
  EXPECT_TRUE(chain_of(box).closed());
  EXPECT_TRUE(chain_of(with_own_corners(box)).closed());
  EXPECT_EQ(chain_of(without_triangle(box, 5)).open->triangle, chain_of(box).open ? 0u : 4u);
}

TEST(ClosedChain, TrianglesOfNoAreaDoNotHinder) {
  // A flap along an edge, one on its own in space, and corners at one place that are two vertices.
  const TriangleMesh box = box_mesh(Vec3(0, 0, 0), Vec3(2, 2, 2), 2);
  TriangleMesh flaps = box;
  const auto vertex = [&flaps](const Vec3& p) {
    flaps.vertices.push_back(p);
    return static_cast<std::uint32_t>(flaps.vertices.size() - 1);
  };
  const std::uint32_t a = vertex({0, 0, 0}), b = vertex({2, 0, 0}), c = vertex({7, 0, 0}),
                      d = vertex({2, 0, 0});
  flaps.triangles.push_back({a, b, c});
  flaps.triangles.push_back({d, a, b});
  flaps.triangles.push_back({vertex({5, 5, 5}), vertex({6, 6, 6}), vertex({8, 8, 8})});
  EXPECT_FALSE(closed_as_written(flaps));
  EXPECT_TRUE(chain_of(flaps).closed());
  flaps.triangles.erase(flaps.triangles.begin() + 3);
  EXPECT_FALSE(chain_of(flaps).closed());
}

TEST(ClosedChain, SliverThatFillsASeamClosesIt) {
  TriangleMesh seam = tetrahedron_with_split_edge();
  EXPECT_EQ(chain_of(seam).open, (OpenEdge{0, 1, 0}));  // an edge against two is no sliver
  for (const Triangle& sliver : {Triangle{0, 1, 4}, Triangle{1, 0, 4}}) {
    TriangleMesh filled = seam;
    filled.triangles.push_back(sliver);
    EXPECT_TRUE(chain_of(filled).closed());
    EXPECT_TRUE(chain_of(with_own_corners(filled)).closed());
  }
  // Off the line by one ulp the triangle has an area, and only one orientation fits.
  seam.vertices[4].y() = 0x1p-1074;
  seam.triangles.push_back({0, 1, 4});
  EXPECT_TRUE(chain_of(seam).closed());
  seam.triangles.back() = {1, 0, 4};
  EXPECT_FALSE(chain_of(seam).closed());
}

// The sliver's edges cancel where the others do, and not beyond.
TEST(ClosedChain, SliverDoesNotCloseAHoleBesideIt) {
  TriangleMesh hole = tetrahedron_with_split_edge();
  hole.triangles.push_back({0, 1, 4});
  for (std::size_t t = 0; t < 5; ++t) EXPECT_FALSE(chain_of(without_triangle(hole, t)).closed());
  hole.vertices[4] = {3, 0, 0};  // beyond the edge: 0-4 and 4-1 cancel along the line
  EXPECT_TRUE(chain_of(hole).closed());
  hole.vertices[4] = {1, 1, 0};  // on another edge's middle: the triangle has an area
  EXPECT_TRUE(chain_of(hole).closed());
  hole.triangles.back() = {0, 4, 1};
  EXPECT_FALSE(chain_of(hole).closed());
}

// Every edge of the hole is one of a triangle of no area, and does not cancel along its line: not
// even where all three lines look like one along an axis.
TEST(ClosedChain, SliversOnAllEdgesOfAHoleDoNotCloseIt) {
  const TriangleMesh tetrahedron{{{0, 0, 0}, {2, 0, 1}, {0, 2, 0}, {1, 0, 3}},
                                 {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  for (std::size_t t = 0; t < 4; ++t) {
    TriangleMesh hole = without_triangle(tetrahedron, t);
    const Triangle gone = tetrahedron.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = gone[k], b = gone[(k + 1) % 3];
      hole.triangles.push_back({a, b, static_cast<std::uint32_t>(hole.vertices.size())});
      hole.vertices.push_back(0.5 * (hole.vertices[a] + hole.vertices[b]));
    }
    EXPECT_FALSE(chain_of(hole).closed()) << t;
    hole.triangles.push_back(gone);
    EXPECT_TRUE(chain_of(hole).closed()) << t;
  }
}

TEST(ClosedChain, SliversAlongManyDirectionsCancelEachOnItsOwnLine) {
  // Tetrahedra whose split edges all meet in vertex 0: lines in all octants.
  TriangleSource source(401);
  TriangleMesh mesh{{Vec3::Zero()}, {}};
  for (int i = 0; i < 60; ++i) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    Vec3 far = 2 * Vec3(source.grid_point(3)), p = source.grid_point(3), q = source.grid_point(3);
    if (far.isZero()) far = Vec3(0, 0, 2);
    for (const Vec3& v : {far, Vec3(far / 2), p, q}) mesh.vertices.push_back(v);
    const std::uint32_t m = first + 1, u = first + 2, w = first + 3;
    // The tetrahedron 0, far, p, q; its edge to `far` is split in one of the two triangles.
    for (const Triangle& t : {Triangle{0, u, first}, Triangle{0, m, w}, Triangle{m, first, w},
                              Triangle{first, u, w}, Triangle{0, w, u}})
      mesh.triangles.push_back(t);
    // Where it is turned about, its edges do not cancel one by one.
    mesh.triangles.push_back(i % 2 == 0 ? Triangle{0, first, m} : Triangle{0, m, first});
  }
  EXPECT_TRUE(chain_of(mesh).closed());
  EXPECT_TRUE(chain_of(with_own_corners(mesh)).closed());
}

TEST(ClosedChain, FourTrianglesOnAnEdgeDoNotHinder) {
  // Two boxes that share an edge, by the same vertices and by vertices at one place.
  const TriangleMesh two =
      joined(box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1), 1), box_mesh(Vec3(1, 1, 0), Vec3(2, 2, 1), 1));
  const SurfaceChain chain = chain_of(two);
  EXPECT_TRUE(chain.closed());
  EXPECT_EQ(chain.component_vertex.size(), 1u);  // they hang together by that edge
  // A wall inside, once each way.
  TriangleMesh wall = unit_box_mesh(1);
  const TriangleMesh sheet = triangle_mesh(Vec3(0, 0, 0), Vec3(1, 1, 0), Vec3(1, 1, 1));
  wall = joined(joined(wall, sheet), reversed(sheet));
  EXPECT_TRUE(chain_of(wall).closed());
  EXPECT_FALSE(chain_of(without_triangle(wall, 12)).closed());
  // Three on an edge are one too many.
  EXPECT_FALSE(chain_of(joined(unit_box_mesh(1), sheet)).closed());
}

TEST(ClosedChain, ComponentsAreNumberedByTheirFirstTriangles) {
  const TriangleMesh shell = joined(box_mesh(Vec3(0, 0, 0), Vec3(4, 4, 4), 1),
                                    reversed(box_mesh(Vec3(1, 1, 1), Vec3(3, 3, 3), 1)));
  for (const SurfaceChain& chain :
       {chain_of(shell), oracle::surface_chain_as_written(shell.triangles, 16)}) {
    EXPECT_TRUE(chain.closed());
    ASSERT_EQ(chain.component_vertex.size(), 2u);
    for (std::size_t t = 0; t < 24; ++t) EXPECT_EQ(chain.component[t], t < 12 ? 0u : 1u);
    EXPECT_EQ(chain.component_vertex[1], shell.triangles[12][0]);
  }
  // Touching in a vertex alone, they stay two.
  const TriangleMesh corner =
      joined(box_mesh(Vec3(0, 0, 0), Vec3(1, 1, 1), 1), box_mesh(Vec3(1, 1, 1), Vec3(2, 2, 2), 1));
  EXPECT_EQ(chain_of(corner).component_vertex.size(), 2u);
}

TEST(ClosedChain, ReasonNamesTheEdgeAndThePlace) {
  EXPECT_EQ(oracle::open_reason({7, 4, 5}, {}), "open (edge of vertices 4 and 5)");
  EXPECT_EQ(oracle::open_reason({7, 4, 5}, {}, "frame 3"),
            "open (frame 3, edge of vertices 4 and 5)");
  const GivenVertices without_two{{0, 1, 2, 3, 5, 7}, 2};
  EXPECT_EQ(oracle::open_reason({7, 4, 5}, without_two), "open (edge of vertices 5 and 7)");
}

// Sums of boundaries are closed, whatever they share; without any one triangle they are not.
TEST(ClosedChainAtRandom, BoundariesOfTetrahedraAreClosedAndLessOneTriangleAreNot) {
  TriangleSource source(402);
  int flat = 0, proper = 0;
  for (int round = 0; round < 200; ++round) {
    TriangleMesh mesh = tetrahedra_on_a_grid(source, 1 + round % 12, 1 + round % 3);
    if (round % 2 == 1) mesh = with_own_corners(mesh);
    ASSERT_TRUE(chain_of(mesh).closed()) << hex_points(mesh.vertices);
    if (round % 2 == 0) {
      EXPECT_TRUE(closed_as_written(mesh));
    }
    const std::size_t t = static_cast<std::size_t>(round) % mesh.triangles.size();
    const Triangle& gone = mesh.triangles[t];
    const Vec3 &a = mesh.vertices[gone[0]], &b = mesh.vertices[gone[1]],
               &c = mesh.vertices[gone[2]];
    const bool no_area = (b - a).cross(c - a).isZero(0.0);  // exact: small integers
    (no_area ? flat : proper) += 1;
    EXPECT_EQ(chain_of(without_triangle(mesh, t)).closed(), no_area);
  }
  EXPECT_GT(flat, 10);
  EXPECT_GT(proper, 100);
}

}  // namespace
}  // namespace contactcheck::test
