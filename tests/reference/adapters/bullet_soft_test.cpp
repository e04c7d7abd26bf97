#include <gmock/gmock.h>

#include <array>
#include <limits>

#include "core/narrow/triangle_triangle.h"
#include "reference/adapters/bullet.h"
#include "tests/reference/adapters/adapter_world.h"

namespace contactcheck::test {
namespace {

using ::testing::ElementsAre;
using ::testing::Gt;
using ::testing::IsEmpty;
using ::testing::SizeIs;

Vec3 nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double length2 = (b - a).squaredNorm();
  if (length2 == 0.0) return a;
  return a + std::clamp((p - a).dot(b - a) / length2, 0.0, 1.0) * (b - a);
}

Vec3 nearest_on_triangle(const Vec3& p, const std::array<Vec3, 3>& t) {
  Vec3 best = nearest_on_segment(p, t[0], t[1]);
  for (const Vec3& q : {nearest_on_segment(p, t[1], t[2]), nearest_on_segment(p, t[2], t[0])})
    if ((q - p).norm() < (best - p).norm()) best = q;
  const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
  if (n.squaredNorm() == 0.0) return best;
  const Vec3 foot = p - n.dot(p - t[0]) / n.squaredNorm() * n;
  for (std::size_t i = 0; i < 3; ++i)
    if (n.cross(t[(i + 1) % 3] - t[i]).dot(foot - t[i]) < 0.0) return best;
  return foot;
}

/// What a detector is fed, in metres.
Vec3 fed(const Vec3& x, double scale) {
  return Vec3(fed_value(x.x(), scale), fed_value(x.y(), scale), fed_value(x.z(), scale)) / scale;
}

/// In doubles on the values that the detector was fed, every vertex against every triangle.
struct BruteForce {
  std::vector<NearPair> near;
  /// Of any pair's distance from the margin: a test is about sets only when rounding decides none.
  double slack = std::numeric_limits<double>::infinity();

  BruteForce(const World& world, const Semantics& semantics) {
    for (std::uint32_t a = 0; a < world.bodies.size(); ++a)
      for (std::uint32_t b = 0; b < world.bodies.size(); ++b)
        if (a != b) add(world, a, b, semantics);
    std::sort(near.begin(), near.end());
  }

  void add(const World& world, std::uint32_t a, std::uint32_t b, const Semantics& semantics) {
    for (std::uint32_t t = 0; t < world.triangles(b).size(); ++t) {
      std::array<Vec3, 3> corners;
      for (std::size_t i = 0; i < 3; ++i)
        corners[i] = fed(world.vertices[b][world.triangles(b)[t][i]], semantics.scale);
      for (std::uint32_t v = 0; v < world.vertices[a].size(); ++v) {
        const Vec3 p = fed(world.vertices[a][v], semantics.scale);
        const double distance = (nearest_on_triangle(p, corners) - p).norm();
        slack = std::min(slack, std::abs(distance - semantics.margin));
        if (distance < semantics.margin) near.push_back({a, b, v, t});
      }
    }
  }
};

World overlapping_spheres() {
  return World({sphere_mesh(Vec3(0, 0, 0), 1, 3), sphere_mesh(Vec3(1.53, 0.31, 0.17), 0.9, 3)});
}

/// A triangle in the plane z = 0 and a small tetrahedron that hangs `height` above it.
World tip_above_plate(double height) {
  const TriangleMesh plate = {{Vec3(-4, -4, 0), Vec3(8, -4, 0), Vec3(-4, 8, 0)}, {{0, 1, 2}}};
  const Vec3 tip(0.25, 0.5, height);
  const TriangleMesh above = {{tip + Vec3(0, 0, 4), tip + Vec3(2, 0, 4), tip, tip + Vec3(0, 2, 4)},
                              {{0, 1, 2}, {1, 3, 2}, {3, 0, 2}, {0, 3, 1}}};
  return World({plate, above});
}

TEST(BulletVf, ClaimsStrictNearnessWithinTheSumOfTheMargins) {
  const Semantics semantics =
      prepared("bullet-vf:margin=0.002", overlapping_spheres())->semantics();
  EXPECT_THAT(semantics.levels, ElementsAre(Level::kBody, Level::kNear, Level::kSelfNear));
  EXPECT_THAT(semantics.informative, ElementsAre(Level::kVertex));
  EXPECT_THAT(semantics.questions,
              ElementsAre(Question::kContacts, Question::kBody, Question::kSelf));
  EXPECT_EQ(semantics.precision, Precision::kSingle);
  EXPECT_EQ(semantics.depth, DepthKind::kVertexSurface);
  EXPECT_FALSE(semantics.closed);
  EXPECT_FALSE(semantics.solid);
  EXPECT_FALSE(semantics.exact);
  EXPECT_FALSE(semantics.means.empty());
  EXPECT_NEAR(semantics.margin, 0.004, 1e-9);
}

TEST(BulletVf, MarginIsWhatTheFloatsHold) {
  const auto detector = make_detector("bullet-vf:margin=0.1,scale=10");
  EXPECT_EQ(detector->semantics().scale, 10.0);
  EXPECT_EQ(detector->semantics().margin, 0.2);  // 10 * 0.1 is 1
  const double tenth = static_cast<double>(0.1f);
  EXPECT_NE(2.0 * tenth, 0.2);
  EXPECT_EQ(make_detector("bullet-vf:margin=0.1,scale=1")->semantics().margin, 2.0 * tenth);
}

TEST(BulletVf, ScaleIsTheScenesOrTheOne) {
  const World world({sphere_mesh(Vec3(0, 0, 0), 0.125, 3)});
  const double scale = prepared("bullet-vf", world)->semantics().scale;
  EXPECT_EQ(scale, adapters::automatic_bullet_scale(world.bodies));
  EXPECT_EQ(scale, 4.0);
  EXPECT_EQ(prepared("bullet-vf:scale=100", world)->semantics().scale, 100.0);
}

TEST(BulletVf, NearPairsAreThoseOfBruteForce) {
  World world = overlapping_spheres();
  for (const char* name : {"bullet-vf:margin=0.04", "bullet-vf:margin=0.04,scale=100"}) {
    const auto detector = prepared(name, world);
    for (const double squash : {1.0, 0.9, 1.2}) {
      for (Vec3& v : world.vertices[1]) v.z() *= squash;
      detector->update(world.frame());
      const BruteForce truth(world, detector->semantics());
      ASSERT_GT(truth.slack, 1e-6) << name << " " << squash;
      ASSERT_THAT(truth.near, SizeIs(Gt(50u)));
      ASSERT_NE(truth.near.front().body, truth.near.back().body);
      const ContactSet contacts = ask(*detector, Question::kContacts);
      EXPECT_EQ(contacts.near, truth.near) << name << " " << squash;
      EXPECT_THAT(ask(*detector, Question::kBody).bodies, ElementsAre(BodyPair{0, 1}));
    }
  }
}

TEST(BulletVf, ContactsHaveTheDistanceAndTheDirectionFromTheFace) {
  const World world = overlapping_spheres();
  const auto detector = prepared("bullet-vf:margin=0.02", world);
  const double scale = detector->semantics().scale;
  ContactSet contacts;  // not canonical: contact i belongs to near pair i
  detector->query(Question::kContacts, contacts);
  ASSERT_EQ(contacts.vertex_contacts.size(), contacts.near.size());
  ASSERT_EQ(contacts.vertices.size(), contacts.near.size());
  for (std::size_t i = 0; i < contacts.near.size(); ++i) {
    const auto [body, other, vertex, triangle] = contacts.near[i];
    EXPECT_EQ(contacts.vertices[i], (VertexInBody{body, other, vertex}));
    EXPECT_EQ(contacts.vertex_contacts[i].where, contacts.vertices[i]);
    std::array<Vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
      corners[k] = fed(world.vertices[other][world.triangles(other)[triangle][k]], scale);
    const Vec3 p = fed(world.vertices[body][vertex], scale);
    const Vec3 away = p - nearest_on_triangle(p, corners);
    EXPECT_NEAR(contacts.vertex_contacts[i].depth, away.norm(), 1e-6);
    EXPECT_NEAR(contacts.vertex_contacts[i].normal.norm(), 1.0, 1e-12);
    if (away.norm() < 1e-3) continue;  // the direction is rounding
    EXPECT_NEAR(contacts.vertex_contacts[i].normal.dot(away) / away.norm(), 1.0, 1e-4);
  }
}

TEST(BulletVf, DistanceOfTheMarginIsNotNear) {
  for (const char* scale : {"1", "16"}) {
    const std::string name = std::string("bullet-vf:margin=0.25,scale=") + scale;
    EXPECT_THAT(ask(*prepared(name, tip_above_plate(0.5)), Question::kContacts).near, IsEmpty());
    const double below = 0.5 - 0x1p-20;
    EXPECT_THAT(ask(*prepared(name, tip_above_plate(below)), Question::kContacts).near,
                ElementsAre(NearPair{1, 0, 2, 0}));
  }
}

TEST(BulletVf, SidesOfAFaceAreAlike) {
  for (const double height : {0.0015, -0.0015}) {
    const ContactSet contacts =
        ask(*prepared("bullet-vf:scale=16", tip_above_plate(height)), Question::kContacts);
    ASSERT_THAT(contacts.vertex_contacts, SizeIs(1));
    EXPECT_NEAR(contacts.vertex_contacts[0].depth, 0.0015, 1e-8);
    EXPECT_NEAR(contacts.vertex_contacts[0].normal.z(), height > 0 ? 1.0 : -1.0, 1e-6);
  }
}

// Bullet's default of 0.25 units around each body would report it.
TEST(BulletVf, MarginIsTheOptionFromTheStart) {
  EXPECT_THAT(ask(*prepared("bullet-vf", tip_above_plate(0.0025)), Question::kBody).bodies,
              IsEmpty());
}

TEST(BulletVf, VertexOnAFaceIsNearWithoutADirection) {
  const ContactSet contacts =
      ask(*prepared("bullet-vf", tip_above_plate(0.0)), Question::kContacts);
  EXPECT_THAT(contacts.near, ElementsAre(NearPair{1, 0, 2, 0}));
  EXPECT_THAT(contacts.vertices, ElementsAre(VertexInBody{1, 0, 2}));
  EXPECT_THAT(contacts.vertex_contacts, IsEmpty());
}

TEST(BulletVf, FineMeshIsInvisibleAtScaleOneAndSeenByDefault) {
  const World world({sphere_mesh(Vec3(0, 0, 0), 0.2, 5), sphere_mesh(Vec3(0.3, 0.1, 0), 0.2, 5)});
  const auto plain = prepared("bullet-vf:scale=1", world);
  EXPECT_THAT(ask(*plain, Question::kContacts).near, IsEmpty());
  EXPECT_THAT(ask(*plain, Question::kBody).bodies, IsEmpty());
  EXPECT_THAT(plain->notes(),
              ElementsAre("triangles below Bullet's area cut (|cross|^2 <= FLT_EPSILON in its "
                          "units) are invisible to it at scale 1"));
  const auto scaled = prepared("bullet-vf", world);
  EXPECT_THAT(ask(*scaled, Question::kContacts).near, SizeIs(Gt(20u)));
  EXPECT_THAT(ask(*scaled, Question::kBody).bodies, ElementsAre(BodyPair{0, 1}));
  EXPECT_THAT(scaled->notes(), IsEmpty());
  EXPECT_THAT(plain->trace().stages, IsEmpty());
}

// |cross|^2 is 2^-24 and 2^-22; the cut is at 2^-23.
TEST(BulletVf, NotesFollowTheFrameAndTheCut) {
  World world(
      {triangle_mesh(Vec3(0, 0, 0), Vec3(0x1p-6, 0, 0), Vec3(0, 0x1p-6, 0)), unit_box_mesh(1)});
  const auto detector = prepared("bullet-vf:scale=1", world);
  EXPECT_THAT(detector->notes(), SizeIs(1));
  world.vertices[0][1] *= 2.0;
  detector->update(world.frame());
  EXPECT_THAT(detector->notes(), IsEmpty());
  world.vertices[0][1] = Vec3::Zero();  // no area at all: nothing is hidden
  detector->update(world.frame());
  EXPECT_THAT(detector->notes(), IsEmpty());
  world.vertices[0][1] = Vec3(0x1p-6, 0, 0);
  for (Vec3& v : world.vertices[1]) v += Vec3(5, 0, 0);  // nothing to hide from
  detector->update(world.frame());
  EXPECT_THAT(detector->notes(), IsEmpty());
}

// The known limit: two ridges that cross, all vertices far from the other's faces.
TEST(BulletVf, CrossingEdgesAreMissed) {
  const TriangleMesh below = {{Vec3(-2, 0, 0.1), Vec3(2, 0, 0.1), Vec3(0, 2, -3), Vec3(0, -2, -3)},
                              {{0, 1, 2}, {1, 0, 3}, {0, 2, 3}, {2, 1, 3}}};
  const TriangleMesh above = {{Vec3(0, -2, -0.1), Vec3(0, 2, -0.1), Vec3(2, 0, 3), Vec3(-2, 0, 3)},
                              {{0, 1, 2}, {1, 0, 3}, {0, 2, 3}, {2, 1, 3}}};
  const auto corners = [](const TriangleMesh& mesh, std::size_t t) {
    const Triangle& i = mesh.triangles[t];
    return TrianglePoints{mesh.vertices[i[0]], mesh.vertices[i[1]], mesh.vertices[i[2]]};
  };
  ASSERT_TRUE(triangles_intersect(corners(below, 0), corners(above, 0)));
  const auto detector = prepared("bullet-vf", World({below, above}));
  EXPECT_THAT(ask(*detector, Question::kBody).bodies, IsEmpty());
}

TEST(BulletVf, DisconnectedAndDegenerateMeshKeepsItsIds) {
  // A triangle that repeats an index, one without area, a real one and another component.
  const TriangleMesh mesh = {
      {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0), Vec3(20, 0, 0), Vec3(24, 0, 0), Vec3(20, 4, 0)},
      {{0, 0, 1}, {0, 1, 1}, {0, 1, 2}, {3, 3, 4}, {3, 4, 5}}};
  TriangleMesh collapsed = mesh;
  collapsed.vertices.push_back(Vec3(2, 0, 0));
  collapsed.triangles.insert(collapsed.triangles.begin(), {0, 6, 1});
  const TriangleMesh probes = {{Vec3(1, 1, 0.001), Vec3(21, 1, 0.001), Vec3(1, 9, 5)}, {{0, 1, 2}}};
  const auto detector = prepared("bullet-vf:scale=1", World({collapsed, probes}));
  EXPECT_THAT(ask(*detector, Question::kContacts).near,
              ElementsAre(NearPair{1, 0, 0, 3}, NearPair{1, 0, 1, 5}));
}

TEST(BulletVf, VertexOfAPointIsANode) {
  const TriangleMesh plate = triangle_mesh(Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0));
  const TriangleMesh lone = {{Vec3(9, 9, 9), Vec3(1, 1, 0.001), Vec3(8, 9, 9), Vec3(9, 8, 9)},
                             {{0, 2, 3}, {1, 1, 1}}};
  EXPECT_THAT(ask(*prepared("bullet-vf", World({plate, lone})), Question::kContacts).near,
              ElementsAre(NearPair{1, 0, 1, 0}));
}

TEST(BulletVf, HundredThousandVerticesAreSearched) {
  const TriangleMesh big = grid_sphere(1.0, 224);
  ASSERT_EQ(big.vertices.size(), 99906u);
  ASSERT_EQ(big.triangles.size(), 199808u);
  const TriangleMesh probe =
      triangle_mesh(Vec3(1, 0.0071, 0.0003), Vec3(1, -0.0023, 0.0101), Vec3(1, 0.0107, 0.0113));
  const World world({big, probe});
  const auto detector = prepared("bullet-vf", world);
  const BruteForce truth(world, detector->semantics());
  ASSERT_GT(truth.slack, 1e-8);
  ASSERT_THAT(truth.near, SizeIs(Gt(3u)));
  EXPECT_EQ(ask(*detector, Question::kContacts).near, truth.near);
  EXPECT_THAT(detector->notes(), IsEmpty());
}

// In the order of their places leaves would make a list, which Bullet recurses through.
TEST(BulletVf, VerticesThatCoincideAtRestAreHeld) {
  TriangleMesh mesh;
  for (std::uint32_t v = 0; v < 6000; ++v) mesh.vertices.emplace_back(1, 2, 3);
  for (std::uint32_t v = 0; v < 6000; v += 3) mesh.triangles.push_back({v, v + 1, v + 2});
  const TriangleMesh plate = triangle_mesh(Vec3(0, 0, 3), Vec3(9, 0, 3), Vec3(0, 9, 3));
  const auto detector = prepared("bullet-vf", World({mesh, plate}));
  EXPECT_THAT(ask(*detector, Question::kContacts).near, SizeIs(6000));
}

// Two balls of one mesh, a vertex of each before the other's, moved apart and together again.
TEST(BulletVf, BallsOfOneBodyAreNearAsTheirVerticesAre) {
  const TriangleMesh ball = sphere_mesh(Vec3(0, 0, 0), 1, 3);
  const auto first = static_cast<std::uint32_t>(ball.vertices.size());
  World world({together(ball, sphere_mesh(Vec3(2.001, 0, 0), 1, 3))});
  for (const bool expected : {false, true}) {
    const auto detector = make_detector("bullet-vf");
    if (expected) detector->expect({Question::kSelf});
    detector->prepare(world.bodies);
    for (const double away : {0.0, 0.01, -0.01}) {
      for (std::uint32_t v = first; v < 2 * first; ++v) world.vertices[0][v].x() += away;
      detector->update(world.frame());
      const ContactSet found = ask(*detector, Question::kSelf);
      EXPECT_EQ(found.self_near.size(), away > 0.0 ? 0u : 8u) << away;  // four faces at each tip
      for (const NearPair& p : found.self_near) {
        EXPECT_EQ(world.vertices[0][p.vertex].y(), 0.0);
        EXPECT_NE(p.vertex < first, world.triangles(0)[p.triangle][0] < first);
      }
      EXPECT_THAT(found.near, IsEmpty());
      EXPECT_THAT(ask(*detector, Question::kContacts).self_near, IsEmpty());
    }
  }
}

// The known limit: all normals lie in a narrow cone, or in two that face one another.
TEST(BulletVf, SheetsOverOneAnotherAreLeftOut) {
  const auto sheet = [](double z, bool turned) {
    TriangleMesh mesh = {{Vec3(0, 0, z), Vec3(4, 0, z), Vec3(0, 4, z), Vec3(4, 4, z)},
                         {{0, 1, 2}, {2, 1, 3}}};
    for (Triangle& t : mesh.triangles)
      if (turned) std::swap(t[0], t[1]);
    return mesh;
  };
  for (const bool turned : {false, true}) {
    const World world({together(sheet(0, false), sheet(0.001, turned))});
    EXPECT_THAT(ask(*prepared("bullet-vf", world), Question::kSelf).self_near, IsEmpty());
  }
}

TEST(BulletVf, SwappedBodiesGiveTheSamePairs) {
  const World world = overlapping_spheres();
  const World swapped({world.bodies[1].shape->mesh, world.bodies[0].shape->mesh});
  const char* name = "bullet-vf:margin=0.02";
  const ContactSet one = ask(*prepared(name, world), Question::kContacts);
  ContactSet two = ask(*prepared(name, swapped), Question::kContacts);
  for (NearPair& p : two.near) std::swap(p.body, p.other);
  two.canonicalize();
  EXPECT_EQ(two.near, one.near);
  EXPECT_FALSE(one.near.empty());
}

TEST(BulletVf, InstancesOfAShapeAreBodiesOfTheirOwn) {
  World world({sphere_mesh(Vec3(0, 0, 0), 1, 3)});
  for (const double x : {1.7, 3.4}) {
    world.bodies.push_back({"instance", world.bodies[0].shape});
    world.vertices.push_back(world.vertices[0]);
    shift(world, world.vertices.size() - 1, Vec3(x, 0.05, 0.02));
  }
  const auto detector = prepared("bullet-vf:margin=0.02", world);
  const ContactSet contacts = ask(*detector, Question::kContacts);
  EXPECT_EQ(contacts.near, BruteForce(world, detector->semantics()).near);
  EXPECT_THAT(contacts.bodies, ElementsAre(BodyPair{0, 1}, BodyPair{1, 2}));
}

}  // namespace
}  // namespace contactcheck::test
