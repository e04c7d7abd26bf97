// The stage trace: which true pairs each stage still covers.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/core/detect/scenes.h"

namespace contactcheck {
namespace {

using test::answer;
using test::prepared;
using test::Scene;

// Tells of one stage whether it covers a pair of triangles.
class Coverage {
 public:
  Coverage(const Scene& scene, const StageTrace& trace, std::size_t stage)
      : scene_(scene), trace_(trace), record_(trace.stages[stage]) {}

  bool covers(const ElementPair& p) const {
    switch (record_.kind) {
      case StageRecord::Kind::kBodies:
        return has_bodies(p);
      case StageRecord::Kind::kTriangles:
        return lists(p);
      case StageRecord::Kind::kOwnerCells:
        return lists(
            {p.body_a, p.body_b, trace_.owner[p.body_a][p.a], trace_.owner[p.body_b][p.b]});
      case StageRecord::Kind::kLabelCells:
        return covers_by_label(p);
      case StageRecord::Kind::kActiveLabelCells:
        return has_bodies(p) && has_active_label(p.body_a, p.a) && has_active_label(p.body_b, p.b);
      case StageRecord::Kind::kActiveOwnerCells:
        return has_bodies(p) && record_.active[p.body_a][trace_.owner[p.body_a][p.a]] != 0 &&
               record_.active[p.body_b][trace_.owner[p.body_b][p.b]] != 0;
    }
    return false;
  }

 private:
  bool has_bodies(const ElementPair& p) const {
    return std::binary_search(record_.bodies.begin(), record_.bodies.end(),
                              BodyPair{p.body_a, p.body_b});
  }
  bool has_active_label(std::uint32_t body, std::uint32_t triangle) const {
    for (std::uint32_t cell : scene_.bodies[body].shape->embedding.cells_of_triangle(triangle))
      if (record_.active[body][cell]) return true;
    return false;
  }
  bool lists(const ElementPair& p) const {
    return std::binary_search(record_.elements.begin(), record_.elements.end(), p);
  }
  bool covers_by_label(const ElementPair& p) const {
    const auto label = [&](std::uint32_t body, std::uint32_t triangle) {
      return scene_.bodies[body].shape->embedding.cells_of_triangle(triangle);
    };
    for (std::uint32_t a : label(p.body_a, p.a))
      for (std::uint32_t b : label(p.body_b, p.b))
        if (lists({p.body_a, p.body_b, a, b})) return true;
    return false;
  }

  const Scene& scene_;
  const StageTrace& trace_;
  const StageRecord& record_;
};

// Per stage: how many of the true pairs it covers.
std::vector<std::size_t> covered(const Scene& scene, const StageTrace& trace,
                                 const std::vector<ElementPair>& truth) {
  std::vector<std::size_t> counts;
  for (std::size_t s = 0; s < trace.stages.size(); ++s) {
    const Coverage coverage(scene, trace, s);
    counts.push_back(static_cast<std::size_t>(std::count_if(
        truth.begin(), truth.end(), [&](const auto& p) { return coverage.covers(p); })));
  }
  return counts;
}

StageTrace trace_of(Detector& detector, const test::FrameData& frame) {
  const Frame f = frame.frame();
  detector.update(f);
  return detector.trace();
}

std::vector<std::string> stage_names(const std::string& name) {
  const Scene scene = test::approach({301, 0.2});
  std::vector<std::string> names;
  for (const StageRecord& s : trace_of(*prepared(name, scene), scene.frames.back()).stages)
    names.push_back(s.name);
  return names;
}

TEST(StageTrace, HasOneRecordPerStage) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(stage_names("ffd-grid"), (Names{"hash", "node-plane"}));
  EXPECT_EQ(stage_names("ffd-aabb-sphere+tri"), (Names{"sphere1", "hash", "triangles"}));
  EXPECT_EQ(stage_names("ffd-aabb-sphere2"), (Names{"sphere1", "sphere2", "hash", "node-plane"}));
  EXPECT_EQ(stage_names("ffd-aabb-sphereN+tri"),
            (Names{"sphere1", "sphere2", "sphere3", "hash", "triangles"}));
}

TEST(StageTrace, OfSafeBoundsWithTrianglesLosesNothing) {
  std::size_t pairs = 0;
  for (std::uint64_t seed : {302, 303, 304}) {
    const Scene scene = test::approach({seed, 0.6});
    for (const std::string& name : test::exact_detectors()) {
      const auto detector = prepared(name, scene);
      for (const test::FrameData& frame : scene.frames) {
        const auto truth = test::true_pairs(scene, frame);
        for (std::size_t count : covered(scene, trace_of(*detector, frame), truth))
          EXPECT_EQ(count, truth.size()) << name;
        pairs += truth.size();
      }
    }
  }
  EXPECT_GT(pairs, 1000u);
}

TEST(StageTrace, LastStageIsTheAnswer) {
  std::size_t pairs = 0;
  for (const std::string& id : test::family())
    for (const char* variant : {"", ":bounds=safe", "+tri", "+tri:bounds=paper"}) {
      const Scene scene = test::approach({305, 0.4});
      const auto detector = prepared(id + variant, scene);
      for (const test::FrameData& frame : scene.frames) {
        const ContactSet set = answer(*detector, frame);
        const StageTrace trace = trace_of(*detector, frame);
        const StageRecord& last = trace.stages.back();
        EXPECT_EQ(last.elements, set.triangles.empty() ? set.cells : set.triangles)
            << id << variant;
        EXPECT_EQ(last.out, last.elements.size());
        pairs += last.elements.size();
      }
    }
  EXPECT_GT(pairs, 1000u);
}

TEST(StageTrace, OfThePaperCoversLessAndLessAndLosesSome) {
  std::size_t truth_pairs = 0, kept = 0;
  for (std::uint64_t seed : {306, 307}) {
    const Scene scene = test::approach({seed, 0.8});
    for (const std::string& id : test::family()) {
      const auto detector = prepared(id + "+tri:bounds=paper", scene);
      for (const test::FrameData& frame : scene.frames) {
        const auto truth = test::true_pairs(scene, frame);
        const auto counts = covered(scene, trace_of(*detector, frame), truth);
        EXPECT_TRUE(std::is_sorted(counts.rbegin(), counts.rend())) << id;
        EXPECT_EQ(counts.back(), answer(*detector, frame).triangles.size());
        truth_pairs += truth.size();
        kept += counts.back();
      }
    }
  }
  EXPECT_GT(kept, truth_pairs / 10);
  EXPECT_LT(kept, truth_pairs);
}

TEST(StageTrace, CountsTheSpherePairsOfEachLevel) {
  const Scene scene = test::approach({308, 0.0});
  const auto detector = prepared("ffd-aabb-sphereN+tri:levels=3,spheres=4", scene);
  const StageTrace close = trace_of(*detector, scene.frames.back());
  EXPECT_EQ(close.stages[0].in, 1u);
  EXPECT_EQ(close.stages[0].out, 1u);
  EXPECT_GT(close.stages[1].in, 1u);
  EXPECT_GE(close.stages[2].in, close.stages[1].out);
  EXPECT_GE(close.stages[1].in, close.stages[1].out);
}

TEST(StageTrace, NothingIsTestedBelowSpheresThatDoNotCollide) {
  Scene scene = test::approach({309, 0.0}, 1);
  for (Vec3& n : scene.frames[0].nodes[1]) n += Vec3(100, 0, 0);
  scene.frames[0] = test::make_frame(scene.bodies, scene.frames[0].nodes);
  for (const char* name : {"ffd-aabb-sphereN+tri", "ffd-aabb-sphereN", "ffd-aabb-sphere2"}) {
    const StageTrace trace = trace_of(*prepared(name, scene), scene.frames[0]);
    EXPECT_EQ(trace.stages[0].in, 1u);
    EXPECT_EQ(trace.stages[0].out, 0u);
    for (std::size_t s = 1; s < trace.stages.size(); ++s) {
      EXPECT_EQ(trace.stages[s].in, 0u) << name << " " << trace.stages[s].name;
      EXPECT_EQ(trace.stages[s].out, 0u) << name << " " << trace.stages[s].name;
      EXPECT_TRUE(trace.stages[s].elements.empty() && trace.stages[s].bodies.empty());
    }
  }
}

TEST(StageTrace, OwnersAreKeptCellsOfTheTrianglesVertices) {
  const Scene scene = test::approach({310, 0.0}, 1);
  const StageTrace trace = trace_of(*prepared("ffd-aabb+tri", scene), scene.frames[0]);
  ASSERT_EQ(trace.owner.size(), 2u);
  for (std::size_t b = 0; b < 2; ++b) {
    const BodyShape& shape = *scene.bodies[b].shape;
    ASSERT_EQ(trace.owner[b].size(), shape.mesh.triangles.size());
    for (std::size_t t = 0; t < trace.owner[b].size(); ++t) {
      std::multiset<std::uint32_t> homes;
      for (std::uint32_t v : shape.mesh.triangles[t]) homes.insert(shape.embedding.home_cell[v]);
      // The home of most of its vertices.
      for (std::uint32_t home : homes) EXPECT_GE(homes.count(trace.owner[b][t]), homes.count(home));
    }
  }
}

}  // namespace
}  // namespace contactcheck
