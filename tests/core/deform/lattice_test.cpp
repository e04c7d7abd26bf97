#include "core/deform/lattice.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "core/deform/grid.h"
#include "core/narrow/triangle_box.h"
#include "core/types/check.h"
#include "tests/support/random_triangles.h"
#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

using ::testing::ElementsAre;

TrianglePoints points_of(const TriangleMesh& mesh, const Triangle& t) {
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

// Every cell of the full grid that some triangle or vertex claims, without the range search.
std::vector<GridIndex> kept_by_brute_force(const TriangleMesh& mesh, const Lattice& lattice) {
  const Grid grid(lattice.lines);
  std::vector<GridIndex> kept;
  const auto met = [&](const GridIndex& cell) {
    return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
      return triangle_meets_box(points_of(mesh, t), grid.cell_box(cell));
    });
  };
  for (std::uint32_t z = 0; z + 1 < lattice.lines[2].size(); ++z)
    for (std::uint32_t y = 0; y + 1 < lattice.lines[1].size(); ++y)
      for (std::uint32_t x = 0; x + 1 < lattice.lines[0].size(); ++x)
        if (met({x, y, z})) kept.push_back({x, y, z});
  return kept;
}

std::vector<TriangleMesh> lattice_meshes() {
  std::vector<TriangleMesh> meshes = {test::sphere_mesh({0.3, -20, 7}, 2.0, 2),
                                      test::unit_box_mesh(4),
                                      test::triangle_mesh({0, 0, 0}, {1, 2, 3}, {1, 2, 3.5}),
                                      test::triangle_mesh({1, 1, 1}, {2, 1, 1}, {4, 1, 1})};
  test::TriangleSource random(11);
  TriangleMesh soup;
  for (std::uint32_t t = 0; t < 12; ++t) {
    for (int k = 0; k < 3; ++k) soup.vertices.push_back(random.grid_point(2));
    soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  meshes.push_back(soup);
  return meshes;
}

TEST(Lattice, GridLinesDividePaddedBoxEvenly) {
  const Lattice lattice = make_lattice(test::unit_box_mesh(1), {4, 2, 1}, 0.5);
  EXPECT_THAT(lattice.lines[0], ElementsAre(-0.5, 0.0, 0.5, 1.0, 1.5));
  EXPECT_THAT(lattice.lines[1], ElementsAre(-0.5, 0.5, 1.5));
  EXPECT_THAT(lattice.lines[2], ElementsAre(-0.5, 1.5));
}

TEST(Lattice, FlatMeshGetsCellsOfPositiveSize) {
  const TriangleMesh flat = test::triangle_mesh({0, 0, 5}, {1, 0, 5}, {0, 1, 5});
  const Lattice lattice = make_lattice(flat, {3, 3, 3}, 0.0);
  for (const std::vector<double>& lines : lattice.lines)
    for (std::size_t i = 1; i < lines.size(); ++i) EXPECT_LT(lines[i - 1], lines[i]);
  EXPECT_LT(lattice.lines[2].front(), 5.0);
  EXPECT_GT(lattice.lines[2].back(), 5.0);
}

TEST(Lattice, MeshInOnePointGetsALatticeEvenFarOut) {
  for (double at : {0.0, 3.0, -1e6, 1e12}) {
    const Vec3 p = Vec3::Constant(at);
    const Lattice lattice = make_lattice(test::triangle_mesh(p, p, p), {1, 1, 1}, 0.02);
    EXPECT_EQ(lattice.cells.size(), 1u) << at;
    EXPECT_TRUE(lattice.cell_box(0).contains(p)) << at;
  }
}

TEST(Lattice, ScalesWithItsMesh) {
  for (double scale : {0x1p-60, 0x1p-30, 0x1p30}) {
    TriangleMesh mesh = test::sphere_mesh(Vec3::Zero(), 1.0, 1);
    const Lattice rest = make_lattice(mesh, {4, 5, 3}, 0.02);
    for (Vec3& v : mesh.vertices) v *= scale;
    const Lattice scaled = make_lattice(mesh, {4, 5, 3}, 0.02);
    EXPECT_EQ(scaled.cells, rest.cells) << scale;
    EXPECT_EQ(scaled.lines[0][1], scale * rest.lines[0][1]) << scale;
  }
}

TEST(Lattice, KeptCellsEqualBruteForce) {
  std::size_t kept = 0, all = 0;
  for (const TriangleMesh& mesh : lattice_meshes())
    for (const Resolution& r : {Resolution{1, 1, 1}, Resolution{3, 4, 5}, Resolution{8, 8, 8}})
      for (double padding : {0.02, 0.5}) {
        const Lattice lattice = make_lattice(mesh, r, padding);
        EXPECT_EQ(lattice.cells, kept_by_brute_force(mesh, lattice));
        kept += lattice.cells.size();
        all += std::size_t{r.x} * r.y * r.z;
      }
  // Neither everything nor nothing, or the comparison would say little.
  EXPECT_GT(kept, all / 20);
  EXPECT_LT(kept, all * 3 / 4);
}

TEST(Lattice, CellsTouchedFromOutsideAreKept) {
  // The box's faces lie on grid lines: the cells outside them touch the surface and are kept; the
  // cells of the inside, too, as all of them have a face on the surface.
  const Lattice lattice = make_lattice(test::unit_box_mesh(1), {4, 4, 4}, 0.5);
  EXPECT_EQ(lattice.cells.size(), 64u);
}

TEST(Lattice, VertexWithoutTriangleIsInNoBoxAndNoCell) {
  const TriangleMesh mesh = test::triangle_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  TriangleMesh stray = mesh;
  stray.vertices.push_back({9, 9, 9});
  const Lattice lattice = make_lattice(stray, {5, 5, 5}, 0.02),
                expected = make_lattice(mesh, {5, 5, 5}, 0.02);
  EXPECT_EQ(lattice.lines, expected.lines);
  EXPECT_EQ(lattice.cells, expected.cells);
  const Resolution r = resolution_for_cells(stray, 20, 0.02),
                   e = resolution_for_cells(mesh, 20, 0.02);
  EXPECT_EQ((std::array{r.x, r.y, r.z}), (std::array{e.x, e.y, e.z}));
}

TEST(Lattice, NodesAreTheCornersOfKeptCellsInAscendingOrder) {
  for (const TriangleMesh& mesh : lattice_meshes()) {
    const Lattice lattice = make_lattice(mesh, {3, 5, 4}, 0.02);
    std::set<std::array<std::uint32_t, 3>> corners;  // as (z, y, x)
    for (const GridIndex& c : lattice.cells)
      for (std::uint32_t dz : {0u, 1u})
        for (std::uint32_t dy : {0u, 1u})
          for (std::uint32_t dx : {0u, 1u}) corners.insert({c[2] + dz, c[1] + dy, c[0] + dx});
    ASSERT_EQ(lattice.nodes.size(), corners.size());
    std::size_t n = 0;
    for (const auto& c : corners) EXPECT_EQ(lattice.nodes[n++], (GridIndex{c[2], c[1], c[0]}));
  }
}

TEST(Lattice, CornerIsHighOnAnAxisWhenItsBitIsSet) {
  const Lattice lattice = make_lattice(test::sphere_mesh({5, 6, 7}, 3.0, 1), {3, 4, 5}, 0.1);
  const std::vector<Vec3> nodes = lattice.rest_nodes();
  for (std::uint32_t cell = 0; cell < lattice.cells.size(); ++cell) {
    const Aabb box = lattice.cell_box(cell);
    const Corners corners = corners_of(lattice, cell, nodes);
    for (int c = 0; c < 8; ++c) {
      const Vec3 expected((c & 1) ? box.hi.x() : box.lo.x(), (c & 2) ? box.hi.y() : box.lo.y(),
                          (c & 4) ? box.hi.z() : box.lo.z());
      EXPECT_EQ(lattice.rest_node(lattice.cell_nodes[cell][c]), expected);
      EXPECT_EQ(corners[c], expected);
    }
  }
}

TEST(Lattice, TooFineForDoublesIsRefusedWithTheAxis) {
  const Vec3 far(0, 1e16, 0);
  const TriangleMesh mesh = test::triangle_mesh(far, far + Vec3(1, 0, 0), far + Vec3(0, 2, 1));
  try {
    make_lattice(mesh, {4, 50, 4}, 0.02);
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("50 cells along axis y"));
  }
}

TEST(Lattice, MoreCellsOfAnAxisThanAreMadeAreRefused) {
  for (const std::uint32_t cells : {kMostCellsOfAxis - 1, kMostCellsOfAxis})
    EXPECT_NO_THROW(refuse_fine_resolution({cells, cells, cells}));
  for (const std::uint32_t cells : {kMostCellsOfAxis + 1, ~0u}) {
    EXPECT_THROW(refuse_fine_resolution({cells, 1, 1}), InputError);
    EXPECT_THROW(refuse_fine_resolution({1, cells, 1}), InputError);
    try {
      make_lattice(test::unit_box_mesh(1), {1, 1, cells}, 0.02);
      FAIL() << "no error";
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), ::testing::HasSubstr(std::to_string(cells) + " cells along axis z"));
    }
  }
}

// Its box has 5e8 cells.
TEST(Lattice, NeedleAcrossAFineGridTakesTheTimeOfTheCellsThatItMeets) {
  const Lattice lattice = make_lattice(
      test::triangle_mesh({0, 0, 0}, {1, 0.83, 0.71}, {0.5, 0.42, 0.35}), {1000, 900, 800}, 0.02);
  EXPECT_GT(lattice.cells.size(), 900u);
  EXPECT_LT(lattice.cells.size(), 50'000u);
}

TEST(Lattice, OverflowingMeshIsRefused) {
  const TriangleMesh mesh = test::triangle_mesh({-1.7e308, 0, 0}, {1.7e308, 0, 0}, {0, 1, 0});
  EXPECT_THROW(make_lattice(mesh, {2, 2, 2}, 0.02), InputError);
}

TEST(ResolutionForCells, KeepsAboutTheWantedNumber) {
  const TriangleMesh sphere = test::sphere_mesh({1, 2, 3}, 1.5, 3);
  const TriangleMesh bar = test::box_mesh({0, 0, 0}, {8, 1, 1}, 8);
  for (const TriangleMesh& mesh : {sphere, bar})
    for (std::size_t wanted : {100u, 400u}) {
      const Resolution r = resolution_for_cells(mesh, wanted, 0.02);
      const double kept = static_cast<double>(make_lattice(mesh, r, 0.02).cells.size());
      EXPECT_NEAR(kept / static_cast<double>(wanted), 1.0, 0.3);
    }
}

TEST(ResolutionForCells, GivesNearCubicCellsAtEveryScale) {
  for (double scale : {0x1p-40, 1.0, 0x1p20}) {
    const Resolution r =
        resolution_for_cells(test::box_mesh({0, 0, 0}, Vec3(4, 2, 1) * scale, 4), 60, 0.02);
    EXPECT_EQ(r.x, 7u) << scale;
    EXPECT_EQ(r.y, 4u) << scale;
    EXPECT_EQ(r.z, 2u) << scale;
  }
}

TEST(ResolutionForCells, OneCellIsPossible) {
  const Resolution r = resolution_for_cells(test::unit_box_mesh(2), 1, 0.02);
  EXPECT_EQ(r.x * r.y * r.z, 1u);
}

}  // namespace
}  // namespace contactcheck
