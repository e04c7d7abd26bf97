// Whatever does not meet within a step has a certificate that holds, by rules and arithmetic of
// this file's own; whatever meets has none, and a proof of its contact.
#include "reference/oracle/step_certificate.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "core/types/shared_corners.h"
#include "reference/oracle/oracle.h"
#include "reference/oracle/rational_geometry.h"
#include "tests/support/step_scenes.h"

namespace contactcheck::oracle::certify::steps {
namespace {

using rational::dot;
using rational::Point;
using rational::to_rational;
using test::StepScene;

bool is_apart(const ImpactCertificate& proof) {
  return proof.contact.index() == 0 && !proof.apart.empty() && proof.apart.back().end == 1;
}

/// Follows the decisions on one pair of bodies in exact arithmetic.
class Replay {
 public:
  Replay(const StepScene& scene, const StepCertifier& certifier, BodyPair pair,
         const ApartCertificate& proof)
      : scene_(scene), certifier_(certifier), pair_(pair), proof_(proof) {
    if (pair.a == pair.b) {
      cover_own(0, triangles(pair.a));
    } else {
      cover({0, triangles(pair.a), 0, triangles(pair.b), 0, 1});
    }
    EXPECT_EQ(at_, proof.decisions.size());
    EXPECT_EQ(directions_, proof.directions.size());
    EXPECT_EQ(by_elements_, proof.triangles.size());
    EXPECT_TRUE(std::ranges::all_of(proof.elements, is_apart));
  }

  mpq_class covered = 0;  ///< pairs of triangles, times the part of the step

 private:
  struct Question {
    std::size_t i, j, k, l;  ///< ranges
    mpq_class start, end;
  };

  std::size_t triangles(std::uint32_t body) const {
    return scene_.bodies[body].shape->mesh.triangles.size();
  }

  void cover_own(std::size_t i, std::size_t j) {
    const std::size_t half = i + (j - i) / 2;
    if (j - i < 2) return;
    cover_own(i, half);
    cover_own(half, j);
    cover({i, half, half, j, 0, 1});
  }

  void cover(const Question& x) {
    const char step = proof_.decisions.at(at_++);
    if (step == 'a') {
      cover({x.i, (x.i + x.j) / 2, x.k, x.l, x.start, x.end});
      cover({(x.i + x.j) / 2, x.j, x.k, x.l, x.start, x.end});
    } else if (step == 'b') {
      cover({x.i, x.j, x.k, (x.k + x.l) / 2, x.start, x.end});
      cover({x.i, x.j, (x.k + x.l) / 2, x.l, x.start, x.end});
    } else if (step == 'h') {
      const mpq_class middle = (x.start + x.end) / 2;
      cover({x.i, x.j, x.k, x.l, x.start, middle});
      cover({x.i, x.j, x.k, x.l, middle, x.end});
    } else {
      covered += (x.end - x.start) * mpq_class((x.j - x.i) * (x.l - x.k));
      expect_so(step, x);
    }
  }

  void expect_so(char step, const Question& x) {
    if (step == 's') {
      const StepDirection n = proof_.directions.at(directions_++);
      const Point along = {mpq_class(n[0]), mpq_class(n[1]), mpq_class(n[2])};
      for (const mpq_class& t : {x.start, x.end})
        EXPECT_GT(extent(pair_.a, x.i, x.j, along, t)[0], extent(pair_.b, x.k, x.l, along, t)[1]);
    } else if (step == 'n' || step == 'f') {
      ASSERT_EQ(x.j - x.i, 1u);
      ASSERT_EQ(x.l - x.k, 1u);
      if (step == 'f') {
        EXPECT_EQ(x.end - x.start, 1);
        const ApartByElements& proof = proof_.triangles.at(by_elements_++);
        EXPECT_EQ(proof.elements.size(), 15u);
        EXPECT_TRUE(std::ranges::all_of(proof.elements, is_apart));
        return;
      }
      ASSERT_EQ(pair_.a, pair_.b);
      const std::vector<Triangle>& linked = scene_.bodies[pair_.a].shape->linked();
      const auto& order = certifier_.order(pair_.a);
      EXPECT_GT(shared_corners(linked[order[x.i]], linked[order[x.k]]).count, 0u);
    } else {
      expect_boxes_apart(std::string("xyz").find(step), x);
    }
  }

  void expect_boxes_apart(std::size_t axis, const Question& x) {
    ASSERT_LT(axis, 3u);
    std::array<bool, 2> before{};
    for (const std::size_t end : {0, 1}) {
      const mpq_class t = end == 0 ? x.start : x.end;
      const auto [low_a, high_a] = box_at(axis, pair_.a, x.i, x.j, t);
      const auto [low_b, high_b] = box_at(axis, pair_.b, x.k, x.l, t);
      EXPECT_TRUE(high_a < low_b || high_b < low_a);
      before[end] = high_a < low_b;
    }
    EXPECT_EQ(before[0], before[1]);
  }

  std::array<mpq_class, 2> box_at(std::size_t axis, std::uint32_t body, std::size_t first,
                                  std::size_t last, const mpq_class& t) const {
    std::array<Aabb, 2> boxes;
    for (std::size_t place = first; place < last; ++place)
      for (const std::uint32_t v : corners(body, place)) {
        boxes[0].extend(scene_.start.vertices[body][v]);
        boxes[1].extend(scene_.end.vertices[body][v]);
      }
    const auto k = static_cast<Eigen::Index>(axis);
    const auto at = [&](double start, double end) {
      return mpq_class((1 - t) * mpq_class(start) + t * mpq_class(end));
    };
    return {at(boxes[0].lo[k], boxes[1].lo[k]), at(boxes[0].hi[k], boxes[1].hi[k])};
  }

  const Triangle& corners(std::uint32_t body, std::size_t place) const {
    return scene_.bodies[body].shape->mesh.triangles[certifier_.order(body)[place]];
  }

  /// The least and the largest of n * corner.
  std::array<mpq_class, 2> extent(std::uint32_t body, std::size_t first, std::size_t last,
                                  const Point& n, const mpq_class& t) const {
    std::set<std::uint32_t> vertices;
    for (std::size_t place = first; place < last; ++place)
      for (const std::uint32_t v : corners(body, place)) vertices.insert(v);
    std::vector<mpq_class> along;
    for (const std::uint32_t v : vertices)
      along.push_back((1 - t) * dot(n, to_rational(scene_.start.vertices[body][v])) +
                      t * dot(n, to_rational(scene_.end.vertices[body][v])));
    const auto [low, high] = std::minmax_element(along.begin(), along.end());
    return {*low, *high};
  }

  const StepScene& scene_;
  const StepCertifier& certifier_;
  BodyPair pair_;
  const ApartCertificate& proof_;
  std::size_t at_ = 0, directions_ = 0, by_elements_ = 0;
};

/// What meets, by the oracle.
struct Truth {
  explicit Truth(const StepScene& scene) {
    WantedTruth wanted;
    wanted.self = true;
    const ContactSet start = Oracle(scene.bodies).judge(scene.start.frame(), wanted).surface;
    at_start = start.triangles;
    steps = StepOracle(scene.bodies).judge(scene.step(), start.triangles, {true, true});
    for (const SelfPair& pair : start.self) {
      const std::vector<Triangle>& linked = scene.bodies[pair.body].shape->linked();
      if (shared_corners(linked[pair.a], linked[pair.b]).count == 0)
        at_start.push_back({pair.body, pair.body, pair.a, pair.b});
    }
    for (const ElementPair& pair : at_start) {
      meeting.insert({pair.body_a, pair.body_b});
      starting.insert({pair.body_a, pair.body_b});
    }
    for (const FirstImpact& first : steps.first) meeting.insert(first.bodies);
    for (const NearPair& x : steps.contacts.self_impact_vertices) meeting.insert({x.body, x.body});
    for (const SelfPair& x : steps.contacts.self_impact_edges) meeting.insert({x.body, x.body});
  }

  std::vector<ElementPair> at_start;
  StepTruth steps;
  std::set<BodyPair> meeting, starting;
};

bool is_torn(const StepScene& scene) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    for (const test::FrameData* frame : {&scene.start, &scene.end})
      if (torn_weld(*scene.bodies[b].shape, frame->vertices[b])) return true;
  return false;
}

struct Seen {
  std::size_t apart = 0, own = 0, starting = 0, later = 0;
  std::string letters;
};

void expect_proofs(const StepScene& scene, Seen& seen) {
  const Truth truth(scene);
  StepCertifier certifier(scene.bodies);
  const Step step = scene.step();
  certifier.begin(step);
  const auto count = static_cast<std::uint32_t>(scene.bodies.size());
  for (std::uint32_t a = 0; a < count; ++a)
    for (std::uint32_t b = a; b < count; ++b) {
      const BodyPair pair{a, b};
      const auto apart = certifier.prove_apart(pair);
      const auto contact = certifier.prove_contact(pair, truth.at_start, truth.steps.contacts);
      ASSERT_EQ(apart.has_value(), !truth.meeting.contains(pair)) << scene.name << a << " " << b;
      ASSERT_EQ(contact.has_value(), truth.meeting.contains(pair)) << scene.name << a << " " << b;
      if (contact) {
        ASSERT_EQ(std::holds_alternative<TouchAtStart>(*contact), truth.starting.contains(pair));
        ++(truth.starting.contains(pair) ? seen.starting : seen.later);
        // Of two bodies it is the first.
        if (const auto* meet = std::get_if<ElementsMeet>(&*contact); meet != nullptr && a != b) {
          const auto first = std::ranges::find(truth.steps.first, pair, &FirstImpact::bodies);
          ASSERT_NE(first, truth.steps.first.end());
          EXPECT_LE(meet->time.earliest, first->latest) << scene.name << a << " " << b;
          EXPECT_GE(meet->time.latest, first->earliest) << scene.name << a << " " << b;
        }
        continue;
      }
      const Replay replay(scene, certifier, pair, *apart);
      const std::size_t of_a = scene.bodies[a].shape->mesh.triangles.size(),
                        of_b = scene.bodies[b].shape->mesh.triangles.size();
      EXPECT_EQ(replay.covered, a == b ? of_a * (of_a - 1) / 2 : of_a * of_b);
      ++(a == b ? seen.own : seen.apart);
      seen.letters += apart->decisions;
      ASSERT_FALSE(testing::Test::HasFailure()) << scene.name << " " << a << " " << b;
    }
}

TEST(StepCertificate, HoldsForWhateverDoesNotMeetAndIsNotThereForTheRest) {
  test::TriangleSource random(911);
  Seen seen;
  for (const test::StepFamily family : test::kStepFamilies)
    for (int round = 0; round < 3; ++round) {
      const StepScene scene = test::draw_step_scene(random, family);
      std::size_t triangles = 0;
      for (const Body& body : scene.bodies) triangles += body.shape->mesh.triangles.size();
      if (is_torn(scene) || triangles > 64) continue;
      expect_proofs(scene, seen);
      if (HasFatalFailure()) return;
    }
  EXPECT_GT(seen.apart, 20u);
  EXPECT_GT(seen.own, 10u);
  EXPECT_GT(seen.starting, 10u);
  EXPECT_GT(seen.later, 10u);
  for (const char letter : {'a', 'b', 'h', 'x', 'y', 'z', 's', 'n'})
    EXPECT_NE(seen.letters.find(letter), std::string::npos) << letter;
}

// Time is halved where boxes are apart along one axis first and along another later.
TEST(StepCertificate, IsShortForBodiesThatPassOneAnother) {
  const Body ball{"ball", make_bare_shape(test::sphere_mesh(Vec3::Zero(), 1.0, 3))};
  const auto at = [&](const Vec3& place) {
    return test::NodesOfBodies{test::rest_nodes_at(*ball.shape, Vec3::Zero()),
                               test::rest_nodes_at(*ball.shape, place)};
  };
  const auto proof = [&](const Vec3& from, const Vec3& to) {
    const StepScene scene = test::make_step_scene("passing", {ball, ball}, at(from), at(to));
    StepCertifier certifier(scene.bodies);
    const Step step = scene.step();
    certifier.begin(step);
    return certifier.prove_apart({0, 1}).value();
  };
  EXPECT_EQ(proof(Vec3(-20, 3, 0), Vec3(20, 3, 0)).decisions, "y");
  EXPECT_EQ(proof(Vec3(6, 0, 0), Vec3(0, 6, 0)).decisions, "hxy");
  // A twentieth of the size apart, forty times the size in the step, along no axis: 262,144 pairs
  // of triangles.
  EXPECT_LT(proof(Vec3(31.5, -28.5, 0), Vec3(-28.5, 31.5, 0)).decisions.size(), 1000u);
}

/// All pairs of elements without a common vertex, but those of which two triangles without a
/// common vertex have one each.
std::vector<std::array<std::uint32_t, 6>> loose_by_brute_force(const BodyShape& shape) {
  const std::vector<Triangle>& linked = shape.linked();
  const auto share = [](const auto& one, const auto& other) {
    for (const std::uint32_t v : one)
      for (const std::uint32_t w : other)
        if (v == w) return true;
    return false;
  };
  const auto has = [](const Triangle& t, const auto& vertices) {
    return std::ranges::all_of(
        vertices, [&](std::uint32_t v) { return v == t[0] || v == t[1] || v == t[2]; });
  };
  const auto covered = [&](const auto& one, const auto& other) {
    for (const Triangle& s : linked)
      for (const Triangle& t : linked)
        if (has(s, one) && has(t, other) && !share(s, t)) return true;
    return false;
  };
  std::set<std::array<std::uint32_t, 1>> vertices;
  std::set<std::array<std::uint32_t, 2>> edges;
  for (std::size_t t = 0; t < linked.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      vertices.insert({linked[t][i]});
      const auto [low, high] = std::minmax(linked[t][i], linked[t][j]);
      if (shape.mesh.triangles[t][i] != shape.mesh.triangles[t][j]) edges.insert({low, high});
    }
  std::vector<std::array<std::uint32_t, 6>> out;
  for (const auto& v : vertices)
    for (std::uint32_t t = 0; t < linked.size(); ++t) {
      // Of this triangle alone: others may have the same corners.
      const auto& [a, b, c] = linked[t];
      bool apart = false;
      for (const Triangle& s : linked) apart = apart || (has(s, v) && !share(s, linked[t]));
      if (!share(v, linked[t]) && !apart) out.push_back({0, v[0], a, b, c, t});
    }
  for (const auto& e : edges)
    for (const auto& f : edges)
      if (e < f && !share(e, f) && !covered(e, f)) out.push_back({1, e[0], e[1], f[0], f[1], 0});
  return out;
}

TEST(LooseElements, AreThoseOfNoTwoTrianglesWithoutACommonVertex) {
  test::TriangleSource random(912);
  std::size_t vertices = 0, edges = 0, none = 0;
  for (int round = 0; round < 60; ++round) {
    const test::StepFamily family = round % 3 == 0   ? test::StepFamily::kDegenerate
                                    : round % 3 == 1 ? test::StepFamily::kWelded
                                                     : test::StepFamily::kFolding;
    for (const Body& body : test::draw_step_scene(random, family).bodies) {
      std::vector<std::array<std::uint32_t, 6>> found;
      for (const OwnElements& e : loose_elements(*body.shape)) {
        const auto& [p, q, r, s] = e.vertices;
        found.push_back({e.kind == ImpactKind::edge_edge ? 1u : 0u, p, q, r, s, e.triangle});
        ++(e.kind == ImpactKind::edge_edge ? edges : vertices);
      }
      none += found.empty() ? 1 : 0;
      ASSERT_EQ(found, loose_by_brute_force(*body.shape));
    }
  }
  EXPECT_GT(vertices, 50u);
  EXPECT_GT(edges, 50u);
  EXPECT_GT(none, 0u);
}

}  // namespace
}  // namespace contactcheck::oracle::certify::steps
