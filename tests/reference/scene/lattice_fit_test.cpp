// Lattices fitted to recorded vertices.
#include "reference/scene/lattice_fit.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "tests/support/shapes.h"

namespace contactcheck::scene {
namespace {

using test::sphere_mesh;

std::shared_ptr<const BodyShape> ball(std::uint32_t cells) {
  return make_shape(sphere_mesh(Vec3::Zero(), 0.5, 4), {cells, cells, cells});
}

std::vector<Vec3> mapped(const BodyShape& shape, const std::vector<Vec3>& nodes) {
  std::vector<Vec3> out(shape.mesh.vertices.size());
  map_body(shape, nodes, out);
  return out;
}

// Bent, twisted and far away: what a lattice did, a lattice can do.
std::vector<Vec3> deformed_nodes(const BodyShape& shape) {
  Motion motion;
  motion.deformers = {Bend{1, 0, {{{0.0, 50.0}}}}, Twist{2, {{{0.0, 30.0}}}}};
  motion.path.spins = {{Vec3(1, 2, 3), {{{0.0, 140.0}}}}};
  for (int k = 0; k < 3; ++k) motion.path.position[k].keys = {{0.0, 3.0 - 2.0 * k}};
  return nodes_at(shape, motion, 0.0);
}

double largest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double out = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) out = std::max(out, (a[i] - b[i]).norm());
  return out;
}

TEST(LatticeFit, RecoversALatticeThatMadeTheFrame) {
  for (const std::uint32_t cells : {1u, 3u, 5u}) {
    SCOPED_TRACE(cells);
    const auto shape = ball(cells);
    const std::vector<Vec3> nodes = deformed_nodes(*shape), frame = mapped(*shape, nodes);
    FitError error;
    const auto fitted = LatticeFit(*shape, 1e-12).fitted(frame, error);
    EXPECT_LT(largest_distance(mapped(*shape, fitted), frame), 1e-12);
    EXPECT_LT(error.max.at(0), 1e-12);
    EXPECT_LE(error.rms.at(0), error.max.at(0));
  }
}

// Few vertices see a corner node: with the usual smoothing it follows, and the surface hardly
// cares.
TEST(LatticeFit, WithTheUsualSmoothingIsWithinAHundredthOfAPercent) {
  const auto shape = ball(5);
  const std::vector<Vec3> nodes = deformed_nodes(*shape), frame = mapped(*shape, nodes);
  FitError error;
  const auto fitted = LatticeFit(*shape, 1e-6).fitted(frame, error);
  EXPECT_LT(error.max.at(0), 1e-4);
  EXPECT_LT(largest_distance(fitted, nodes), 0.1) << "no node may fly away";
}

TEST(LatticeFit, FollowsARigidMotionWithAllNodes) {
  const auto shape = ball(4);
  Motion motion;
  motion.path.spins = {{Vec3(0, 1, 1), {{{0.0, 170.0}}}}};
  for (int k = 0; k < 3; ++k) motion.path.position[k].keys = {{0.0, 5.0}};
  const std::vector<Vec3> nodes = nodes_at(*shape, motion, 0.0);
  FitError error;
  EXPECT_LT(largest_distance(LatticeFit(*shape, 1e-6).fitted(mapped(*shape, nodes), error), nodes),
            1e-11);
}

TriangleMesh flat_sheet() {
  TriangleMesh sheet;
  for (int j = 0; j <= 8; ++j)
    for (int i = 0; i <= 8; ++i) sheet.vertices.emplace_back(i / 8.0, j / 8.0, 0.0);
  for (std::uint32_t j = 0; j < 8; ++j)
    for (std::uint32_t i = 0; i < 8; ++i) {
      const std::uint32_t a = 9 * j + i;
      sheet.triangles.push_back({a, a + 1, a + 10});
      sheet.triangles.push_back({a, a + 10, a + 9});
    }
  return sheet;
}

// In one layer of cells nothing but the pose says where the nodes above and below a sheet are.
TEST(LatticeFit, OfAFlatSheetStaysAsThickAsItWas) {
  const TriangleMesh sheet = flat_sheet();
  const auto shape = make_shape(sheet, {3, 3, 1});
  std::vector<Vec3> frame;
  for (const Vec3& v : sheet.vertices) frame.emplace_back(v.z() + 2.0, v.x(), v.y());
  FitError error;
  const auto nodes = LatticeFit(*shape, 1e-6).fitted(frame, error);
  EXPECT_LT(error.max.at(0), 1e-12);
  const double thick = bounding_box(shape->lattice->rest_nodes()).extent().z();
  EXPECT_NEAR(bounding_box(nodes).extent().x(), thick, 1e-9);
}

// To a sheet, a half turn about an axis in its plane is what a reflection is: only the pose says
// that the nodes above come to lie below.
TEST(LatticeFit, OfASheetThatIsTurnedOverTurnsAllNodesOver) {
  const TriangleMesh sheet = flat_sheet();
  const auto shape = make_shape(sheet, {3, 3, 1});
  for (const Vec3& signs : {Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)}) {
    SCOPED_TRACE(signs.transpose());
    std::vector<Vec3> frame, nodes;
    for (const Vec3& v : sheet.vertices) frame.emplace_back(v.cwiseProduct(signs));
    for (const Vec3& n : shape->lattice->rest_nodes()) nodes.emplace_back(n.cwiseProduct(signs));
    FitError error;
    EXPECT_LT(largest_distance(LatticeFit(*shape, 1e-6).fitted(frame, error), nodes), 1e-9);
  }
}

// A bar with vertices at its two ends alone is stretched to twice its length, which no pose does:
// what is between is stretched as well.
TEST(LatticeFit, NodesWithoutVerticesFollowTheirNeighbours) {
  TriangleMesh bar;
  for (int c = 0; c < 8; ++c) bar.vertices.emplace_back(c & 1 ? 5 : -5, c >> 1 & 1, c >> 2 & 1);
  bar.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                   {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  const auto shape = make_shape(bar, {10, 1, 1});
  const Vec3 stretch(2, 1, 1);
  std::vector<Vec3> frame, nodes;
  for (const Vec3& v : bar.vertices) frame.emplace_back(v.cwiseProduct(stretch));
  for (const Vec3& n : shape->lattice->rest_nodes()) nodes.emplace_back(n.cwiseProduct(stretch));
  FitError error;
  EXPECT_LT(largest_distance(LatticeFit(*shape, 1e-6).fitted(frame, error), nodes), 0.2);
}

// The least squares: no other nodes near the fitted ones come nearer to a frame that no lattice
// made. Errors are those of the canonical mapping.
TEST(LatticeFit, IsALeastSquaresSolutionAndTellsItsError) {
  const auto shape = ball(2);
  std::vector<Vec3> frame = shape->mesh.vertices;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> noise(-0.02, 0.02);
  for (Vec3& v : frame) v += Vec3(noise(random), noise(random), noise(random));
  FitError error;
  const auto nodes = LatticeFit(*shape, 1e-9).fitted(frame, error);
  const auto squares = [&](const std::vector<Vec3>& with) {
    const auto at = mapped(*shape, with);
    double sum = 0.0;
    for (std::size_t i = 0; i < at.size(); ++i) sum += (at[i] - frame[i]).squaredNorm();
    return sum;
  };
  const double least = squares(nodes);
  EXPECT_NEAR(error.rms.at(0), std::sqrt(least / static_cast<double>(frame.size())), 1e-12);
  EXPECT_NEAR(error.max.at(0), largest_distance(mapped(*shape, nodes), frame), 1e-15);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (const double step : {-1e-3, 1e-3}) {
      std::vector<Vec3> other = nodes;
      other[n].y() += step;
      EXPECT_GE(squares(other), least - 1e-9) << n;
    }
}

TEST(LatticeFit, AppendsOneErrorPerFrame) {
  const auto shape = ball(3);
  FitError error;
  const LatticeFit fit(*shape, 1e-6);
  fit.fitted(shape->mesh.vertices, error);
  fit.fitted(mapped(*shape, deformed_nodes(*shape)), error);
  EXPECT_EQ(error.max.size(), 2u);
  EXPECT_EQ(error.rms.size(), 2u);
}

}  // namespace
}  // namespace contactcheck::scene
