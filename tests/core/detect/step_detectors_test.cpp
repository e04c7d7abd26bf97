// Detectors of contact within steps against brute force over all pairs of elements.

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include "core/detect/registry.h"
#include "core/lazy/kernels.h"
#include "core/narrow/impact.h"
#include "core/narrow/triangle_triangle.h"
#include "core/types/mesh_edges.h"
#include "tests/support/step_scenes.h"

namespace contactcheck::step_detectors {
namespace {

using test::draw_step_scene;
using test::FrameData;
using test::Graze;
using test::StepFamily;
using test::StepScene;
using test::TriangleSource;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// The interval of the first time of two bodies.
struct FirstTime {
  double earliest = 2, latest = 2;
};

struct StepTruth {
  ContactSet contacts;  ///< canonical; impacts without times
  std::map<BodyPair, FirstTime> first;
};

/// By the definitions of the levels alone: no boxes, no trees, no owners of elements.
class BruteForce {
 public:
  explicit BruteForce(const StepScene& scene) : scene_(scene) {
    for (const Body& body : scene.bodies) edges_.push_back(mesh_edges(mesh(body).triangles));
  }

  StepTruth judge() {
    const auto count = static_cast<std::uint32_t>(scene_.bodies.size());
    for (std::uint32_t a = 0; a < count; ++a) {
      judge_own(a);
      for (std::uint32_t b = a + 1; b < count; ++b) judge_pair(a, b);
    }
    truth_.contacts.canonicalize();
    return truth_;
  }

 private:
  using Table = std::vector<std::vector<char>>;

  static const TriangleMesh& mesh(const Body& body) { return body.shape->mesh; }
  const TriangleMesh& mesh(std::uint32_t body) const { return mesh(scene_.bodies[body]); }
  const Vec3& start(std::uint32_t body, std::uint32_t v) const {
    return scene_.start.vertices[body][v];
  }
  const Vec3& end(std::uint32_t body, std::uint32_t v) const {
    return scene_.end.vertices[body][v];
  }
  TrianglePoints corners(std::uint32_t body, std::uint32_t t) const {
    const Triangle& of = mesh(body).triangles[t];
    return {start(body, of[0]), start(body, of[1]), start(body, of[2])};
  }

  Impact vertex_face(std::uint32_t a, std::uint32_t v, std::uint32_t b, std::uint32_t t) const {
    const Triangle& of = mesh(b).triangles[t];
    return find_impact({ImpactKind::vertex_triangle,
                        {start(a, v), start(b, of[0]), start(b, of[1]), start(b, of[2])},
                        {end(a, v), end(b, of[0]), end(b, of[1]), end(b, of[2])}});
  }
  Impact edge_edge(std::uint32_t a, const Edge& e, std::uint32_t b, const Edge& f) const {
    return find_impact({ImpactKind::edge_edge,
                        {start(a, e[0]), start(a, e[1]), start(b, f[0]), start(b, f[1])},
                        {end(a, e[0]), end(a, e[1]), end(b, f[0]), end(b, f[1])}});
  }

  Table vertices_with_faces(std::uint32_t a, std::uint32_t b, FirstTime& first) {
    Table table(mesh(a).vertices.size(), std::vector<char>(mesh(b).triangles.size()));
    for (std::uint32_t v = 0; v < table.size(); ++v)
      for (std::uint32_t t = 0; t < table[v].size(); ++t) {
        const Impact impact = vertex_face(a, v, b, t);
        if (!impact.contact) continue;
        table[v][t] = 1;
        note(impact, first);
        truth_.contacts.impact_vertices.push_back({a, b, v, t});
      }
    return table;
  }

  static void note(const Impact& impact, FirstTime& first) {
    first.earliest = std::min(first.earliest, impact.earliest);
    first.latest = std::min(first.latest, impact.latest);
  }

  void judge_pair(std::uint32_t a, std::uint32_t b) {
    FirstTime first;
    const Table ab = vertices_with_faces(a, b, first), ba = vertices_with_faces(b, a, first);
    Table edges(edges_[a].edges.size(), std::vector<char>(edges_[b].edges.size()));
    for (std::uint32_t e = 0; e < edges.size(); ++e)
      for (std::uint32_t f = 0; f < edges[e].size(); ++f) {
        const Impact impact = edge_edge(a, edges_[a].edges[e], b, edges_[b].edges[f]);
        if (!impact.contact) continue;
        edges[e][f] = 1;
        note(impact, first);
        truth_.contacts.impact_edges.push_back({a, b, e, f});
      }
    for (std::uint32_t s = 0; s < mesh(a).triangles.size(); ++s)
      for (std::uint32_t t = 0; t < mesh(b).triangles.size(); ++t) {
        const bool touch = triangles_intersect(corners(a, s), corners(b, t));
        if (touch) first = {0, 0};
        bool meet = touch;
        for (std::size_t i = 0; i < 3; ++i) {
          meet |= ab[mesh(a).triangles[s][i]][t] != 0 || ba[mesh(b).triangles[t][i]][s] != 0;
          for (std::size_t j = 0; j < 3; ++j) {
            const std::uint32_t e = edges_[a].of_triangle[s][i], f = edges_[b].of_triangle[t][j];
            meet |= e != MeshEdges::kNone && f != MeshEdges::kNone && edges[e][f] != 0;
          }
        }
        if (meet) truth_.contacts.impact_triangles.push_back({a, b, s, t});
      }
    if (first.earliest <= 1) truth_.first[{a, b}] = first;
  }

  /// The first vertex at the same place at rest, where the body is welded.
  std::uint32_t place(std::uint32_t body, std::uint32_t v) const {
    if (scene_.bodies[body].shape->welded.empty()) return v;
    const std::vector<Vec3>& rest = mesh(body).vertices;
    return static_cast<std::uint32_t>(std::find(rest.begin(), rest.end(), rest[v]) - rest.begin());
  }

  void judge_own(std::uint32_t body) {
    std::vector<std::uint32_t> places;
    for (std::uint32_t v = 0; v < mesh(body).vertices.size(); ++v) places.push_back(place(body, v));
    const auto share = [&](const auto& some, const auto& others) {
      for (const std::uint32_t v : some)
        for (const std::uint32_t w : others)
          if (places[v] == places[w]) return true;
      return false;
    };
    for (std::uint32_t v = 0; v < places.size(); ++v)
      for (std::uint32_t t = 0; t < mesh(body).triangles.size(); ++t)
        if (!share(std::array{v}, mesh(body).triangles[t]) && vertex_face(body, v, body, t).contact)
          truth_.contacts.self_impact_vertices.push_back({body, body, v, t});
    const std::vector<Edge>& edges = edges_[body].edges;
    for (std::uint32_t e = 0; e < edges.size(); ++e)
      for (std::uint32_t f = e + 1; f < edges.size(); ++f)
        if (!share(edges[e], edges[f]) && edge_edge(body, edges[e], body, edges[f]).contact)
          truth_.contacts.self_impact_edges.push_back({body, e, f});
  }

  const StepScene& scene_;
  std::vector<MeshEdges> edges_;
  StepTruth truth_;
};

std::vector<std::string> detectors() {
  std::vector<std::string> names = {
      "swept-aabb",         "ffd-lazy",   "ffd-lazy:bounds=nodes,threads=2",
      "ffd-lazy:threads=2", "full-refit", "full-refit:threads=2"};
  for (const std::string& isa : lazy_isas()) names.push_back("ffd-lazy:bounds=nodes,isa=" + isa);
  return names;
}

/// Of `scene`'s detectors those that answer questions of frames, too.
std::vector<std::string> detectors_of_frames() {
  std::vector<std::string> names = detectors();
  std::erase(names, "swept-aabb");
  return names;
}

std::unique_ptr<Detector> made(const std::string& name) {
  static const DetectorCatalog catalog = [] {
    DetectorCatalog all;
    register_core_detectors(all);
    return all;
  }();
  return catalog.make(catalog.parse(name));
}

std::unique_ptr<Detector> prepared(const std::string& name, const std::vector<Body>& bodies) {
  std::unique_ptr<Detector> detector = made(name);
  detector->prepare(bodies);
  return detector;
}

/// To both questions. The step is gone when these are asked; its states are not.
ContactSet answer(Detector& detector, const StepScene& scene) {
  detector.update_step(scene.step());
  ContactSet out, own;
  detector.query(Question::kImpacts, out);
  detector.query(Question::kSelfImpacts, own);
  EXPECT_THAT(own.impact_triangles, IsEmpty());
  EXPECT_THAT(own.impacts, IsEmpty());
  EXPECT_TRUE(out.self_impact_vertices.empty() && out.self_impact_edges.empty());
  out.self_impact_vertices = own.self_impact_vertices;
  out.self_impact_edges = own.self_impact_edges;
  out.canonicalize();
  return out;
}

ContactSet answer(const std::string& name, const StepScene& scene) {
  return answer(*prepared(name, scene.bodies), scene);
}

template <typename Record>
std::string difference(const char* list, const std::vector<Record>& got,
                       const std::vector<Record>& expected) {
  std::vector<Record> missed, spurious;
  std::set_difference(expected.begin(), expected.end(), got.begin(), got.end(),
                      std::back_inserter(missed));
  std::set_difference(got.begin(), got.end(), expected.begin(), expected.end(),
                      std::back_inserter(spurious));
  if (missed.empty() && spurious.empty() && got.size() == expected.size()) return "";
  std::string out = std::string(list) + ": " + std::to_string(missed.size()) + " of " +
                    std::to_string(expected.size()) + " missed, " +
                    std::to_string(spurious.size()) + " spurious, first:";
  for (const std::uint32_t id : (missed.empty() ? spurious : missed).front().ids())
    out += " " + std::to_string(id);
  return out + "\n";
}

/// How two answers differ in their sets; empty: not at all. Times are left out.
std::string difference(const ContactSet& got, const ContactSet& expected) {
  const auto bodies = [](const ContactSet& set) {
    std::vector<BodyPair> out;
    for (const BodyImpact& impact : set.impacts) out.push_back(impact.bodies);
    return out;
  };
  const auto pairs = [](const std::vector<BodyPair>& list) {
    std::vector<SelfPair> out;
    for (const BodyPair& pair : list) out.push_back({0, pair.a, pair.b});
    return out;
  };
  return difference("bodies", pairs(bodies(got)), pairs(bodies(expected))) +
         difference("triangles", got.impact_triangles, expected.impact_triangles) +
         difference("vertices", got.impact_vertices, expected.impact_vertices) +
         difference("edges", got.impact_edges, expected.impact_edges) +
         difference("own vertices", got.self_impact_vertices, expected.self_impact_vertices) +
         difference("own edges", got.self_impact_edges, expected.self_impact_edges);
}

/// What is wrong with an answer; empty if nothing is.
std::string fault(const ContactSet& got, const StepTruth& truth) {
  std::string out = difference(got, truth.contacts);
  for (const BodyImpact& impact : got.impacts) {
    const auto found = truth.first.find(impact.bodies);
    if (found == truth.first.end()) continue;  // said above
    if (!impact.time) {
      out += "no time\n";
    } else if (!(*impact.time >= found->second.earliest - kImpactTimeWidth &&
                 *impact.time <= found->second.latest)) {
      out += "first at " + std::to_string(*impact.time) + ", not " +
             std::to_string(found->second.earliest) + "\n";
    }
  }
  return out;
}

std::vector<double> times(const ContactSet& set) {
  std::vector<double> out;
  for (const BodyImpact& impact : set.impacts) out.push_back(impact.time.value_or(-1));
  return out;
}

/// Asks all detectors. False after a fault.
bool all_agree(const StepScene& scene, const StepTruth& truth, const std::string& where) {
  std::optional<std::vector<double>> same_times;
  for (const std::string& name : detectors()) {
    const ContactSet got = answer(name, scene);
    const std::string wrong = fault(got, truth);
    EXPECT_EQ(wrong, "") << where << " " << name;
    if (same_times) {
      EXPECT_EQ(times(got), *same_times) << where << " " << name;
    }
    same_times = times(got);
  }
  return !testing::Test::HasFailure();
}

/// How often what a test is about occurred.
struct Seen {
  std::size_t steps = 0, apart = 0, at_start = 0, later = 0;
  std::size_t vertices = 0, edges = 0, own_vertices = 0, own_edges = 0;
  void add(const StepTruth& truth) {
    ++steps;
    apart += truth.first.empty() ? 1u : 0u;
    for (const auto& [bodies, first] : truth.first) (first.latest == 0 ? at_start : later) += 1;
    vertices += truth.contacts.impact_vertices.size();
    edges += truth.contacts.impact_edges.size();
    own_vertices += truth.contacts.self_impact_vertices.size();
    own_edges += truth.contacts.self_impact_edges.size();
  }
};

class StepFamilies : public ::testing::TestWithParam<StepFamily> {};

INSTANTIATE_TEST_SUITE_P(All, StepFamilies, ::testing::ValuesIn(test::kStepFamilies),
                         [](const auto& parameter) {
                           std::string name = test::name_of(parameter.param);
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

TEST_P(StepFamilies, AllDetectorsAgreeWithBruteForceAndBackwards) {
  const StepFamily family = GetParam();
  const bool small = family == StepFamily::kGrid || family == StepFamily::kDegenerate;
  TriangleSource random(810 + static_cast<std::uint64_t>(family));
  Seen seen;
  // Where the bodies meet in flat states, exact arithmetic takes its time.
  const int rounds = small ? 40 : family == StepFamily::kWelded ? 5 : 30;
  for (int round = 0; round < rounds; ++round) {
    const StepScene scene = draw_step_scene(random, family);
    const std::string where = scene.name + " " + std::to_string(round);
    const StepTruth truth = BruteForce(scene).judge();
    if (!all_agree(scene, truth, where)) return;
    seen.add(truth);
    // Vertices, triangles and edges meet backwards as well; pairs of triangles that touch at t = 0
    // alone in the middle of both do not.
    const StepScene back = reversed(scene);
    ContactSet got = answer("ffd-lazy:bounds=nodes", back), expected = truth.contacts;
    got.impact_triangles.clear(), expected.impact_triangles.clear();
    got.impacts.clear(), expected.impacts.clear();
    ASSERT_EQ(difference(got, expected), "") << where;
    ASSERT_EQ(fault(answer("swept-aabb", back), BruteForce(back).judge()), "") << where;
  }
  EXPECT_GE(seen.at_start, family == StepFamily::kWelded ? 2u : 5u);
  if (family == StepFamily::kAtRest) return;
  const bool later = family != StepFamily::kInContact && family != StepFamily::kFolding;
  EXPECT_GE(seen.later, later ? 3u : 0u);
  EXPECT_GE(seen.vertices, 50u);
  EXPECT_GE(seen.edges, 200u);
  if (family == StepFamily::kFolding || family == StepFamily::kWelded || small) {
    EXPECT_GE(seen.own_vertices, 20u);
    EXPECT_GE(seen.own_edges, 20u);
  }
}

/// Adds an offset to all nodes at each end.
StepScene moved(const StepScene& scene, const Vec3& at_start, const Vec3& at_end) {
  test::NodesOfBodies start = scene.start.nodes, end = scene.end.nodes;
  for (std::vector<Vec3>& nodes : start)
    for (Vec3& node : nodes) node += at_start;
  for (std::vector<Vec3>& nodes : end)
    for (Vec3& node : nodes) node += at_end;
  return test::make_step_scene(scene.name, scene.bodies, std::move(start), std::move(end));
}

StepScene scaled(const StepScene& scene, double factor) {
  test::NodesOfBodies start = scene.start.nodes, end = scene.end.nodes;
  for (test::NodesOfBodies* all : {&start, &end})
    for (std::vector<Vec3>& nodes : *all)
      for (Vec3& node : nodes) node *= factor;
  return test::make_step_scene(scene.name, scene.bodies, std::move(start), std::move(end));
}

// Whole numbers stay such: nothing is rounded, and the answers are the same.
TEST(StepDetectors, ExactTranslationsAndScalesChangeNothing) {
  TriangleSource random(830);
  for (int round = 0; round < 12; ++round) {
    const StepScene scene =
        draw_step_scene(random, round % 2 == 0 ? StepFamily::kGrid : StepFamily::kDegenerate);
    const StepTruth truth = BruteForce(scene).judge();
    const Vec3 far(0x1p40, -0x1p30, 0x1p20), fast(-0x1p33, 0x1p41, 0x1p10);
    const std::vector<StepScene> same = {moved(scene, far, far),  moved(scene, Vec3::Zero(), fast),
                                         moved(scene, far, fast), scaled(scene, 0x1p-600),
                                         scaled(scene, 0x1p600),  scaled(scene, 0x1p-1060)};
    for (std::size_t i = 0; i < same.size(); ++i)
      for (const char* name : {"swept-aabb", "ffd-lazy:bounds=nodes", "full-refit"})
        ASSERT_EQ(fault(answer(name, same[i]), truth), "")
            << scene.name << " " << round << " " << i << " " << name;
  }
}

TEST(StepDetectors, OrderOfTheBodiesChangesNothing) {
  TriangleSource random(831);
  for (const StepFamily family :
       {StepFamily::kSlow, StepFamily::kTogetherTurning, StepFamily::kGrid, StepFamily::kFast}) {
    const StepScene scene = draw_step_scene(random, family);
    StepScene turned = scene;
    const auto turn = [](auto& list) { std::reverse(list.begin(), list.end()); };
    turn(turned.bodies);
    for (FrameData* data : {&turned.start, &turned.end}) turn(data->nodes), turn(data->vertices);
    const auto last = static_cast<std::uint32_t>(scene.bodies.size() - 1);
    for (const std::string& name : detectors()) {
      ContactSet got = answer(name, turned);
      for (BodyImpact& i : got.impacts) i.bodies = {last - i.bodies.a, last - i.bodies.b};
      for (std::vector<ElementPair>* list : {&got.impact_triangles, &got.impact_edges})
        for (ElementPair& p : *list) p.body_a = last - p.body_a, p.body_b = last - p.body_b;
      for (std::vector<NearPair>* list : {&got.impact_vertices, &got.self_impact_vertices})
        for (NearPair& p : *list) p.body = last - p.body, p.other = last - p.other;
      for (SelfPair& p : got.self_impact_edges) p.body = last - p.body;
      got.canonicalize();
      EXPECT_EQ(difference(got, answer(name, scene)), "") << scene.name << " " << name;
    }
  }
}

// A step without motion is a frame: triangles meet that touch.
TEST(StepDetectors, StepWithoutMotionIsAFrame) {
  TriangleSource random(832);
  std::size_t contacts = 0;
  for (const StepFamily family : {StepFamily::kAtRest, StepFamily::kInContact, StepFamily::kGrid,
                                  StepFamily::kDegenerate, StepFamily::kFar})
    for (int round = 0; round < 4; ++round) {
      StepScene scene = draw_step_scene(random, family);
      scene.end = scene.start;
      for (const std::string& name : detectors_of_frames()) {
        const auto detector = prepared(name, scene.bodies);
        const ContactSet in_step = answer(*detector, scene);
        const Frame frame = scene.start.frame();
        detector->update(frame);
        ContactSet in_frame;
        detector->query(Question::kTriangles, in_frame);
        in_frame.canonicalize();
        ASSERT_EQ(in_step.impact_triangles, in_frame.triangles) << scene.name << " " << name;
        for (const double time : times(in_step)) ASSERT_EQ(time, 0.0);
        contacts += in_frame.triangles.size();
      }
    }
  EXPECT_GT(contacts, 1000u);
}

/// The bodies of a scene at four moments, any two of which make a step.
struct Moments {
  std::vector<Body> bodies;
  std::vector<FrameData> frames;
  StepScene step(std::size_t from, std::size_t to) const {
    return {"step", bodies, frames[from], frames[to]};
  }
};

Moments draw_moments(TriangleSource& random, StepFamily family) {
  const StepScene first = draw_step_scene(random, family);
  Moments out{first.bodies, {first.start, first.end}};
  for (int i = 0; i < 2; ++i) {
    test::NodesOfBodies nodes = first.end.nodes;
    const Vec3 all = random.point(Vec3::Zero(), 1.0);
    for (std::vector<Vec3>& body : nodes) {
      const Vec3 by = all + random.point(Vec3::Zero(), 1.0);
      for (Vec3& node : body) node = random.point(node + by, 0.1);
    }
    out.frames.push_back(test::make_frame(out.bodies, std::move(nodes)));
  }
  return out;
}

TEST(StepDetectors, StepsInAnyOrderGiveTheAnswersOfFreshDetectors) {
  constexpr std::size_t kSteps[][2] = {{0, 1}, {2, 3}, {0, 1}, {0, 1}, {1, 0}, {1, 2},
                                       {3, 3}, {2, 3}, {0, 3}, {3, 0}, {0, 1}};
  TriangleSource random(833);
  for (const StepFamily family : {StepFamily::kSlow, StepFamily::kFast, StepFamily::kTogether}) {
    const Moments moments = draw_moments(random, family);
    for (const std::string& name : detectors()) {
      const auto detector = prepared(name, moments.bodies);
      for (const auto& [from, to] : kSteps) {
        const StepScene step = moments.step(from, to);
        const ContactSet got = answer(*detector, step), fresh = answer(name, step);
        ASSERT_EQ(difference(got, fresh), "") << name << " " << from << " to " << to;
        ASSERT_EQ(times(got), times(fresh)) << name;
      }
    }
  }
}

ContactSet answer_in_a_row(Detector& detector, const StepScene& scene, bool follows, bool own) {
  Step step = test::given_to(detector, scene.step());
  step.follows = follows;
  detector.update_step(step);
  ContactSet out;
  detector.query(Question::kImpacts, out);
  if (own) detector.query(Question::kSelfImpacts, out);
  out.canonicalize();
  return out;
}

// Which bodies are mapped depends on the question: of a body with itself, all.
TEST(StepDetectors, StepsThatFollowGiveTheAnswersOfFreshDetectors) {
  constexpr std::size_t kFrames[] = {0, 1, 2, 3, 3, 0, 2, 1, 0, 3};
  TriangleSource random(837);
  std::size_t contacts = 0, none = 0;
  for (const StepFamily family :
       {StepFamily::kSlow, StepFamily::kFast, StepFamily::kTogether, StepFamily::kTwisting}) {
    const Moments moments = draw_moments(random, family);
    for (const std::string& name : detectors())
      for (const std::size_t own_each : {1, 2, 100}) {
        const auto detector = prepared(name, moments.bodies);
        for (std::size_t i = 0; i + 1 < std::size(kFrames); ++i) {
          const StepScene step = moments.step(kFrames[i], kFrames[i + 1]);
          const bool own = i % own_each == 0;
          const ContactSet got = answer_in_a_row(*detector, step, i > 0, own),
                           fresh =
                               answer_in_a_row(*prepared(name, moments.bodies), step, false, own);
          ASSERT_EQ(difference(got, fresh), "") << name << " step " << i;
          ASSERT_EQ(times(got), times(fresh)) << name << " step " << i;
          ++(got.impacts.empty() ? none : contacts);
        }
      }
  }
  EXPECT_GT(contacts, 100u);
  EXPECT_GT(none, 20u);
}

TEST(StepDetectors, RepeatedAndLeftOutQuestionsChangeNothing) {
  TriangleSource random(834);
  const StepScene scene = draw_step_scene(random, StepFamily::kWelded);
  for (const std::string& name : detectors()) {
    const ContactSet all = answer(name, scene);
    const auto detector = prepared(name, scene.bodies);
    const auto ask = [&](Question question) {
      ContactSet out;
      detector->query(question, out);
      out.canonicalize();
      return out;
    };
    detector->update_step(scene.step());
    const ContactSet own = ask(Question::kSelfImpacts), own_again = ask(Question::kSelfImpacts);
    const ContactSet between = ask(Question::kImpacts), again = ask(Question::kImpacts);
    EXPECT_EQ(own.self_impact_edges, all.self_impact_edges) << name;
    EXPECT_EQ(own_again.self_impact_edges, all.self_impact_edges) << name;
    EXPECT_EQ(own_again.self_impact_vertices, all.self_impact_vertices) << name;
    for (const ContactSet* set : {&between, &again}) {
      EXPECT_EQ(set->impact_triangles, all.impact_triangles) << name;
      EXPECT_EQ(set->impact_edges, all.impact_edges) << name;
      EXPECT_EQ(times(*set), times(all)) << name;
    }
    detector->update_step(scene.step());
    detector->update_step(scene.step());
    EXPECT_EQ(ask(Question::kSelfImpacts).self_impact_edges, all.self_impact_edges) << name;
  }
}

ContactSet answer_of_frame(Detector& detector, const FrameData& data) {
  const Frame frame = data.frame();
  detector.update(frame);
  ContactSet out;
  detector.query(Question::kTriangles, out);
  detector.query(Question::kSelf, out);
  out.canonicalize();
  return out;
}

TEST(StepDetectors, FramesAndStepsDoNotChangeEachOther) {
  TriangleSource random(835);
  for (const StepFamily family : {StepFamily::kSlow, StepFamily::kTwisting, StepFamily::kFast}) {
    const Moments moments = draw_moments(random, family);
    const StepScene first = moments.step(0, 1), second = moments.step(1, 2);
    for (const std::string& name : detectors_of_frames()) {
      const auto detector = prepared(name, moments.bodies);
      const auto frame_is_right = [&](std::size_t f) {
        const ContactSet got = answer_of_frame(*detector, moments.frames[f]);
        const ContactSet fresh =
            answer_of_frame(*prepared(name, moments.bodies), moments.frames[f]);
        return got.triangles == fresh.triangles && got.self == fresh.self;
      };
      const auto step_is_right = [&](const StepScene& step) {
        const ContactSet got = answer(*detector, step), fresh = answer(name, step);
        return difference(got, fresh).empty() && times(got) == times(fresh);
      };
      EXPECT_TRUE(step_is_right(first)) << name;
      EXPECT_TRUE(frame_is_right(2)) << name;
      EXPECT_TRUE(step_is_right(first)) << name;
      EXPECT_TRUE(frame_is_right(0)) << name;
      EXPECT_TRUE(frame_is_right(2)) << name;
      EXPECT_TRUE(step_is_right(second)) << name;
      EXPECT_TRUE(frame_is_right(2)) << name;
      EXPECT_TRUE(step_is_right(second)) << name;
    }
  }
}

TEST(StepDetectors, ExpectedQuestionsDoNotChangeTheAnswers) {
  TriangleSource random(836);
  const StepScene scene = draw_step_scene(random, StepFamily::kTwisting);
  for (const std::string& name : detectors()) {
    const ContactSet plain = answer(name, scene);
    for (const std::vector<Question>& expected :
         {std::vector<Question>{},
          {Question::kTriangles},
          {Question::kSelf},
          {Question::kImpacts},
          {Question::kSelfImpacts},
          {Question::kTriangles, Question::kImpacts, Question::kSelfImpacts}}) {
      const auto detector = made(name);
      detector->expect(expected);
      detector->prepare(scene.bodies);
      EXPECT_EQ(difference(answer(*detector, scene), plain), "") << name;
      EXPECT_EQ(difference(answer(*detector, scene), plain), "") << name;
    }
  }
}

TEST(StepDetectors, BodiesArePreparedAnew) {
  TriangleSource random(837);
  const StepScene one = draw_step_scene(random, StepFamily::kSlow);
  const StepScene other = draw_step_scene(random, StepFamily::kWelded);
  for (const std::string& name : detectors()) {
    const auto detector = made(name);
    for (const StepScene* scene : {&one, &other, &one}) {
      detector->prepare(scene->bodies);
      EXPECT_EQ(difference(answer(*detector, *scene), answer(name, *scene)), "") << name;
    }
  }
}

TEST(StepDetectors, OneBodyMeetsItselfAlone) {
  TriangleSource random(838);
  StepScene scene = draw_step_scene(random, StepFamily::kFolding);
  scene.bodies.resize(1);
  for (FrameData* data : {&scene.start, &scene.end})
    data->nodes.resize(1), data->vertices.resize(1);
  const StepTruth truth = BruteForce(scene).judge();
  EXPECT_GT(truth.contacts.self_impact_edges.size(), 5u);
  all_agree(scene, truth, "one body");
}

TEST(StepDetectors, ClaimAllLevelsOfSteps) {
  for (const std::string& name : detectors()) {
    const Semantics semantics = made(name)->semantics();
    for (const Level level : kLevels)
      EXPECT_TRUE(!is_impact(level) || semantics.claims(level)) << name << name_of(level);
    EXPECT_TRUE(semantics.answers(Question::kImpacts)) << name;
    EXPECT_TRUE(semantics.answers(Question::kSelfImpacts)) << name;
    EXPECT_TRUE(semantics.exact) << name;
  }
  for (const char* name : {"ffd-lazy:precision=single", "full-refit:precision=single"}) {
    EXPECT_FALSE(any_impact(made(name)->semantics().levels)) << name;
    EXPECT_FALSE(made(name)->semantics().answers(Question::kImpacts)) << name;
  }
}

TEST(StepDetectors, FramesAndStepsAreRefusedWhereNoneIsAnswered) {
  TriangleSource random(839);
  const StepScene scene = draw_step_scene(random, StepFamily::kSlow);
  EXPECT_THROW(prepared("swept-aabb", scene.bodies)->update(scene.start.frame()), std::logic_error);
  EXPECT_THROW(prepared("aabb-tree", scene.bodies)->update_step(scene.step()), std::logic_error);
}

// A tower of powers of two as large as doubles allow: velocities, origins and their sums overflow.
TEST(StepDetectors, NearTheLargestDouble) {
  for (const double size : {0x1p1000, 0x1p1021, 0x1p1022}) {
    test::NodesOfBodies start, end;
    std::vector<Body> bodies;
    for (std::size_t b = 0; b < 2; ++b) {
      const TriangleMesh mesh = test::box_mesh(Vec3::Zero(), Vec3::Ones(), 1);
      const NodeShape shape = make_node_shape(mesh.vertices.size(), mesh.triangles);
      bodies.push_back({"box", shape.shape});
      std::vector<Vec3> first = mesh.vertices, last = mesh.vertices;
      const Vec3 from(b == 0 ? -2.0 : 1.0, 0.25 * static_cast<double>(b), 0.0), to(-from.x(), 0, 0);
      for (Vec3& v : first) v = size * (v + from);
      for (Vec3& v : last) v = size * (v + to);
      start.push_back(shape.nodes_for(first));
      end.push_back(shape.nodes_for(last));
    }
    const StepScene scene =
        test::make_step_scene("huge", std::move(bodies), std::move(start), std::move(end));
    const StepTruth truth = BruteForce(scene).judge();
    EXPECT_EQ(truth.first.size(), 1u);
    if (!all_agree(scene, truth, std::to_string(std::ilogb(size)))) return;
  }
}

// Products of three lengths overflow, of which two are normals' and one is a distance: some to
// infinities of both signs, whose sum is no number. A corner of one triangle lies in the other.
TEST(StepDetectors, ProductsOfThreeLengthsOverflow) {
  for (int exponent = 330; exponent < 360; ++exponent) {
    const double h = std::ldexp(1.0, exponent);
    const std::vector<Vec3> still = {Vec3(0, 0, 0), Vec3(h, -h, 0), Vec3(0, 0, h)};
    const std::vector<Vec3> touching = {h * Vec3(0x1p-7, 0x1p-7, 0), h * Vec3(0.5, -0.5, 0.125),
                                        h * Vec3(0x1p-7, 0x1p-7, 0x1p-6)};
    const auto body = [](const std::vector<Vec3>& at) {
      return Body{"triangle", make_bare_shape(test::triangle_mesh(at[0], at[1], at[2]))};
    };
    const StepScene scene = test::make_step_scene("overflow", {body(still), body(touching)},
                                                  {still, touching}, {still, touching});
    const StepTruth truth = BruteForce(scene).judge();
    EXPECT_EQ(truth.contacts.impact_triangles.size(), 1u);
    if (!all_agree(scene, truth, "2^" + std::to_string(exponent))) return;
  }
}

// Bounds that hold the motion by a hair. Two bodies are brought nearer by bisection until a step
// has the last gap and, a unit in the last place on, the first contact: a bound that is short by
// anything, or leaves out an end, loses it.
struct GrazingBodies {
  std::string name;
  std::vector<Body> bodies;
};

std::vector<GrazingBodies> grazing_bodies() {
  const TriangleMesh box = test::box_mesh(Vec3(-1, -0.75, -0.5), Vec3(1, 0.75, 0.5), 1);
  const TriangleMesh ball = test::sphere_mesh(Vec3::Zero(), 1.0, 1);
  return {
      {"boxes", {test::make_body("a", box, {2, 3, 2}), test::make_body("b", box, {3, 2, 1})}},
      {"box and ball",
       {test::make_body("a", box, {1, 2, 2}), test::make_body("b", ball, {3, 3, 3})}},
      {"bare box and ball", {{"a", make_bare_shape(box)}, test::make_body("b", ball, {2, 2, 2})}}};
}

std::vector<Graze> grazes() {
  TriangleSource random(840);
  std::vector<Graze> out;
  for (int turn = 0; turn < 3; ++turn)
    for (const double together : {0.0, 2000.0})
      for (const auto& [before, after] :
           {std::pair{0.0, 0.0}, std::pair{1.0, 0.0}, std::pair{0.0, 1.0}}) {
        Graze graze;
        if (turn > 0) graze.turned_at_start = test::draw_rotation(random);
        graze.turned_at_end = turn == 2 ? test::draw_rotation(random) : graze.turned_at_start;
        graze.at_start = random.point(Vec3::Zero(), 1.0);
        graze.at_end = graze.at_start + random.point(Vec3::Zero(), together);
        graze.apart_at_start = before;
        graze.apart_at_end = after;
        if (random.below(2) == 0) graze.slide = Vec3(0, random.unit(), 0.3 * random.unit());
        if (random.below(3) == 0) graze.grows = 1.5;
        out.push_back(graze);
      }
  return out;
}

bool meets(Detector& detector, const StepScene& scene) {
  detector.update_step(scene.step());
  ContactSet out;
  detector.query(Question::kImpacts, out);
  return !out.impacts.empty();
}

TEST(StepDetectors, FirstContactBeyondTheLastGapIsFound) {
  for (const auto& [name, bodies] : grazing_bodies()) {
    int number = 0;
    for (const Graze& graze : grazes()) {
      const auto plain = prepared("swept-aabb", bodies);
      double hit = -0.25, miss = 0.25;
      ASSERT_TRUE(meets(*plain, grazing(bodies, graze, hit))) << name << number;
      while (meets(*plain, grazing(bodies, graze, miss)) && miss < 8) miss *= 2;  // it turns
      ASSERT_FALSE(meets(*plain, grazing(bodies, graze, miss))) << name << number;
      while (miss - hit > 0x1p-56) {
        const double middle = 0.5 * (hit + miss);
        if (middle == hit || middle == miss) break;
        (meets(*plain, grazing(bodies, graze, middle)) ? hit : miss) = middle;
      }
      for (const double gap : {hit, miss}) {
        const StepScene scene = grazing(bodies, graze, gap);
        const StepTruth truth = BruteForce(scene).judge();
        ASSERT_EQ(truth.first.empty(), gap == miss);
        const std::string where = name + " " + std::to_string(number) + " at gap " +
                                  std::to_string(gap) + (gap == hit ? ", hit" : ", miss");
        if (!all_agree(scene, truth, where)) return;
      }
      ++number;
    }
  }
}

}  // namespace
}  // namespace contactcheck::step_detectors
