// The smallest distance of all bodies of a frame.
#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <limits>

#include "reference/oracle/oracle.h"
#include "tests/reference/oracle/meshes.h"
#include "tests/support/random_triangles.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {
namespace {

constexpr double kWidth = 1e-9;  // of the largest coordinate

/// Small spheres, each at a place of its own.
class Spheres {
 public:
  explicit Spheres(std::size_t count) {
    const auto shape = make_bare_shape(sphere_mesh(Vec3::Zero(), 0.1, 1));
    for (std::size_t i = 0; i < count; ++i) bodies_.push_back({"sphere", shape});
  }
  const std::vector<Body>& bodies() const { return bodies_; }
  FrameData at(const std::vector<Vec3>& places) const {
    std::vector<std::vector<Vec3>> nodes;
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      nodes.push_back(rest_nodes_at(*bodies_[i].shape, places[i]));
    return make_frame(bodies_, std::move(nodes));
  }

 private:
  std::vector<Body> bodies_;
};

oracle::DistanceInterval least_of_all_pairs(oracle::Oracle& oracle, const Frame& frame) {
  oracle::DistanceInterval least{std::numeric_limits<double>::infinity(),
                                 std::numeric_limits<double>::infinity()};
  for (std::uint32_t a = 0; a < frame.bodies.size(); ++a)
    for (std::uint32_t b = a + 1; b < frame.bodies.size(); ++b) {
      const oracle::DistanceInterval d = oracle.distance(frame, {a, b});
      least.lower = std::min(least.lower, d.lower);
      least.upper = std::min(least.upper, d.upper);
    }
  return least;
}

double largest_coordinate(const FrameData& data) {
  double largest = 0.0;
  for (const auto& vertices : data.vertices)
    for (const Vec3& p : vertices) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  return largest;
}

void expect_same_distance(const oracle::DistanceInterval& found,
                          const oracle::DistanceInterval& expected, double scale) {
  EXPECT_EQ(found.upper == 0, expected.upper == 0);
  EXPECT_LE(found.lower, expected.upper);
  EXPECT_GE(found.upper, expected.lower);
  EXPECT_LE(found.upper - found.lower, kWidth * scale);
}

TEST(Separation, IsTheSmallestDistanceOfAllPairs) {
  const Spheres spheres(9);
  TriangleSource source(811);
  oracle::Oracle oracle(spheres.bodies());
  int contacts = 0;
  for (int i = 0; i < 30; ++i) {
    std::vector<Vec3> places;
    for (int k = 0; k < 9; ++k) places.push_back(source.point(Vec3::Zero(), 0.6));
    const FrameData data = spheres.at(places);
    const oracle::DistanceInterval expected = least_of_all_pairs(oracle, data.frame());
    expect_same_distance(oracle.separation(data.frame()), expected, largest_coordinate(data));
    if (expected.upper == 0) ++contacts;
  }
  EXPECT_GT(contacts, 0);
  EXPECT_LT(contacts, 30);
}

// Nearest boxes are not nearest bodies: the boxes of a slanted edge and a corner overlap.
TEST(Separation, LooksBeyondTheNearestBoxes) {
  const std::vector<Body> bodies{
      {"slanted", make_bare_shape(triangle_mesh({0, 0, 0}, {4, 4, 0}, {4, 4.5, 0}))},
      {"in its box", make_bare_shape(triangle_mesh({3, 0, 0}, {3.5, 0, 0}, {3, 0, 0.5}))},
      {"near", make_bare_shape(triangle_mesh({3.75, 0, 0}, {4.5, 0, 0}, {4.5, 0, 0.5}))}};
  std::vector<std::vector<Vec3>> nodes;
  for (const Body& body : bodies) nodes.push_back(rest_nodes_at(*body.shape, Vec3::Zero()));
  const FrameData data = make_frame(bodies, std::move(nodes));
  const oracle::DistanceInterval found = oracle::Oracle(bodies).separation(data.frame());
  EXPECT_LE(found.lower, 0.25);
  EXPECT_NEAR(found.upper, 0.25, 5e-9);
}

TEST(Separation, OfAGridOfEqualGaps) {
  const Spheres spheres(27);
  std::vector<Vec3> places;
  for (int i = 0; i < 27; ++i)
    places.push_back(0.25 * Vec3(i % 3, i / 3 % 3, static_cast<double>(i / 9)));
  const FrameData data = spheres.at(places);
  oracle::Oracle oracle(spheres.bodies());
  expect_same_distance(oracle.separation(data.frame()), least_of_all_pairs(oracle, data.frame()),
                       largest_coordinate(data));
}

TEST(Separation, OneStepBetweenDoublesIsNoContact) {
  const double next = std::nextafter(1.0, 2.0);
  for (const double x : {1.0, next}) {
    const std::vector<Body> bodies{
        {"a", make_bare_shape(unit_box_mesh(1))},
        {"b", make_bare_shape(box_mesh(Vec3(x, 0, 0), Vec3(2, 1, 1), 1))},
        {"c", make_bare_shape(box_mesh(Vec3(3, 0, 0), Vec3(4, 1, 1), 1))}};
    std::vector<std::vector<Vec3>> nodes;
    for (const Body& body : bodies) nodes.push_back(rest_nodes_at(*body.shape, Vec3::Zero()));
    const FrameData data = make_frame(bodies, std::move(nodes));
    EXPECT_EQ(oracle::Oracle(bodies).separation(data.frame()).upper == 0, x == 1.0);
  }
}

TEST(Separation, RoundingModeDoesNotChangeIt) {
  const Spheres spheres(4);
  const FrameData data =
      spheres.at({Vec3(0, 0, 0), Vec3(0.31, 0.1, 0.2), Vec3(0.9, 0.3, 0.1), Vec3(0.1, 0.8, 0.3)});
  oracle::Oracle oracle(spheres.bodies());
  const oracle::DistanceInterval expected = oracle.separation(data.frame());
  for (int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const oracle::DistanceInterval again = oracle.separation(data.frame());
    EXPECT_EQ(std::fegetround(), mode);
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(again.lower, expected.lower);
    EXPECT_EQ(again.upper, expected.upper);
  }
}

}  // namespace
}  // namespace contactcheck::test
