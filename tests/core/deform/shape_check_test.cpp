// Shapes from outside: that embedding and mesh agree is looked at, not believed.
#include "core/deform/shape_check.h"

#include <gmock/gmock.h>

#include <functional>
#include <limits>

#include "tests/support/shapes.h"

namespace contactcheck {
namespace {

using ::testing::HasSubstr;

// A triangle across three cells in a row.
std::string fault_of_bridge_with(const std::function<void(BodyShape&)>& change) {
  const TriangleMesh mesh =
      test::triangle_mesh(Vec3(0.25, 0.5, 0.5), Vec3(2.75, 0.25, 0.5), Vec3(2.75, 0.75, 0.5));
  BodyShape shape = *make_shape_on_lines(mesh, {{{0, 1, 2, 3}, {0, 1}, {0, 1}}});
  change(shape);
  return shape_fault(shape);
}

TEST(ShapeCheck, AcceptsWhatIsMadeHere) {
  EXPECT_EQ(fault_of_bridge_with([](BodyShape&) {}), "");
  for (const double scale : {0x1p-900, 1e-3, 0.1, 1e3, 0x1p900}) {
    TriangleMesh ball = test::sphere_mesh(Vec3(1, 2, 3), 1.0, 3);
    for (Vec3& v : ball.vertices) v *= scale;
    EXPECT_EQ(shape_fault(*make_shape(ball, {7, 5, 3})), "") << scale;
  }
}

// Whoever maps vertices by their local coordinates would deform another mesh.
TEST(ShapeCheck, LocalCoordinatesAreThoseOfTheVertexUpToAFewRoundings) {
  const auto moved_by = [](double distance) {
    return fault_of_bridge_with([&](BodyShape& s) { s.embedding.local[0].x() += distance; });
  };
  EXPECT_EQ(moved_by(0x1p-52), "") << "another order of rounding";
  EXPECT_EQ(moved_by(0x1p-50), "");
  EXPECT_EQ(moved_by(-0x1p-50), "");
  for (const double distance : {0x1p-50 + 0x1p-54, -0x1p-49, 1e-6, 0.5})
    EXPECT_EQ(moved_by(distance),
              "the local coordinates of vertex 0 are not those of its position in its home cell");
}

TEST(ShapeCheck, ATriangleMeetsKeptCellsAloneAndItsLabelNamesThem) {
  EXPECT_EQ(fault_of_bridge_with([](BodyShape& s) {
              s.lattice->cells.erase(s.lattice->cells.begin() + 1);
              s.lattice->cell_nodes.erase(s.lattice->cell_nodes.begin() + 1);
              s.embedding.home_cell = {0, 1, 1};
              s.embedding.label_cells = {0, 1};
              s.embedding.label_begin = {0, 2};
            }),
            "triangle 0 meets cell (1, 0, 0), which is not kept");
  for (const std::uint32_t left_out : {0u, 1u, 2u})
    EXPECT_EQ(fault_of_bridge_with([&](BodyShape& s) {
                s.embedding.label_cells.erase(s.embedding.label_cells.begin() + left_out);
                s.embedding.label_begin = {0, 2};
              }),
              "triangle 0 meets cell (" + std::to_string(left_out) +
                  ", 0, 0), which its label does not name");
  EXPECT_EQ(
      fault_of_bridge_with([](BodyShape& s) {
        // A cell above the first one.
        s.lattice->lines[2] = {0, 1, 2};
        s.lattice->cells.push_back({0, 0, 1});
        for (const std::uint32_t y : {0u, 1u})
          for (const std::uint32_t x : {0u, 1u}) s.lattice->nodes.push_back({x, y, 2});
        const CornerIds& below = s.lattice->cell_nodes[0];
        s.lattice->cell_nodes.push_back({below[4], below[5], below[6], below[7], 16, 17, 18, 19});
        s.embedding.label_cells.push_back(3);
        s.embedding.label_begin = {0, 4};
      }),
      "the label of triangle 0 names cell (0, 0, 1), which it does not meet");
}

TEST(ShapeCheck, LatticeLinesAreNoFartherApartThanTheLargestDouble) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  const auto with_lines = [](double lo, double hi) {
    return fault_of_bridge_with([&](BodyShape& s) {
      s.lattice->lines[1] = {lo, hi};
      for (std::size_t v = 0; v < 3; ++v)
        s.embedding.local[v].y() = (s.mesh.vertices[v].y() - lo) / (hi - lo);
    });
  };
  EXPECT_EQ(with_lines(-kLargest / 2, kLargest / 2), "");
  EXPECT_EQ(with_lines(0, kLargest), "");
  EXPECT_THAT(with_lines(-kLargest, kLargest),
              HasSubstr("two lattice lines of axis 1 are farther apart than the largest double"));
}

}  // namespace
}  // namespace contactcheck
