// Contact within steps: detectors against the oracle, and what their bounds promise.
#include <exception>
#include <map>
#include <string>
#include <utility>

#include "core/detect/registry.h"
#include "reference/oracle/oracle.h"
#include "reference/oracle/step_truth.h"
#include "tests/core/lazy/one_step.h"
#include "tests/core/lazy/translation_errors.h"
#include "tests/core/narrow/moving_triangle_errors.h"
#include "tests/faults/mutant_checks.h"
#include "tests/support/step_scenes.h"

namespace contactcheck::test {
namespace {

oracle::StepTruth truth_of(const StepScene& scene) {
  std::vector<ElementPair> at_start =
      oracle::Oracle(scene.bodies).judge(scene.start.frame(), {}).surface.triangles;
  return oracle::StepOracle(scene.bodies).judge(scene.step(), at_start, {true, true});
}

void check_first_times(const oracle::StepTruth& truth, const ContactSet& got, MutantFindings& out) {
  std::map<BodyPair, oracle::FirstImpact> first;
  for (const oracle::FirstImpact& impact : truth.first) first[impact.bodies] = impact;
  for (const BodyImpact& impact : got.impacts) {
    const auto found = first.find(impact.bodies);
    if (found == first.end()) continue;  // spurious, which is said of the sets
    out.expect(impact.time.has_value() &&
                   *impact.time >= found->second.earliest - kImpactTimeWidth &&
                   *impact.time <= found->second.latest,
               "wrong first time");
  }
}

std::vector<BodyPair> bodies_of(const ContactSet& set) {
  std::vector<BodyPair> out;
  for (const BodyImpact& impact : set.impacts) out.push_back(impact.bodies);
  return out;
}

void check_detector(const std::string& name, const StepScene& scene, const oracle::StepTruth& truth,
                    std::size_t index, MutantFindings& out) {
  const auto enter = [&](const char* level) {
    out.enter({"step " + scene.name, index, name, level});
  };
  enter("prepare");
  DetectorCatalog catalog;
  register_core_detectors(catalog);
  const std::unique_ptr<Detector> detector = catalog.make(catalog.parse(name));
  detector->prepare(scene.bodies);
  ContactSet got;
  Step step = given_to(*detector, scene.step());
  // Every second scene is looked at after its step backwards and one at rest.
  step.follows = index % 2 == 1;
  if (step.follows) {
    detector->update_step(given_to(*detector, {scene.end.frame(0), scene.start.frame(1)}));
    detector->query(Question::kImpacts, got);
    Step rest = given_to(*detector, {scene.start.frame(1), scene.start.frame(2)});
    rest.follows = true;
    detector->update_step(rest);
    detector->query(Question::kImpacts, got);
    got.clear();
  }
  detector->update_step(step);
  detector->query(Question::kImpacts, got);
  detector->query(Question::kSelfImpacts, got);
  got.canonicalize();
  const ContactSet& expected = truth.contacts;
  enter("impact");
  out.expect_same(bodies_of(expected), bodies_of(got));
  check_first_times(truth, got, out);
  enter("impact-triangle");
  out.expect_same(expected.impact_triangles, got.impact_triangles);
  enter("impact-vf");
  out.expect_same(expected.impact_vertices, got.impact_vertices);
  enter("impact-ee");
  out.expect_same(expected.impact_edges, got.impact_edges);
  enter("impact-self-vf");
  out.expect_same(expected.self_impact_vertices, got.self_impact_vertices);
  enter("impact-self-ee");
  out.expect_same(expected.self_impact_edges, got.self_impact_edges);
}

void check_detectors_of_steps(MutantFindings& out) {
  for (const StepFamily family : kStepFamilies) {
    TriangleSource random(970 + static_cast<std::uint64_t>(family));
    draw_step_scene(random, family);  // the first of one family takes seconds of exact arithmetic
    for (std::size_t i = 0; i < 2; ++i) {
      const StepScene scene = draw_step_scene(random, family);
      const oracle::StepTruth truth = truth_of(scene);
      for (const char* name : {"swept-aabb", "full-refit", "ffd-lazy", "ffd-lazy:bounds=nodes",
                               "ffd-lazy:bounds=nodes,threads=2"})
        try {
          check_detector(name, scene, truth, i, out);
        } catch (const std::exception& e) {
          out.add(std::string("threw: ") + e.what());
        }
    }
  }
}

void check_moving_triangles(MutantFindings& out) {
  out.enter({"whole-numbers", 0, "separated", "impact-triangle"});
  const Separations seen = judged_separations(1500);
  out.expect(seen.wrong == 0, "missed=" + std::to_string(seen.wrong) + " spurious=0");
  out.expect(seen.unlike == 0, "a shared motion changes the verdict");
  out.enter({"corners-of-cubes", 0, "gap_along", "bounds"});
  out.expect(largest_gap_error(12) <= 1.0, "an error is larger than its bound");
}

void check_translations(MutantFindings& out) {
  out.enter({"two-frames", 0, "translation_between", "bounds"});
  out.expect(largest_shortfall_of_translations() <= 0.0, "it does not hold the offset");
  std::size_t number = 0;
  for (const FramePair frames : {FramePair::kOne, FramePair::kTwo, FramePair::kMoving})
    for (const Along along : {Along::kMoved, Along::kLane}) {
      out.enter({"two-frames", number++, "not_separated", "bounds"});
      out.expect(largest_error_of_slab_tests(frames, along) <= 1.0,
                 "an error is larger than the slack");
    }
}

void check_bounds_of_steps(MutantFindings& out) {
  const LazyKernels& kernels = lazy_kernels();
  for (const double place : {0.0, 1e12}) {
    out.enter({"turned-cell", place == 0.0 ? 0u : 1u, "ffd-lazy of steps", "boxes"});
    out.expect(largest_step_box_error(kernels, place) <= 1.0, "an error is larger than the slack");
  }
  out.enter({"flat-square", 0, "ffd-lazy of steps", "slabs"});
  out.expect(largest_step_slab_error(kernels) <= 1.0, "an error is larger than the slack");
  out.enter({"whole-numbers", 0, "may_meet", "impact"});
  out.expect(judged_meetings(2000).wrong == 0, "bodies are separated, or not, by wrong boxes");
  const TriangleMesh ball = sphere_mesh(Vec3::Zero(), 1.0, 3);
  std::size_t number = 0;
  for (const ShapePtr& shape :
       {make_shape(ball, {3, 4, 3}), make_shape(long_triangles(6, 60), {8, 8, 8}),
        make_bare_shape(sphere_mesh(Vec3::Zero(), 1.0, 1))}) {
    out.enter({"both-ends", number++, "ffd-lazy of steps", "bounds"});
    const std::string broken = broken_step(kernels, shape, 8);
    out.expect(broken.empty(), broken);
  }
}

}  // namespace

void check_steps(MutantFindings& out) {
  check_moving_triangles(out);
  check_translations(out);
  check_bounds_of_steps(out);
  check_detectors_of_steps(out);
}

}  // namespace contactcheck::test
