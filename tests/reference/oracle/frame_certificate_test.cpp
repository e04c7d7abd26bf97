// The decisions cover every pair of triangles of every pair of bodies once, and no verdict that is
// wrong can be certified.
#include "reference/oracle/frame_certificate.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "reference/oracle/oracle.h"
#include "tests/support/shapes.h"

namespace contactcheck::oracle::certify {
namespace {

using testing::HasSubstr;

/// A ball that sinks into a box, and another box far away.
struct World {
  World() {
    const auto body = [](const char* name, TriangleMesh mesh) {
      return Body{name, make_bare_shape(std::move(mesh))};
    };
    bodies = {body("ball", test::sphere_mesh(Vec3(0.1, 0.2, 1.9), 1, 2)),
              body("box", test::box_mesh(Vec3(-1, -1, -1), Vec3(1, 1, 1), 3)),
              body("far", test::box_mesh(Vec3(9, 9, 9), Vec3(10, 10, 10), 1))};
    for (const Body& b : bodies) positions.push_back(b.shape->mesh.vertices);
    data = test::make_frame(bodies, positions);
    truth = Oracle(bodies).judge(data.frame(), {}).surface;
  }

  std::size_t triangles(std::size_t body) const {
    return bodies[body].shape->mesh.triangles.size();
  }

  std::vector<Body> bodies;
  std::vector<std::vector<Vec3>> positions;
  test::FrameData data;
  ContactSet truth;
};

/// The pairs of triangles that each decision speaks of, by the documented rule and no other code.
class Replay {
 public:
  Replay(const World& world, const Certifier& certifier, const std::string& decisions)
      : world_(world), certifier_(certifier), decisions_(decisions) {
    for (std::uint32_t a = 0; a < world.bodies.size(); ++a)
      for (std::uint32_t b = a + 1; b < world.bodies.size(); ++b)
        cover({a, b}, 0, world.triangles(a), 0, world.triangles(b));
    EXPECT_EQ(at_, decisions.size());
  }

  std::size_t covered = 0;
  std::set<ElementPair> touching, separated;

 private:
  void cover(BodyPair pair, std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
    const char step = decisions_.at(at_++);
    if (step == 'a') {
      cover(pair, i, (i + j) / 2, k, l);
      cover(pair, (i + j) / 2, j, k, l);
    } else if (step == 'b') {
      cover(pair, i, j, k, (k + l) / 2);
      cover(pair, i, j, (k + l) / 2, l);
    } else if (step == 't' || step == 's') {
      ASSERT_EQ(j - i, 1u);
      ASSERT_EQ(l - k, 1u);
      ++covered;
      (step == 't' ? touching : separated)
          .insert({pair.a, pair.b, certifier_.order(pair.a)[i], certifier_.order(pair.b)[k]});
    } else {
      covered += (j - i) * (l - k);
      expect_apart(std::string("xyz").find(step), box(pair.a, i, j), box(pair.b, k, l));
    }
  }

  Aabb box(std::uint32_t body, std::size_t first, std::size_t last) const {
    Aabb out;
    for (std::size_t place = first; place < last; ++place)
      for (std::uint32_t v :
           world_.bodies[body].shape->mesh.triangles[certifier_.order(body)[place]])
        out.extend(world_.positions[body][v]);
    return out;
  }

  static void expect_apart(std::size_t axis, const Aabb& a, const Aabb& b) {
    ASSERT_LT(axis, 3u);
    const auto k = static_cast<Eigen::Index>(axis);
    EXPECT_TRUE(a.hi[k] < b.lo[k] || b.hi[k] < a.lo[k]);
  }

  const World& world_;
  const Certifier& certifier_;
  const std::string& decisions_;
  std::size_t at_ = 0;
};

TEST(FrameCertificate, CoversEveryPairOnceAndListsWhatItDecides) {
  const World world;
  Certifier certifier(world.bodies);
  const FrameCertificate certificate = certifier.certify(world.data.frame(), world.truth.triangles);
  const Replay replay(world, certifier, certificate.decisions);
  EXPECT_EQ(replay.covered, world.triangles(0) * world.triangles(1) +
                                world.triangles(0) * world.triangles(2) +
                                world.triangles(1) * world.triangles(2));
  std::vector<ElementPair> contacts, gaps;
  for (const CertifiedContact& contact : certificate.contacts)
    contacts.push_back(contact.triangles);
  for (const CertifiedGap& gap : certificate.gaps) gaps.push_back(gap.triangles);
  EXPECT_GT(contacts.size(), 10u);
  EXPECT_GT(gaps.size(), 10u);
  EXPECT_EQ(contacts, world.truth.triangles);
  EXPECT_EQ(contacts, std::vector(replay.touching.begin(), replay.touching.end()));
  EXPECT_EQ(gaps, std::vector(replay.separated.begin(), replay.separated.end()));
}

TEST(FrameCertificate, OfBodiesThatAreApartIsOneLetterAPair) {
  World world;
  for (Vec3& p : world.positions[0]) p.y() += 5;
  world.data = test::make_frame(world.bodies, world.positions);
  Certifier certifier(world.bodies);
  EXPECT_EQ(certifier.certify(world.data.frame(), {}).decisions, "yxx");
}

TEST(FrameCertificate, IsRefusedWhereTheTruthForgetsAContact) {
  World world;
  world.truth.triangles.erase(world.truth.triangles.begin() + 3);
  Certifier certifier(world.bodies);
  try {
    certifier.certify(world.data.frame(5), world.truth.triangles);
    FAIL() << "a contact has no plane";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("of \"ball\" and triangle "));
    EXPECT_THAT(error.what(), HasSubstr("are apart in frame 5, which is not so"));
  }
}

TEST(FrameCertificate, IsRefusedWhereTheTruthInventsAContact) {
  World world;
  Certifier certifier(world.bodies);
  const FrameCertificate right = certifier.certify(world.data.frame(), world.truth.triangles);
  std::vector<ElementPair> touching = world.truth.triangles;
  touching.push_back(right.gaps.front().triangles);
  std::sort(touching.begin(), touching.end());
  EXPECT_THROW(certifier.certify(world.data.frame(), touching), std::runtime_error);
  touching = world.truth.triangles;
  touching.push_back({1, 2, 0, 0});  // boxes apart
  EXPECT_THROW(certifier.certify(world.data.frame(), touching), std::runtime_error);
}

}  // namespace
}  // namespace contactcheck::oracle::certify
