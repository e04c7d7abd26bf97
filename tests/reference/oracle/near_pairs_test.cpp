#include "reference/oracle/vertex_queries.h"

#include <gmock/gmock.h>
#include <gmpxx.h>

#include <cfenv>
#include <cmath>

#include "reference/oracle/oracle.h"
#include "reference/oracle/rational_geometry.h"
#include "reference/oracle/vertex_distance.h"
#include "tests/reference/oracle/meshes.h"
#include "tests/support/shapes.h"

namespace contactcheck::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Corners3 = oracle::TriangleCorners;

FrameData frame_of(const std::vector<std::vector<Vec3>>& vertices) { return {vertices, vertices}; }

double next_up(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }

// The least of a convex quadratic over barycentric coordinates, from the definition: inside by
// Cramer's rule, else on an edge. Squared distance, exact.
class RationalDistance {
 public:
  RationalDistance(const Vec3& vertex, const Corners3& t) {
    const oracle::rational::Point v = oracle::rational::to_rational(vertex);
    for (std::size_t k = 0; k < 3; ++k) {
      corner_[k] = oracle::rational::to_rational(t[k]);
      for (std::size_t axis = 0; axis < 3; ++axis) corner_[k][axis] -= v[axis];
    }
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) gram_[i][j] = dot(corner_[i], corner_[j]);
  }

  mpq_class squared() const {
    mpq_class best = gram_[0][0];
    for (std::size_t k = 0; k < 3; ++k) lower(best, on_edge(k, (k + 1) % 3));
    // Of p = sum w_k corner_k with sum w_k = 1: stationary where all gram_k . w agree.
    const mpq_class a = form(1, 1), b = form(1, 2), c = form(2, 2), det = a * c - b * b;
    if (det == 0) return best;
    const mpq_class f = gram_[0][0] - gram_[0][1], g = gram_[0][0] - gram_[0][2];
    const mpq_class s = (c * f - b * g) / det, r = (a * g - b * f) / det;
    if (s >= 0 && r >= 0 && s + r <= 1) lower(best, gram_[0][0] - s * f - r * g);
    return best;
  }

 private:
  static mpq_class dot(const oracle::rational::Point& a, const oracle::rational::Point& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  static void lower(mpq_class& best, const mpq_class& x) {
    if (x < best) best = x;
  }
  // (corner_i - corner_0) . (corner_j - corner_0)
  mpq_class form(std::size_t i, std::size_t j) const {
    return gram_[i][j] - gram_[i][0] - gram_[0][j] + gram_[0][0];
  }
  mpq_class on_edge(std::size_t i, std::size_t j) const {
    const mpq_class length2 = gram_[i][i] - 2 * gram_[i][j] + gram_[j][j];
    const mpq_class along = gram_[i][i] - gram_[i][j];
    if (length2 == 0 || along <= 0) return gram_[i][i];
    if (along >= length2) return gram_[j][j];
    return gram_[i][i] - along * along / length2;
  }

  std::array<oracle::rational::Point, 3> corner_;
  std::array<std::array<mpq_class, 3>, 3> gram_;
};

struct BruteForce {
  std::vector<NearPair> near;
  std::size_t equal = 0;  // pairs at the margin exactly
};

// `own`: of each body with itself; else of each with the others.
BruteForce brute_force(const std::vector<Body>& bodies, const FrameData& data, double margin,
                       bool own = false) {
  const mpq_class squared_margin = mpq_class(margin) * mpq_class(margin);
  BruteForce out;
  for (std::uint32_t b = 0; b < bodies.size(); ++b)
    for (std::uint32_t o = 0; o < bodies.size(); ++o)
      for (std::uint32_t v = 0; (b == o) == own && v < data.vertices[b].size(); ++v)
        for (std::uint32_t t = 0; t < bodies[o].shape->mesh.triangles.size(); ++t) {
          const Triangle& i = bodies[o].shape->mesh.triangles[t];
          if (own && (v == i[0] || v == i[1] || v == i[2])) continue;
          const std::vector<Vec3>& p = data.vertices[o];
          const mpq_class squared =
              RationalDistance(data.vertices[b][v], {p[i[0]], p[i[1]], p[i[2]]}).squared();
          if (squared < squared_margin) out.near.push_back({b, o, v, t});
          out.equal += squared == squared_margin;
        }
  return out;
}

std::string described(const std::vector<NearPair>& pairs) {
  std::ostringstream out;
  for (const NearPair& p : pairs)
    out << p.body << ' ' << p.other << ' ' << p.vertex << ' ' << p.triangle << '\n';
  return out.str();
}

// Few triangles, but of every kind: closed, a segment and points among them.
std::vector<Body> small_bodies() {
  TriangleMesh odd = box_mesh(Vec3(-0.3, -0.3, -0.3), Vec3(0.3, 0.4, 0.2), 1);
  odd.vertices.insert(odd.vertices.end(), {Vec3(0.5, 0.1, 0), Vec3(0, 0.6, 0), Vec3(0, 0, 0.5)});
  odd.triangles.insert(odd.triangles.end(), {{8, 0, 8}, {9, 9, 9}, {10, 10, 10}});
  const Body ball = test::bare_body("ball", sphere_mesh(Vec3::Zero(), 0.5, 1));
  return {ball, test::bare_body("odd", odd), {"again", ball.shape}};
}

FrameData random_frame(const std::vector<Body>& bodies, TriangleSource& source) {
  std::vector<std::vector<Vec3>> vertices;
  for (const Body& body : bodies) {
    const auto turned =
        moved(body.shape->mesh.vertices, random_rotation(source), source.point(Vec3::Zero(), 0.5));
    vertices.emplace_back();
    for (const Vec3& p : turned) vertices.back().push_back(source.point(p, 0.05));
  }
  return frame_of(vertices);
}

TEST(RationalDistanceOfTheTest, AgreesWithTheSimplexMethod) {
  TriangleSource source(801);
  for (int i = 0; i < 150; ++i) {
    const Corners3 t = source.grid_triangle(2);
    const Vec3 v = source.grid_point(3);
    EXPECT_EQ(RationalDistance(v, t).squared(), oracle::rational::squared_distance(t, {v, v, v}))
        << hex_points(t) << hex_points({&v, 1});
  }
}

TEST(NearAgainstRational, RandomMeshesWithThemselves) {
  const std::vector<Body> bodies = small_bodies();
  oracle::Oracle oracle(bodies);
  TriangleSource source(804);
  std::size_t found = 0;
  for (const double margin : {0.05, 0.2, 0.4})
    for (int i = 0; i < 2; ++i) {
      const FrameData data = random_frame(bodies, source);
      const std::vector<NearPair> near = oracle.self_near(data.frame(), margin);
      EXPECT_EQ(near, brute_force(bodies, data, margin, true).near) << "margin " << margin;
      found += near.size();
    }
  EXPECT_GT(found, 300u);
  EXPECT_LT(found, 8000u);
}

// Two triangles with corners of their own at one place: welded, a vertex of the one is no neighbour
// of the other, but its own.
TEST(SelfNear, AVertexIsNotNearWhatItIsWeldedTo) {
  const TriangleMesh seam{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(-0.0, 0, 0),
                           Vec3(0, -1, 0), Vec3(-1, 0, 0)},
                          {{0, 1, 2}, {3, 4, 5}}};
  const Body open = bare_body("seam", seam);
  const Body joined{"welded", welded(*open.shape)};
  const FrameData data = frame_of({seam.vertices});
  EXPECT_THAT(oracle::Oracle({open}).self_near(data.frame(), 0.1),
              ElementsAre(NearPair{0, 0, 0, 1}, NearPair{0, 0, 3, 0}));
  EXPECT_THAT(oracle::Oracle({joined}).self_near(data.frame(), 0.1), IsEmpty());
  EXPECT_THAT(oracle::Oracle({joined}).self_near(data.frame(), 1.1), testing::Not(IsEmpty()));
  EXPECT_THAT(oracle::Oracle({open}).self_near(data.frame(), 0.0), IsEmpty());
}

TEST(NearAgainstRational, RandomMeshesAllPairs) {
  const std::vector<Body> bodies = small_bodies();
  oracle::Oracle oracle(bodies);
  TriangleSource source(802);
  std::size_t found = 0;
  for (double margin : {1e-3, 0.02, 0.1, 0.4}) {
    for (int i = 0; i < 2; ++i) {
      const FrameData data = random_frame(bodies, source);
      const std::vector<NearPair> near = oracle.near(data.frame(), margin);
      EXPECT_EQ(near, brute_force(bodies, data, margin).near) << "margin " << margin;
      found += near.size();
    }
  }
  EXPECT_GT(found, 500u);
  EXPECT_LT(found, 8000u);
}

// Integer coordinates: distances of 1, 2, 3 and 5 that are the margin exactly are common, and so
// are degenerate triangles.
class NearOnAGrid : public testing::Test {
 protected:
  // `count` triangles of their own corners.
  static TriangleMesh soup(TriangleSource& source, std::uint32_t count) {
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < 3 * count; ++i) mesh.vertices.push_back(source.grid_point(4));
    for (std::uint32_t i = 0; i < count; ++i)
      mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    return mesh;
  }

  // Both the coordinates and the margins times a power of two, and moved: the same pairs.
  void compare(double scale, const Vec3& offset, int frames) {
    TriangleSource source(803);
    for (int i = 0; i < frames; ++i) {
      const std::vector<Body> bodies{test::bare_body("a", soup(source, 5)),
                                     test::bare_body("b", soup(source, 6))};
      std::vector<std::vector<Vec3>> vertices;
      for (const Body& body : bodies)
        vertices.push_back(
            scaled(moved(body.shape->mesh.vertices, Eigen::Matrix3d::Identity(), offset), scale));
      const FrameData data = frame_of(vertices);
      for (double margin : {1.0, 2.0, 3.0, 5.0}) {
        const auto near = oracle::Oracle(bodies).near(data.frame(), margin * scale);
        const BruteForce expected = brute_force(bodies, data, margin * scale);
        EXPECT_EQ(near, expected.near) << "margin " << margin << " scale " << scale << '\n'
                                       << described(near) << "expected\n"
                                       << described(expected.near);
        found_ += near.size();
        equal_ += expected.equal;
      }
    }
  }

  std::size_t found_ = 0, equal_ = 0;
};

TEST_F(NearOnAGrid, MarginsThatEqualADistanceAreStrict) {
  compare(1.0, Vec3::Zero(), 4);
  EXPECT_GT(found_, 800u);
  EXPECT_GT(equal_, 25u);
}

TEST_F(NearOnAGrid, FarFromTheOrigin) {
  compare(1.0, Vec3(0x1p+50, -0x1p+50, 0x1p+49), 4);
  EXPECT_GT(found_, 800u);
  EXPECT_GT(equal_, 25u);
}

// Squares underflow, coordinates are subnormal, squares overflow, differences overflow.
TEST_F(NearOnAGrid, EveryScaleOfDoubles) {
  for (double scale : {0x1p-1074, 0x1p-530, 0x1p-199, 0x1p+199, 0x1p+1021}) {
    found_ = equal_ = 0;
    if (scale < 0x1p+1000) {
      compare(scale, Vec3::Zero(), 1);
    } else {
      // The largest multiple that is finite is 7; 4 - (-4) overflows.
      compare(0x1p+1020, Vec3(3, 3, 3), 1);
      compare(0x1.8p+1021, Vec3::Zero(), 1);
    }
    EXPECT_GT(found_, 150u) << scale;
    EXPECT_GT(equal_, 5u) << scale;
  }
}

// The nearest point is on the face, on an edge, at a corner; the distance is 5 of 3-4-5, exactly.
TEST(Near, PythagoreanDistanceIsNearOnlyAboveIt) {
  const Vec3 to(3, 4, 0), side(-4, 3, 0), up(0, 0, 1);
  const Corners3 face{to + 2 * side - up, to - 2 * side - up, to + 3 * up};
  const Corners3 edge{to + side, to - side, 3 * to};
  const Corners3 corner{to, to + to + up, to + to - up};
  const Corners3 segment{to + side, to, to - 2 * side};
  const Corners3 point{to, to, to};
  for (const Corners3& t : {face, edge, corner, segment, point}) {
    const Body a = test::bare_body("a", {{Vec3::Zero(), Vec3(-50, 0, 0)}, {{0, 1, 1}}});
    const Body b = test::bare_body("b", {{t[0], t[1], t[2]}, {{0, 1, 2}}});
    const FrameData data =
        frame_of({{Vec3::Zero(), Vec3(-50, 0, 0)}, std::vector<Vec3>(t.begin(), t.end())});
    oracle::Oracle oracle({a, b});
    EXPECT_THAT(oracle.near(data.frame(), 5.0), IsEmpty()) << hex_points(t);
    EXPECT_THAT(oracle.near(data.frame(), next_up(5.0)), testing::Contains(NearPair{0, 1, 0, 0}))
        << hex_points(t);
  }
}

// The gap of the boxes rounds to the margin from above and from below.
TEST(Near, BoxGapsThatRoundToTheMargin) {
  const auto is_near = [](double x, double margin) {
    const Vec3 v(x, 0, 0), t(1, 0, 0);
    std::vector<NearPair> out;
    const TriangleMesh mesh = triangle_mesh(t, t + Vec3(0, 1, 0), t + Vec3(0, 0, 1));
    oracle::SurfaceTree tree(mesh);
    tree.refit(mesh.vertices);
    oracle::append_near_pairs({0, 1}, {&v, 1}, tree, margin, out);
    return out.size() == 1;
  };
  EXPECT_FALSE(is_near(0, 1));
  EXPECT_FALSE(is_near(-0x1p-80, 1));  // 1 + 2^-80 rounds to 1
  EXPECT_TRUE(is_near(0x1p-80, 1));    // 1 - 2^-80 does too
  EXPECT_TRUE(is_near(-0x1p-80, next_up(1)));
}

TEST(Near, TouchingIsNearForEveryMarginButZero) {
  const TriangleMesh one = triangle_mesh(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  const TriangleMesh other =
      triangle_mesh(Vec3(0.25, 0.25, 0), Vec3(0.25, 0.25, 1), Vec3(0.5, 0.5, 1));
  const std::vector<Body> bodies{test::bare_body("a", one), test::bare_body("b", other)};
  const FrameData data = frame_of({one.vertices, other.vertices});
  oracle::Oracle oracle(bodies);
  EXPECT_THAT(oracle.near(data.frame(), 0.0), IsEmpty());
  EXPECT_THAT(oracle.near(data.frame(), 0x1p-1074), ElementsAre(NearPair{1, 0, 0, 0}));
}

TEST(Near, VerticesOfPointsCountAndOwnTrianglesDoNot) {
  TriangleMesh mesh = triangle_mesh(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  mesh.vertices.push_back(Vec3(10, 0, 0));
  mesh.triangles.push_back({3, 3, 3});
  const TriangleMesh far = triangle_mesh(Vec3(10, 0, 1), Vec3(11, 0, 1), Vec3(10, 1, 1));
  const std::vector<Body> bodies{test::bare_body("a", mesh), test::bare_body("b", far)};
  const FrameData data = frame_of({mesh.vertices, far.vertices});
  oracle::Oracle oracle(bodies);
  EXPECT_THAT(oracle.near(data.frame(), 1.5),
              ElementsAre(NearPair{0, 1, 3, 0}, NearPair{1, 0, 0, 1}, NearPair{1, 0, 1, 1},
                          NearPair{1, 0, 2, 1}));
}

TEST(Near, FramesAndOtherQuestionsLeaveNoTrace) {
  const std::vector<Body> bodies = small_bodies();
  TriangleSource source(804);
  oracle::Oracle used(bodies);
  for (int i = 0; i < 5; ++i) {
    const FrameData data = random_frame(bodies, source);
    used.judge(data.frame(), {});
    used.distance(data.frame(), {0, 2});
    EXPECT_EQ(used.near(data.frame(), 0.05), oracle::Oracle(bodies).near(data.frame(), 0.05));
    EXPECT_EQ(used.judge(data.frame(), {}).surface.triangles,
              oracle::Oracle(bodies).judge(data.frame(), {}).surface.triangles);
  }
}

TEST(Near, RoundingModeDoesNotChangeTheTruth) {
  const std::vector<Body> bodies = small_bodies();
  TriangleSource source(805);
  const FrameData data = random_frame(bodies, source);
  oracle::Oracle oracle(bodies);
  const std::vector<NearPair> expected = oracle.near(data.frame(), 0.05);
  ASSERT_FALSE(expected.empty());
  for (int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const std::vector<NearPair> near = oracle.near(data.frame(), 0.05);
    EXPECT_EQ(std::fegetround(), mode);
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(near, expected);
  }
}

TEST(NearDeathTest, MarginsThatAreNoLengthAreRefused) {
  const std::vector<Body> bodies = small_bodies();
  TriangleSource source(806);
  const FrameData data = random_frame(bodies, source);
  EXPECT_DEATH(oracle::Oracle(bodies).near(data.frame(), -1.0), "a margin is finite");
  EXPECT_DEATH(oracle::Oracle(bodies).near(data.frame(), std::nan("")), "a margin is finite");
}

// lower^2 <= squared <= upper^2, exactly.
void expect_bounds(const oracle::NearestPoint& point, const mpq_class& squared,
                   const std::string& input) {
  EXPECT_LE(mpq_class(point.lower) * mpq_class(point.lower), squared) << input;
  EXPECT_GE(mpq_class(point.upper) * mpq_class(point.upper), squared) << input;
}

TEST(NearestPointAgainstRational, BoundsHoldAndAreNarrow) {
  TriangleSource source(807);
  int narrow = 0;
  for (int i = 0; i < 1500; ++i) {
    const Corners3 t = i % 2 ? source.triangle(Vec3::Zero(), 1) : source.grid_triangle(2);
    const Vec3 v = source.below(3) ? source.point(Vec3::Zero(), 2) : source.point_near_feature(t);
    const mpq_class squared = RationalDistance(v, t).squared();
    const oracle::NearestPoint fast = oracle::nearest_point(v, t);
    const oracle::NearestPoint exact = oracle::exact_nearest_point(v, t);
    expect_bounds(fast, squared, hex_points(t) + hex_points({&v, 1}));
    expect_bounds(exact, squared, hex_points(t) + hex_points({&v, 1}));
    EXPECT_LE(exact.upper - exact.lower, 0x1p-50 * exact.upper + 2e-154);
    EXPECT_NEAR(exact.offset.norm(), std::sqrt(squared.get_d()), 1e-15);
    narrow += fast.upper - fast.lower < 2e-13;
  }
  EXPECT_GT(narrow, 1480);
}

}  // namespace
}  // namespace contactcheck::test
