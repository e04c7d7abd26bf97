// The mapping in single precision.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "core/deform/body.h"
#include "core/deform/mapping.h"
#include "tests/core/deform/scoped_target.h"
#include "tests/support/random_triangles.h"
#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

using SingleCorners = CornersOf<float>;

std::vector<Vec3f> random_single_nodes(test::TriangleSource& random, std::size_t count,
                                       double radius) {
  std::vector<Vec3f> nodes;
  for (std::size_t i = 0; i < count; ++i)
    nodes.push_back(random.point(Vec3::Zero(), radius).cast<float>());
  return nodes;
}

SingleCorners corners_of_cell(const Lattice& lattice, std::uint32_t cell,
                              const std::vector<Vec3f>& nodes) {
  SingleCorners corners;
  for (int c = 0; c < 8; ++c) corners[c] = nodes[lattice.cell_nodes[cell][c]];
  return corners;
}

bool same_bits(const Vec3f& a, const Vec3f& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

TEST(SingleMapping, BatchGivesTheBitsOfThePointVersion) {
  const auto shape = make_shape(test::sphere_mesh(Vec3::Zero(), 1.0, 3), {5, 4, 3});
  const SingleLocal local = single_local(shape->embedding);
  for (std::int64_t target : test::compiled_targets()) {
    const test::ScopedTarget scope(target);
    test::TriangleSource random(21);
    for (double radius : {1e-38, 1e-9, 1.0, 1e6, 1e12}) {
      const std::vector<Vec3f> nodes = random_single_nodes(random, shape->node_count(), radius);
      std::vector<Vec3f> mapped(shape->mesh.vertices.size(), Vec3f::Constant(-7.0f));
      map_vertices(*shape->lattice, shape->embedding, local, nodes, mapped);
      std::size_t different = 0;
      for (std::size_t v = 0; v < mapped.size(); ++v) {
        const Vec3f place = shape->embedding.local[v].cast<float>();
        const std::uint32_t home = shape->embedding.home_cell[v];
        different +=
            !same_bits(mapped[v], map_point(corners_of_cell(*shape->lattice, home, nodes), place));
      }
      EXPECT_EQ(different, 0u) << simd_target() << " " << radius;
    }
  }
}

std::vector<LocalBoxOf<float>> random_single_boxes(test::TriangleSource& random,
                                                   std::size_t cells) {
  std::vector<LocalBoxOf<float>> boxes(60);
  for (LocalBoxOf<float>& box : boxes) {
    box.home = static_cast<std::uint32_t>(random.below(static_cast<int>(cells)));
    for (int corner = 0; corner < 2; ++corner)
      box.local.extend(Vec3f(random.point(Vec3::Zero(), 1.0).cwiseAbs().cast<float>()));
  }
  return boxes;
}

TEST(SingleMapping, BoxesGiveTheBitsOfThePointVersion) {
  const auto shape = make_shape(test::sphere_mesh(Vec3::Zero(), 1.0, 1), {4, 4, 4});
  for (std::int64_t target : test::compiled_targets()) {
    const test::ScopedTarget scope(target);
    test::TriangleSource random(26);
    const auto boxes = random_single_boxes(random, shape->lattice->cells.size());
    const auto nodes = random_single_nodes(random, shape->node_count(), 1.0);
    std::vector<SingleCorners> mapped(boxes.size());
    map_boxes(*shape->lattice, boxes, nodes, mapped);
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (int c = 0; c < 8; ++c) {
        Vec3f place;
        for (int k = 0; k < 3; ++k)
          place[k] = (c >> k & 1) ? boxes[i].local.hi[k] : boxes[i].local.lo[k];
        const SingleCorners corners = corners_of_cell(*shape->lattice, boxes[i].home, nodes);
        EXPECT_TRUE(same_bits(mapped[i][c], map_point(corners, place))) << simd_target();
      }
  }
}

// The largest error in shares of the bound; doubles stand for exact numbers.
double largest_single_error_share(test::TriangleSource& random, const Vec3& center, double radius) {
  double worst = 0.0;
  for (int round = 0; round < 3000; ++round) {
    SingleCorners corners;
    Corners exact;
    float largest = 0.0f;
    for (int c = 0; c < 8; ++c) {
      corners[c] = random.point(center, radius).cast<float>();
      exact[c] = corners[c].cast<double>();
      largest = std::max(largest, corners[c].cwiseAbs().maxCoeff());
    }
    const Vec3f place = random.point(Vec3::Zero(), 1.0).cwiseAbs().cast<float>();
    const Vec3 error =
        map_point(corners, place).cast<double>() - map_point(exact, Vec3(place.cast<double>()));
    worst = std::max(worst, error.cwiseAbs().maxCoeff() / mapping_error_bound(largest));
  }
  return worst;
}

TEST(SingleMapping, ErrorStaysWithinItsBound) {
  test::TriangleSource random(24);
  for (double radius : {1e-2, 1.0, 1e9})
    for (double offset : {0.0, 1.0, -1e12}) {
      const double share = largest_single_error_share(random, Vec3::Constant(offset), radius);
      EXPECT_LE(share, 1.0) << radius << " " << offset;
      EXPECT_GT(share, 0.05) << radius << " " << offset;
    }
  for (double radius : {0x1p-149, 0x1p-140, 0x1p-126})
    EXPECT_LE(largest_single_error_share(random, Vec3::Zero(), radius), 1.0) << radius;
}

}  // namespace
}  // namespace contactcheck
