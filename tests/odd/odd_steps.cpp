// Compares the oracle of steps, and the exact detectors of steps, with brute force in rational
// arithmetic over all pairs of elements, forwards and backwards in time:
//   odd_steps [--seed N] [--count N] [--seconds N]
//
//   --seed      of the first step; the next steps have the next seeds (default 1)
//   --count     ends after so many (default: no limit)
//   --seconds   begins no step later (default 10)
//
// Of 101 seeds in a row one is of two bodies of 80 triangles, the others are of two tetrahedra
// whose vertices are whole numbers. Backwards the same elements must meet, and the first time must
// be 1 less the last one forwards. Exit code 1: an answer is wrong. The lines name the seed: --seed
// N
// --count 1 runs that step alone.
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "reference/oracle/oracle.h"
#include "reference/oracle/step_truth.h"
#include "tests/conformance/detectors.h"
#include "tests/odd/seed_arguments.h"
#include "tests/odd/step_brute_force.h"
#include "tests/support/step_scenes.h"

namespace contactcheck::test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::array kDetectors = {"swept-aabb", "full-refit", "ffd-lazy", "embree-swept"};
constexpr std::uint64_t kLargeEvery = 101;

/// A torus of 80 triangles, about 2 wide; its vertices are short binary fractions.
TriangleMesh torus_of_80() {
  constexpr std::array<std::array<double, 2>, 8> kAround = {{{1, 0},
                                                             {0.75, 0.75},
                                                             {0, 1},
                                                             {-0.75, 0.75},
                                                             {-1, 0},
                                                             {-0.75, -0.75},
                                                             {0, -1},
                                                             {0.75, -0.75}}};
  constexpr std::array<std::array<double, 2>, 5> kAcross = {
      {{1, 0}, {0.25, 1}, {-0.75, 0.5}, {-0.75, -0.5}, {0.25, -1}}};
  TriangleMesh mesh;
  for (const auto& u : kAround)
    for (const auto& v : kAcross) {
      const double r = 0.75 + 0.25 * v[0];
      mesh.vertices.emplace_back(r * u[0], r * u[1], 0.25 * v[1]);
    }
  constexpr std::uint32_t kRound = kAround.size(), kTube = kAcross.size();
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    return (i % kRound) * kTube + j % kTube;
  };
  for (std::uint32_t i = 0; i < kRound; ++i)
    for (std::uint32_t j = 0; j < kTube; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

/// Two tetrahedra; their vertices are whole numbers at both ends. Three quarters are in lattices.
StepScene draw_tetrahedra(TriangleSource& random) {
  const std::vector<Triangle> triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  const int limit = 1 + random.below(4);
  const bool bare = random.below(4) == 0;
  std::vector<Body> bodies;
  NodesOfBodies start, end;
  for (int b = 0; b < 2; ++b) {
    const auto places = [&] {
      std::vector<Vec3> out;
      for (int v = 0; v < 4; ++v) out.push_back(random.grid_point(limit));
      return out;
    };
    std::vector<Vec3> first = places(), last = places();
    if (random.below(3) == 0) last = first;  // moves without changing its form
    const Vec3 apart(b * random.below(2 * limit + 1), 0, 0), by = random.grid_point(limit);
    for (Vec3& v : first) v += apart;
    for (Vec3& v : last) v += apart + by;
    if (random.below(8) == 0) last = first;  // rests
    if (bare) {
      bodies.push_back({"bare", make_bare_shape({first, triangles})});
      start.push_back(std::move(first));
      end.push_back(std::move(last));
    } else {
      const NodeShape shape = make_node_shape(4, triangles);
      bodies.push_back({"in a lattice", shape.shape});
      start.push_back(shape.nodes_for(first));
      end.push_back(shape.nodes_for(last));
    }
  }
  return make_step_scene("tetrahedra", std::move(bodies), std::move(start), std::move(end));
}

/// Two tori of 80 triangles in lattices, or bare on a grid, where vertices touch exactly.
StepScene draw_large(TriangleSource& random) {
  const bool bare = random.below(2) == 0;
  const Body torus = bare ? Body{"bare", make_bare_shape(torus_of_80())}
                          : make_body("in a lattice", torus_of_80(), {3, 3, 2});
  const std::vector<Body> bodies = {torus, torus};
  const double speed = random.below(3) == 0 ? 2.5 : 1.0;
  const auto on_grid = [&](const Vec3& p) -> Vec3 {
    return bare ? Vec3((p.array() * 8.0).round() / 8.0) : p;
  };
  NodesOfBodies start, end;
  for (const Body& body : bodies) {
    const Vec3 from = random.point(Vec3::Zero(), 1.5), to = random.point(from, speed);
    start.emplace_back(), end.emplace_back();
    for (const Vec3& node : rest_nodes_at(*body.shape, Vec3::Zero())) {
      start.back().push_back(on_grid(node + from));
      end.back().push_back(on_grid(random.point(node + to, 0.3)));
    }
  }
  return make_step_scene("tori of 80", bodies, std::move(start), std::move(end));
}

struct Totals {
  std::uint64_t steps = 0, large = 0, pairs = 0, answers = 0, wrong = 0;
  std::uint64_t vertices = 0, edges = 0, triangles = 0, own = 0;
  /// Pairs of bodies that touch at the start; that meet later; of these, that touch at neither end.
  std::uint64_t starting = 0, later = 0, passing = 0;
};

class Comparison {
 public:
  Comparison(std::uint64_t seed, const StepScene& scene, Totals& totals)
      : seed_(seed), scene_(scene), back_(reversed(scene)), truth_(scene), totals_(totals) {
    count();
    oracle::Oracle frames(scene.bodies);
    oracle::StepOracle steps(scene.bodies);
    for (const bool backwards : {false, true}) {
      const StepScene& way = backwards ? back_ : scene_;
      const std::vector<ElementPair> at_start =
          frames.judge(way.start.frame(), {}).surface.triangles;
      const oracle::StepTruth got = steps.judge(way.step(), at_start, {true, true});
      if (at_start != (backwards ? truth_.at_end() : truth_.at_start()))
        say("oracle", backwards, "triangles at the start");
      say("oracle", backwards, different_list(got.contacts, expected(backwards)));
      say("oracle", backwards, truth_.fault_of_first(got.first, backwards));
    }
    for (const char* name : kDetectors) {
      try {
        ask(name);
      } catch (const std::exception& e) {
        say(name, false, e.what());
      }
    }
  }

 private:
  const ContactSet& expected(bool backwards) const {
    return backwards ? truth_.contacts_backwards() : truth_.contacts();
  }

  void ask(const char* name) {
    const std::unique_ptr<Detector> detector = make_detector(name);
    detector->expect({Question::kImpacts, Question::kSelfImpacts});
    detector->prepare(scene_.bodies);
    for (const bool backwards : {false, true}) {
      detector->update_step((backwards ? back_ : scene_).step());
      ContactSet found;
      detector->query(Question::kImpacts, found);
      detector->query(Question::kSelfImpacts, found);
      found.canonicalize();
      ++totals_.answers;
      say(name, backwards, different_list(found, expected(backwards)));
      say(name, backwards, truth_.fault_of_times(found.impacts, backwards));
    }
  }

  void say(const char* who, bool backwards, const std::string& wrong) {
    if (wrong.empty()) return;
    if (++totals_.wrong <= 20)
      std::printf("seed %llu, %s%s: %s\n", static_cast<unsigned long long>(seed_), who,
                  backwards ? ", backwards" : "", wrong.c_str());
    if (totals_.wrong == 1) std::printf("%s\n", text(scene_).c_str());
  }

  void count() {
    ++totals_.steps;
    totals_.pairs += truth_.decided();
    const ContactSet& all = truth_.contacts();
    totals_.vertices += all.impact_vertices.size();
    totals_.edges += all.impact_edges.size();
    totals_.triangles += all.impact_triangles.size();
    totals_.own += all.self_impact_vertices.size() + all.self_impact_edges.size();
    if (!truth_.at_start().empty()) {
      ++totals_.starting;
    } else if (!all.impacts.empty()) {
      ++totals_.later;
      totals_.passing += truth_.at_end().empty();
    }
  }

  const std::uint64_t seed_;
  const StepScene& scene_;
  const StepScene back_;
  const StepBruteForce truth_;
  Totals& totals_;
};

unsigned long long shown(std::uint64_t count) { return count; }

int run(const SeedArguments& arguments) {
  const auto begin = Clock::now(), end = begin + std::chrono::seconds(arguments.seconds);
  Totals totals;
  while (totals.steps < arguments.count && Clock::now() < end) {
    const std::uint64_t seed = arguments.seed + totals.steps;
    const bool large = seed % kLargeEvery == kLargeEvery - 1;
    totals.large += large;
    TriangleSource random(seed);
    const StepScene scene = large ? draw_large(random) : draw_tetrahedra(random);
    Comparison(seed, scene, totals);
  }
  std::printf(
      "%llu steps from seed %llu, %llu of them of bodies of 80 triangles, in %.0f s: %llu pairs of "
      "elements by brute force, of which meet %llu of a vertex and a triangle, %llu of edges and "
      "%llu of one body; %llu pairs of triangles meet; %llu steps start in contact, in %llu bodies "
      "meet later, in %llu of these they touch at neither end; %llu answers of %zu detectors; %llu "
      "answers are wrong\n",
      shown(totals.steps), shown(arguments.seed), shown(totals.large),
      std::chrono::duration<double>(Clock::now() - begin).count(), shown(totals.pairs),
      shown(totals.vertices), shown(totals.edges), shown(totals.own), shown(totals.triangles),
      shown(totals.starting), shown(totals.later), shown(totals.passing), shown(totals.answers),
      kDetectors.size(), shown(totals.wrong));
  // Of many steps some are of each kind, or the steps are no test.
  const bool some =
      totals.steps < 300 || (totals.large > 0 && totals.starting > 0 && totals.passing > 0 &&
                             totals.later > totals.passing && totals.own > 0);
  return totals.wrong == 0 && some ? 0 : 1;
}

}  // namespace
}  // namespace contactcheck::test

int main(int argc, char** argv) {
  contactcheck::test::SeedArguments arguments;
  if (!contactcheck::test::parse(argc, argv, "--count", arguments)) {
    std::fprintf(stderr, "usage: odd_steps [--seed N] [--count N] [--seconds N]\n");
    return 2;
  }
  return contactcheck::test::run(arguments);
}
