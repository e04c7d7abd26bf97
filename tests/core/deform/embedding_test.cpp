#include "core/deform/embedding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/narrow/triangle_box.h"
#include "tests/support/random_triangles.h"
#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

// Spheres at small and large offsets, with vertices moved by random ulps onto and off grid lines.
std::vector<TriangleMesh> sample_meshes() {
  std::vector<TriangleMesh> meshes;
  test::TriangleSource random(3);
  for (double offset : {0.0, 1e3, 1e9}) {
    TriangleMesh mesh = test::sphere_mesh(Vec3::Constant(offset), 1.0, 2);
    for (Vec3& v : mesh.vertices) v = random.jitter(v);
    meshes.push_back(mesh);
  }
  meshes.push_back(test::unit_box_mesh(4));
  return meshes;
}

TEST(Embedding, HomeBoxHoldsItsVertexAndLocalsAreInTheUnitCube) {
  for (const TriangleMesh& mesh : sample_meshes())
    for (double padding : {0.0, 0.02, 0.5}) {
      const Lattice lattice = make_lattice(mesh, {4, 5, 6}, padding);
      const Embedding e = embed(mesh, lattice);
      ASSERT_EQ(e.home_cell.size(), mesh.vertices.size());
      for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const Aabb box = lattice.cell_box(e.home_cell[v]);
        EXPECT_TRUE(box.contains(mesh.vertices[v]));
        for (int k = 0; k < 3; ++k) {
          EXPECT_GE(e.local[v][k], 0.0);
          EXPECT_LE(e.local[v][k], 1.0);
          // The ulp of the coordinates, relative to the cell, is the accuracy to be had.
          const double back = box.lo[k] + e.local[v][k] * (box.hi[k] - box.lo[k]);
          EXPECT_NEAR(back, mesh.vertices[v][k], 1e-15 * (1.0 + std::abs(back)));
        }
      }
    }
}

TEST(Embedding, VertexOnASharedFaceBelongsToTheUpperCellAtZero) {
  const TriangleMesh mesh = test::unit_box_mesh(4);            // coordinates are multiples of 1/4
  const Lattice lattice = make_lattice(mesh, {4, 4, 4}, 0.5);  // lines at -1/2, 0, 1/2, 1, 3/2
  const Embedding e = embed(mesh, lattice);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const GridIndex& cell = lattice.cells[e.home_cell[v]];
    for (int k = 0; k < 3; ++k) {
      const double at = (mesh.vertices[v][k] + 0.5) / 0.5;
      EXPECT_EQ(cell[k], static_cast<std::uint32_t>(std::floor(at)));
      EXPECT_EQ(e.local[v][k], at - std::floor(at));  // 0 on the line, 1/2 between
    }
  }
}

TEST(Embedding, VertexOnTheLastLineHasLocalOne) {
  Lattice lattice;
  for (auto& lines : lattice.lines) lines = {0.0, 1.0};
  lattice.cells = {{0, 0, 0}};
  const Embedding e = embed(test::triangle_mesh({0, 0, 0}, {1, 1, 1}, {0, 1, 0.5}), lattice);
  EXPECT_EQ(e.local[0], Vec3(0, 0, 0));
  EXPECT_EQ(e.local[1], Vec3(1, 1, 1));
  EXPECT_EQ(e.local[2], Vec3(0, 1, 0.5));
}

TEST(Embedding, LabelsEqualBruteForce) {
  std::size_t labels = 0, pairs = 0;
  for (const TriangleMesh& mesh : sample_meshes()) {
    const Lattice lattice = make_lattice(mesh, {4, 3, 5}, 0.5);
    const Embedding e = embed(mesh, lattice);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      std::vector<std::uint32_t> expected;
      const Triangle& tri = mesh.triangles[t];
      const TrianglePoints p = {mesh.vertices[tri[0]], mesh.vertices[tri[1]],
                                mesh.vertices[tri[2]]};
      for (std::uint32_t cell = 0; cell < lattice.cells.size(); ++cell)
        if (triangle_meets_box(p, lattice.cell_box(cell))) expected.push_back(cell);
      const auto label = e.cells_of_triangle(t);
      EXPECT_EQ(std::vector(label.begin(), label.end()), expected);
      labels += expected.size();
    }
    pairs += mesh.triangles.size() * lattice.cells.size();
  }
  EXPECT_GT(labels, 1000u);
  EXPECT_LT(labels, pairs / 4);
}

TEST(Embedding, SortedArraysHoldEveryVertexOnceInItsCell) {
  for (const TriangleMesh& mesh : sample_meshes()) {
    const Lattice lattice = make_lattice(mesh, {3, 3, 3}, 0.02);
    const Embedding e = embed(mesh, lattice);
    ASSERT_EQ(e.cell_begin.size(), lattice.cells.size() + 1);
    EXPECT_EQ(e.cell_begin.back(), mesh.vertices.size());
    for (const std::vector<double>& local : e.sorted_local) {
      ASSERT_EQ(local.size(), mesh.vertices.size() + kEmbeddingPadding);
      EXPECT_TRUE(std::all_of(local.end() - kEmbeddingPadding, local.end(),
                              [](double padding) { return padding == 0.0; }));
    }
    std::vector<std::uint32_t> order = e.cell_order;
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> all(mesh.vertices.size());
    std::iota(all.begin(), all.end(), 0u);
    EXPECT_EQ(order, all);
    for (std::uint32_t cell = 0; cell < lattice.cells.size(); ++cell)
      for (std::uint32_t i = e.cell_begin[cell]; i < e.cell_begin[cell + 1]; ++i) {
        EXPECT_EQ(e.home_cell[e.cell_order[i]], cell);
        for (int k = 0; k < 3; ++k) EXPECT_EQ(e.sorted_local[k][i], e.local[e.cell_order[i]][k]);
      }
  }
}

}  // namespace
}  // namespace contactcheck
