// The oracle of steps against brute force in exact arithmetic over all pairs of elements.

#include "reference/oracle/step_truth.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>

#include "core/types/impact.h"
#include "core/types/mesh_edges.h"
#include "reference/oracle/elementary_impact.h"
#include "reference/oracle/oracle.h"
#include "reference/oracle/rational_clipping.h"
#include "tests/support/step_scenes.h"

namespace contactcheck::test::step_truth {
namespace {

using oracle::elementary_impact;
using oracle::FirstImpact;
using oracle::rational::triangles_intersect_by_clipping;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr oracle::WantedSteps kBoth{true, true};

/// All that the oracle gives, by the definitions of the levels.
class ExactBruteForce {
 public:
  explicit ExactBruteForce(const StepScene& scene) : scene_(scene) {
    for (const Body& body : scene.bodies) edges_.push_back(mesh_edges(body.shape->mesh.triangles));
    const auto count = static_cast<std::uint32_t>(scene_.bodies.size());
    for (std::uint32_t a = 0; a < count; ++a) {
      judge_own(a);
      for (std::uint32_t b = a + 1; b < count; ++b) judge_pair(a, b);
    }
    contacts.canonicalize();
    std::sort(at_start.begin(), at_start.end());
  }

  ContactSet contacts;
  std::vector<ElementPair> at_start;
  /// Certified intervals of all impacts of two bodies; both 0 where triangles touch at the start.
  std::map<BodyPair, std::vector<Impact>> impacts;

 private:
  const TriangleMesh& mesh(std::uint32_t body) const { return scene_.bodies[body].shape->mesh; }
  oracle::rational::TriangleCorners corners(std::uint32_t body, std::uint32_t t) const {
    const Triangle& of = mesh(body).triangles[t];
    const std::vector<Vec3>& at = scene_.start.vertices[body];
    return {at[of[0]], at[of[1]], at[of[2]]};
  }
  Impact ask(ImpactKind kind, const std::array<std::uint32_t, 4>& bodies,
             const std::array<std::uint32_t, 4>& vertices) const {
    ImpactQuery query{kind, {}, {}};
    for (std::size_t i = 0; i < 4; ++i) {
      query.start[i] = scene_.start.vertices[bodies[i]][vertices[i]];
      query.end[i] = scene_.end.vertices[bodies[i]][vertices[i]];
    }
    return elementary_impact(query);
  }
  Impact vertex_face(std::uint32_t a, std::uint32_t v, std::uint32_t b, std::uint32_t t) const {
    const Triangle& of = mesh(b).triangles[t];
    return ask(ImpactKind::vertex_triangle, {a, b, b, b}, {v, of[0], of[1], of[2]});
  }
  Impact edge_edge(std::uint32_t a, const Edge& e, std::uint32_t b, const Edge& f) const {
    return ask(ImpactKind::edge_edge, {a, a, b, b}, {e[0], e[1], f[0], f[1]});
  }

  using Table = std::vector<std::vector<char>>;
  Table vertices_with_faces(std::uint32_t a, std::uint32_t b, std::vector<Impact>& found) {
    Table table(mesh(a).vertices.size(), std::vector<char>(mesh(b).triangles.size()));
    for (std::uint32_t v = 0; v < table.size(); ++v)
      for (std::uint32_t t = 0; t < table[v].size(); ++t) {
        const Impact impact = vertex_face(a, v, b, t);
        if (!impact.contact) continue;
        table[v][t] = 1;
        found.push_back(impact);
        contacts.impact_vertices.push_back({a, b, v, t});
      }
    return table;
  }

  void judge_pair(std::uint32_t a, std::uint32_t b) {
    std::vector<Impact> found;
    const Table ab = vertices_with_faces(a, b, found), ba = vertices_with_faces(b, a, found);
    Table edges(edges_[a].edges.size(), std::vector<char>(edges_[b].edges.size()));
    for (std::uint32_t e = 0; e < edges.size(); ++e)
      for (std::uint32_t f = 0; f < edges[e].size(); ++f) {
        const Impact impact = edge_edge(a, edges_[a].edges[e], b, edges_[b].edges[f]);
        if (!impact.contact) continue;
        edges[e][f] = 1;
        found.push_back(impact);
        contacts.impact_edges.push_back({a, b, e, f});
      }
    for (std::uint32_t s = 0; s < mesh(a).triangles.size(); ++s)
      for (std::uint32_t t = 0; t < mesh(b).triangles.size(); ++t) {
        bool meet = triangles_intersect_by_clipping(corners(a, s), corners(b, t));
        if (meet) found.push_back({true, true, 0, 0}), at_start.push_back({a, b, s, t});
        for (std::size_t i = 0; i < 3; ++i) {
          meet |= ab[mesh(a).triangles[s][i]][t] != 0 || ba[mesh(b).triangles[t][i]][s] != 0;
          for (std::size_t j = 0; j < 3; ++j) {
            const std::uint32_t e = edges_[a].of_triangle[s][i], f = edges_[b].of_triangle[t][j];
            meet |= e != MeshEdges::kNone && f != MeshEdges::kNone && edges[e][f] != 0;
          }
        }
        if (meet) contacts.impact_triangles.push_back({a, b, s, t});
      }
    if (!found.empty()) impacts[{a, b}] = std::move(found);
  }

  void judge_own(std::uint32_t body) {
    const BodyShape& shape = *scene_.bodies[body].shape;
    const std::vector<Vec3>& rest = shape.mesh.vertices;
    const auto share = [&](const auto& some, const auto& others) {
      for (const std::uint32_t v : some)
        for (const std::uint32_t w : others)
          if (v == w || (!shape.welded.empty() && rest[v] == rest[w])) return true;
      return false;
    };
    for (std::uint32_t v = 0; v < rest.size(); ++v)
      for (std::uint32_t t = 0; t < shape.mesh.triangles.size(); ++t)
        if (!share(std::array{v}, shape.mesh.triangles[t]) && vertex_face(body, v, body, t).contact)
          contacts.self_impact_vertices.push_back({body, body, v, t});
    const std::vector<Edge>& edges = edges_[body].edges;
    for (std::uint32_t e = 0; e < edges.size(); ++e)
      for (std::uint32_t f = e + 1; f < edges.size(); ++f)
        if (!share(edges[e], edges[f]) && edge_edge(body, edges[e], body, edges[f]).contact)
          contacts.self_impact_edges.push_back({body, e, f});
  }

  const StepScene& scene_;
  std::vector<MeshEdges> edges_;
};

/// What is wrong with the first times; empty if nothing is.
std::string fault_of_times(const std::vector<FirstImpact>& first,
                           const std::map<BodyPair, std::vector<Impact>>& impacts) {
  if (first.size() != impacts.size()) return "not one first time per pair of bodies";
  auto next = impacts.begin();
  for (const FirstImpact& f : first) {
    const auto& [bodies, all] = *next++;
    if (f.bodies != bodies) return "other bodies";
    Impact least{true, false, 2, 2};
    for (const Impact& impact : all) {
      least.starts_in_contact |= impact.starts_in_contact;
      least.earliest = std::min(least.earliest, impact.earliest);
      least.latest = std::min(least.latest, impact.latest);
    }
    if (f.starts_in_contact != least.starts_in_contact) return "not as it starts";
    if (f.starts_in_contact && (f.earliest != 0 || f.latest != 0)) return "a start that is not 0";
    if (!(0 <= f.earliest && f.earliest <= f.latest && f.latest <= 1)) return "no interval";
    if (f.latest - f.earliest > kImpactTimeWidth) return "too wide an interval";
    // Both certify the same number.
    if (f.earliest > least.latest || f.latest < least.earliest) return "another time";
  }
  return "";
}

std::string fault(const oracle::StepTruth& truth, const ExactBruteForce& expected) {
  const ContactSet &got = truth.contacts, &all = expected.contacts;
  if (got.impact_vertices != all.impact_vertices) return "vertices";
  if (got.impact_edges != all.impact_edges) return "edges";
  if (got.impact_triangles != all.impact_triangles) return "triangles";
  if (got.self_impact_vertices != all.self_impact_vertices) return "own vertices";
  if (got.self_impact_edges != all.self_impact_edges) return "own edges";
  for (const BodyImpact& impact : got.impacts)
    if (impact.time) return "a time in the lists";
  return fault_of_times(truth.first, expected.impacts);
}

/// Pasteable: the vertices at both ends, and the triangles.
std::string text(const StepScene& scene) {
  std::string out = scene.name;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    out += "\nbody " + std::to_string(b);
    for (const Triangle& t : scene.bodies[b].shape->mesh.triangles)
      out += " {" + std::to_string(t[0]) + "," + std::to_string(t[1]) + "," + std::to_string(t[2]) +
             "}";
    for (std::size_t v = 0; v < scene.start.vertices[b].size(); ++v) {
      out += "\n ";
      for (const FrameData* data : {&scene.start, &scene.end})
        for (int k = 0; k < 3; ++k) out += " " + std::to_string(data->vertices[b][v][k]);
    }
  }
  return out;
}

struct Seen {
  std::size_t steps = 0, apart = 0, at_start = 0, later = 0, at_end = 0, starts_alone = 0, own = 0;
};

/// False after a fault.
bool agree(const StepScene& scene, Seen& seen) {
  const ExactBruteForce expected(scene);
  oracle::StepOracle oracle(scene.bodies);
  const oracle::StepTruth truth = oracle.judge(scene.step(), expected.at_start, kBoth);
  const std::string wrong = fault(truth, expected);
  EXPECT_EQ(wrong, "") << (wrong.empty() ? "" : text(scene));
  ++seen.steps;
  if (truth.first.empty()) ++seen.apart;
  for (const FirstImpact& first : truth.first) {
    ++(first.starts_in_contact ? seen.at_start : seen.later);
    if (first.latest == 1) ++seen.at_end;
  }
  // The step has contacts at its start that no vertex and no edge has.
  if (truth.contacts.impact_vertices.empty() && truth.contacts.impact_edges.empty())
    seen.starts_alone += truth.contacts.impact_triangles.size();
  seen.own += truth.contacts.self_impact_vertices.size() + truth.contacts.self_impact_edges.size();
  return wrong.empty();
}

/// Of tetrahedra or octahedra whose vertices all are whole numbers up to a limit.
StepScene draw_small(TriangleSource& random) {
  const int limit = 1 + random.below(3);
  std::vector<Body> bodies;
  NodesOfBodies start, end;
  for (int b = 0; b < 2; ++b) {
    TriangleMesh mesh = sphere_mesh(Vec3::Zero(), 1.0, 0);
    if (random.below(3) != 0) {
      mesh.vertices.resize(4);
      mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    }
    const auto places = [&] {
      std::vector<Vec3> out;
      for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
        out.push_back(random.grid_point(limit));
      return out;
    };
    const Vec3 apart(b * random.below(4), 0, 0);
    start.push_back(places());
    end.push_back(places());
    if (random.below(4) == 0) end.back() = start.back();
    const Vec3 by = random.grid_point(2);
    for (Vec3& v : start.back()) v += apart;
    for (Vec3& v : end.back()) v += apart + by;
    if (random.below(8) == 0) end.back() = start.back();
    bodies.push_back({"small", make_bare_shape(mesh)});
  }
  return make_step_scene("small", std::move(bodies), std::move(start), std::move(end));
}

TEST(StepTruth, ThousandsOfSmallStepsOnGridsAgreeWithBruteForce) {
  TriangleSource random(901);
  Seen seen;
  while (seen.steps < 2000)
    if (!agree(draw_small(random), seen)) return;
  EXPECT_GT(seen.apart, 100u);
  EXPECT_GT(seen.at_start, 300u);
  EXPECT_GT(seen.later, 200u);
  EXPECT_GT(seen.at_end, 20u);
  EXPECT_GT(seen.own, 1000u);
}

TEST(StepTruth, DrawnScenesAgreeWithBruteForce) {
  TriangleSource random(902);
  Seen seen;
  for (const StepFamily family : kStepFamilies) {
    const int rounds = family == StepFamily::kGrid || family == StepFamily::kDegenerate ? 10 : 1;
    for (int round = 0; round < rounds; ++round) {
      const StepScene scene = draw_step_scene(random, family);
      std::size_t triangles = 0;
      for (const Body& body : scene.bodies) triangles += body.shape->mesh.triangles.size();
      if (triangles > 160) continue;
      if (!agree(scene, seen)) return;
    }
  }
  EXPECT_GT(seen.steps, 25u);
  EXPECT_GT(seen.own, 100u);
}

// Instances of one shape of 64 triangles.
TEST(StepTruth, LargerBodiesAgreeWithBruteForce) {
  TriangleSource random(903);
  Seen seen;
  const Body torus = make_body("torus", small_torus(true), {3, 3, 2});
  const std::vector<Body> bodies = {torus, torus};
  while (seen.steps < 24) {
    NodesOfBodies start, end;
    for (const Body& body : bodies) {
      const Vec3 from = random.point(Vec3::Zero(), 1.5), to = from + random.point(Vec3::Zero(), 2);
      start.emplace_back(), end.emplace_back();
      for (const Vec3& node : rest_nodes_at(*body.shape, Vec3::Zero())) {
        start.back().push_back(node + from);
        end.back().push_back(random.point(node + to, 0.4));
      }
    }
    if (!agree(make_step_scene("larger", bodies, std::move(start), std::move(end)), seen)) return;
  }
  EXPECT_GT(seen.at_start, 3u);
  EXPECT_GT(seen.later, 3u);
}

// Backwards the same vertices, triangles and edges meet.
TEST(StepTruth, BackwardsTheSameElementsMeet) {
  TriangleSource random(904);
  for (int round = 0; round < 300; ++round) {
    const StepScene scene =
        round % 4 == 0 ? draw_step_scene(random, StepFamily::kDegenerate) : draw_small(random);
    const StepScene back = reversed(scene);
    oracle::StepOracle oracle(scene.bodies);
    // Pairs that touch at the start are not asked about.
    const oracle::StepTruth one = oracle.judge(scene.step(), {}, kBoth);
    const oracle::StepTruth other = oracle.judge(back.step(), {}, kBoth);
    ASSERT_EQ(one.contacts.impact_vertices, other.contacts.impact_vertices) << text(scene);
    ASSERT_EQ(one.contacts.impact_edges, other.contacts.impact_edges) << text(scene);
    ASSERT_EQ(one.contacts.impact_triangles, other.contacts.impact_triangles) << text(scene);
    ASSERT_EQ(one.contacts.self_impact_vertices, other.contacts.self_impact_vertices);
    ASSERT_EQ(one.contacts.self_impact_edges, other.contacts.self_impact_edges);
  }
}

// A step without motion has the contacts of its frame.
TEST(StepTruth, StepWithoutMotionHasTheTruthOfTheFrame) {
  TriangleSource random(905);
  std::size_t contacts = 0;
  for (int round = 0; round < 200; ++round) {
    StepScene scene =
        round % 2 == 0 ? draw_small(random) : draw_step_scene(random, StepFamily::kDegenerate);
    scene.end = scene.start;
    oracle::Oracle frames(scene.bodies);
    oracle::StepOracle steps(scene.bodies);
    const ContactSet frame = frames.judge(scene.start.frame(), {}).surface;
    const oracle::StepTruth truth = steps.judge(scene.step(), frame.triangles, {});
    ASSERT_EQ(truth.contacts.impact_triangles, frame.triangles) << text(scene);
    ASSERT_EQ(truth.contacts.impact_triangles, ExactBruteForce(scene).at_start) << text(scene);
    ASSERT_EQ(truth.first.size(), frame.bodies.size());
    for (std::size_t i = 0; i < truth.first.size(); ++i) {
      ASSERT_EQ(truth.first[i].bodies, frame.bodies[i]);
      ASSERT_TRUE(truth.first[i].starts_in_contact);
      ASSERT_EQ(truth.first[i].latest, 0.0);
    }
    contacts += frame.triangles.size();
  }
  EXPECT_GT(contacts, 1000u);
}

TEST(StepTruth, OneOracleJudgesStepsInAnyOrder) {
  TriangleSource random(906);
  const StepScene one = draw_step_scene(random, StepFamily::kSlow);
  const StepScene back = reversed(one);
  oracle::Oracle frames(one.bodies);
  const auto at_start = [&](const StepScene& scene) {
    return frames.judge(scene.start.frame(), {}).surface.triangles;
  };
  oracle::StepOracle oracle(one.bodies);
  for (const StepScene* scene : {&one, &back, &one, &one, &back}) {
    oracle::StepOracle fresh(one.bodies);
    const oracle::StepTruth got = oracle.judge(scene->step(), at_start(*scene), kBoth);
    const oracle::StepTruth expected = fresh.judge(scene->step(), at_start(*scene), kBoth);
    EXPECT_EQ(got.contacts.impact_triangles, expected.contacts.impact_triangles);
    EXPECT_EQ(got.contacts.impact_edges, expected.contacts.impact_edges);
    EXPECT_EQ(got.contacts.self_impact_edges, expected.contacts.self_impact_edges);
  }
}

TEST(StepTruth, OnlyWantedKindsAreJudged) {
  TriangleSource random(907);
  StepScene scene = draw_step_scene(random, StepFamily::kWelded);
  oracle::StepOracle oracle(scene.bodies);
  const oracle::StepTruth own = oracle.judge(scene.step(), {}, {false, true});
  EXPECT_THAT(own.first, IsEmpty());
  EXPECT_THAT(own.contacts.impact_edges, IsEmpty());
  EXPECT_FALSE(own.contacts.self_impact_edges.empty());
  const oracle::StepTruth between = oracle.judge(scene.step(), {}, {true, false});
  EXPECT_FALSE(between.contacts.impact_edges.empty());
  EXPECT_THAT(between.contacts.self_impact_edges, IsEmpty());
  EXPECT_THAT(between.contacts.self_impact_vertices, IsEmpty());
}

/// Two triangles, of which the second moves by `by`.
StepScene two_triangles(const TriangleMesh& still, const TriangleMesh& moving, const Vec3& by) {
  std::vector<Vec3> last = moving.vertices;
  for (Vec3& v : last) v += by;
  return make_step_scene("two", {{"a", make_bare_shape(still)}, {"b", make_bare_shape(moving)}},
                         {still.vertices, moving.vertices}, {still.vertices, last});
}

oracle::StepTruth judged(const StepScene& scene) {
  oracle::Oracle frames(scene.bodies);
  oracle::StepOracle steps(scene.bodies);
  return steps.judge(scene.step(), frames.judge(scene.start.frame(), {}).surface.triangles, kBoth);
}

// Both triangles pierce each other, and no vertex and no edge ever touches.
TEST(StepTruth, PiercingAtTheStartIsContactWithoutElements) {
  const StepScene scene =
      two_triangles(triangle_mesh(Vec3(-9, -9, 0), Vec3(9, -9, 0), Vec3(0, 9, 0)),
                    triangle_mesh(Vec3(0, 0, -4), Vec3(1, 0, 4), Vec3(-1, 0, 4)), Vec3(0, 0.5, 0));
  const oracle::StepTruth truth = judged(scene);
  EXPECT_THAT(truth.contacts.impact_triangles, ElementsAre(ElementPair{0, 1, 0, 0}));
  EXPECT_THAT(truth.contacts.impact_vertices, IsEmpty());
  EXPECT_THAT(truth.contacts.impact_edges, IsEmpty());
  ASSERT_THAT(truth.first, SizeIs(1));
  EXPECT_TRUE(truth.first[0].starts_in_contact);
}

TEST(StepTruth, FirstTimesByHand) {
  const TriangleMesh floor = triangle_mesh(Vec3(-9, -9, 0), Vec3(9, -9, 0), Vec3(0, 9, 0));
  const TriangleMesh tip = triangle_mesh(Vec3(0, 0, 1), Vec3(1, 0, 5), Vec3(-1, 0, 5));
  const auto first_time = [&](const Vec3& by) {
    return judged(two_triangles(floor, tip, by)).first;
  };
  EXPECT_THAT(first_time(Vec3(0, 0, 2)), IsEmpty());
  EXPECT_THAT(first_time(Vec3(0, 0, -0.999)), IsEmpty());
  for (const double depth : {1.0, 2.0, 3.0, 100.0}) {  // beyond 6 it has tunnelled
    const std::vector<FirstImpact> first = first_time(Vec3(0, 0, -depth));
    ASSERT_THAT(first, SizeIs(1));
    EXPECT_FALSE(first[0].starts_in_contact);
    EXPECT_LE(first[0].earliest, 1 / depth);
    EXPECT_GE(first[0].latest, 1 / depth);
  }
}

}  // namespace
}  // namespace contactcheck::test::step_truth
