#include "core/deform/ffd_aabb.h"

#include <gtest/gtest.h>

#include "core/deform/body.h"
#include "core/deform/mapping.h"
#include "tests/support/random_triangles.h"
#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

// Clipping and sampling round: the cell is 1 wide, a few roundings of 2^-53 each.
constexpr double kClippingError = 1e-14;

Lattice unit_cells(std::uint32_t nx) {
  Lattice lattice;
  for (std::uint32_t i = 0; i <= nx; ++i) lattice.lines[0].push_back(i);
  lattice.lines[1] = lattice.lines[2] = {0.0, 1.0};
  for (std::uint32_t i = 0; i < nx; ++i) lattice.cells.push_back({i, 0, 0});
  return lattice;
}

std::vector<Aabb> boxes_of(const TriangleMesh& mesh, const Lattice& lattice) {
  return ffd_aabbs(mesh, lattice, embed(mesh, lattice));
}

// Counts the sample points of the triangle that lie in the cell; all must be in its box.
std::size_t expect_samples_inside(const TriangleMesh& mesh, const Triangle& t, const Aabb& cell,
                                  const Aabb& box) {
  constexpr int kSteps = 24;
  std::size_t inside = 0;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; i + j <= kSteps; ++j) {
      const double a = static_cast<double>(i) / kSteps, b = static_cast<double>(j) / kSteps;
      const Vec3 p =
          (1.0 - a - b) * mesh.vertices[t[0]] + a * mesh.vertices[t[1]] + b * mesh.vertices[t[2]];
      if (!cell.contains(p)) continue;
      ++inside;
      const Vec3 local = (p - cell.lo).cwiseQuotient(cell.extent());
      EXPECT_TRUE((local.array() >= box.lo.array() - kClippingError).all() &&
                  (local.array() <= box.hi.array() + kClippingError).all());
    }
  return inside;
}

TEST(FfdAabb, HoldsTheSurfaceInsideItsCell) {
  std::size_t samples = 0;
  for (const TriangleMesh& mesh :
       {test::sphere_mesh({0.1, 0.2, 0.3}, 1.0, 1), test::unit_box_mesh(3)}) {
    const Lattice lattice = make_lattice(mesh, {4, 3, 5}, 0.02);
    const Embedding e = embed(mesh, lattice);
    const std::vector<Aabb> boxes = ffd_aabbs(mesh, lattice, e);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::uint32_t cell : e.cells_of_triangle(t))
        samples +=
            expect_samples_inside(mesh, mesh.triangles[t], lattice.cell_box(cell), boxes[cell]);
  }
  EXPECT_GT(samples, 10000u);
}

TEST(FfdAabb, HoldsTheLocalsOfItsVerticesBitForBit) {
  const TriangleMesh mesh = test::sphere_mesh({10, 20, 30}, 1.0, 3);
  const Lattice lattice = make_lattice(mesh, {4, 4, 4}, 0.02);
  const Embedding e = embed(mesh, lattice);
  const std::vector<Aabb> boxes = ffd_aabbs(mesh, lattice, e);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    EXPECT_TRUE(boxes[e.home_cell[v]].contains(e.local[v]));
}

TEST(FfdAabb, IsWithinTheUnitCubeAndNeverEmpty) {
  test::TriangleSource random(31);
  const Aabb unit{Vec3::Zero(), Vec3::Ones()};
  for (int round = 0; round < 200; ++round) {
    // Corners on, or single ulps off, grid lines: the triangles that clipping may round away.
    TriangleMesh mesh;
    for (int v = 0; v < 3; ++v) mesh.vertices.push_back(random.jitter(random.grid_point(2)));
    mesh.triangles = {{0, 1, 2}};
    const Lattice lattice = make_lattice(mesh, {4, 4, 4}, round % 2 ? 0.5 : 0.0);
    for (const Aabb& box : boxes_of(mesh, lattice)) {
      EXPECT_FALSE(box.empty());
      EXPECT_TRUE(unit.contains(box));
    }
  }
}

TEST(FfdAabb, IsTightWhereATriangleCrossesACellFace) {
  const TriangleMesh mesh =
      test::triangle_mesh({0.5, 0.25, 0.5}, {1.5, 0.25, 0.5}, {0.5, 0.75, 0.5});
  const std::vector<Aabb> boxes = boxes_of(mesh, unit_cells(2));
  EXPECT_EQ(boxes[0].lo, Vec3(0.5, 0.25, 0.5));
  EXPECT_EQ(boxes[0].hi, Vec3(1.0, 0.75, 0.5));
  EXPECT_EQ(boxes[1].lo, Vec3(0.0, 0.25, 0.5));
  EXPECT_EQ(boxes[1].hi, Vec3(0.5, 0.5, 0.5));
}

TEST(FfdAabb, OfACellThatHoldsNoVertexIsTheStripInside) {
  const TriangleMesh mesh = test::triangle_mesh({0.5, 0.0, 0.5}, {2.5, 0.0, 0.5}, {2.5, 1.0, 0.5});
  const std::vector<Aabb> boxes = boxes_of(mesh, unit_cells(3));
  EXPECT_EQ(boxes[1].lo, Vec3(0.0, 0.0, 0.5));
  EXPECT_EQ(boxes[1].hi, Vec3(1.0, 0.75, 0.5));
}

TEST(FfdAabb, OfATouchedCellIsThePointOfTouch) {
  // The cell above x = 1 is touched in one point of the shared face.
  const TriangleMesh mesh = test::triangle_mesh({0.5, 0.0, 0.5}, {1.0, 0.5, 0.5}, {0.5, 1.0, 0.5});
  const std::vector<Aabb> boxes = boxes_of(mesh, unit_cells(2));
  EXPECT_EQ(boxes[1].lo, Vec3(0.0, 0.5, 0.5));
  EXPECT_EQ(boxes[1].hi, Vec3(0.0, 0.5, 0.5));
}

// One cell is thin: the triangle reaches far beyond it, and crosses it from corner to corner.
std::vector<Aabb> boxes_with_a_thin_cell(double thin, double far) {
  Lattice lattice;
  lattice.lines = {std::vector<double>{0.0, thin, far}, {0.0, thin, far}, {0.0, 1.0}};
  lattice.cells = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  return boxes_of(test::triangle_mesh({0, 0, 0}, {far, far, 0}, {far, far, 1}), lattice);
}

TEST(FfdAabb, OfAThinCellHoldsWhatCrossesIt) {
  // Below and above the limit beyond which nothing is cut, and where a cut would be no number.
  for (const double far : {0x1p20 - 1, 0x1p20, 0x1p20 + 1, 1e30, 1e150}) {
    const Aabb box = boxes_with_a_thin_cell(1.0, far)[0];
    EXPECT_EQ(box.lo, Vec3(0, 0, 0)) << far;
    EXPECT_EQ(box.hi.head<2>(), Eigen::Vector2d(1, 1)) << far;
    EXPECT_GE(box.hi.z(), 0.99 / far) << far;
    EXPECT_LE(box.hi.z(), far > 0x1p20 ? 1.0 : 1.01 / far) << far;
  }
  const Aabb box = boxes_with_a_thin_cell(1e-200, 1e150)[0];
  EXPECT_EQ(box.lo, Vec3(0, 0, 0));
  EXPECT_EQ(box.hi, Vec3(1, 1, 1));
}

TEST(MappedBox, TakesTheCornersThroughTheCellsNodes) {
  const auto shape = make_shape(test::unit_box_mesh(1), {1, 1, 1}, 0.5);  // [-1/2, 3/2]^3
  std::vector<Vec3> nodes = shape->lattice->rest_nodes();
  const Aabb local{Vec3(0.25, 0.25, 0.25), Vec3(0.75, 0.5, 1.0)};
  const Corners at_rest = mapped_box(*shape->lattice, 0, local, nodes);
  EXPECT_EQ(at_rest[0], Vec3(0, 0, 0));
  EXPECT_EQ(at_rest[1], Vec3(1, 0, 0));
  EXPECT_EQ(at_rest[2], Vec3(0, 0.5, 0));
  EXPECT_EQ(at_rest[4], Vec3(0, 0, 1.5));
  EXPECT_EQ(at_rest[7], Vec3(1, 0.5, 1.5));
  nodes[7] += Vec3(0, 0, 16);  // weight of corner 7: s t u
  EXPECT_EQ(mapped_box(*shape->lattice, 0, local, nodes)[7], Vec3(1, 0.5, 1.5 + 16 * 0.375));
  EXPECT_EQ(mapped_box(*shape->lattice, 0, local, nodes)[0], Vec3(0, 0, 0.25));
}

TEST(MappedBox, HasTheBitsOfMapPointAtEveryCorner) {
  const auto shape = make_shape(test::unit_box_mesh(2), {2, 2, 2});
  test::TriangleSource random(32);
  std::vector<Vec3> nodes(shape->node_count());
  for (int round = 0; round < 100; ++round) {
    for (Vec3& n : nodes) n = random.point(Vec3::Constant(100.0), 1.0);
    Aabb local;  // a point in every other round
    for (int i = 0; i <= round % 2; ++i) local.extend(random.point(Vec3::Zero(), 1.0).cwiseAbs());
    const auto cell = static_cast<std::uint32_t>(round % 8);
    const Corners mapped = mapped_box(*shape->lattice, cell, local, nodes);
    for (int c = 0; c < 8; ++c) {
      const Vec3 at((c & 1) ? local.hi.x() : local.lo.x(), (c & 2) ? local.hi.y() : local.lo.y(),
                    (c & 4) ? local.hi.z() : local.lo.z());
      EXPECT_EQ(mapped[c], map_point(corners_of(*shape->lattice, cell, nodes), at));
    }
  }
}

}  // namespace
}  // namespace contactcheck
