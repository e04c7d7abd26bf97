#include "tests/conformance/lifecycle.h"

#include <algorithm>
#include <barrier>
#include <exception>
#include <thread>

#include "tests/conformance/answers.h"
#include "tests/conformance/detectors.h"

namespace contactcheck::test {
namespace {

std::vector<Answers> all_answers(Detector& detector, const Case& scene, Moment of) {
  std::vector<Answers> out;
  for (std::size_t i = 0; i < count_of(scene, of); ++i) out.push_back(ask(detector, scene, of, i));
  return out;
}

const std::vector<Case>& cases_about(Moment of) {
  return of == Moment::kFrame ? all_cases() : step_cases();
}

/// The answers of a detector that goes once through the frames, or steps, and how others differ
/// from them.
class Comparison {
 public:
  Comparison(const Maker& make, Moment moment)
      : scene(moment == Moment::kFrame ? moving_case() : moving_step_case()),
        of(moment),
        make_(make),
        plain_(all_answers(*detector(), scene, of)) {}

  std::unique_ptr<Detector> detector() const { return detector(scene.bodies); }
  std::unique_ptr<Detector> detector(const std::vector<Body>& bodies) const {
    std::unique_ptr<Detector> made = make_();
    made->prepare(bodies);
    return made;
  }
  std::size_t count() const { return plain_.size(); }
  Answers ask_about(Detector& detector, std::size_t i) const { return ask(detector, scene, of, i); }
  const std::vector<Answers>& plain() const { return plain_; }

  void add(std::size_t i, const Answers& got) {
    add((of == Moment::kFrame ? "frame " : "step ") + std::to_string(i), same(plain_[i], got),
        plain_[i], got);
  }
  void add(const std::string& where, bool as_expected, const Answers& plain, const Answers& got) {
    if (as_expected) return;
    ++out_.findings["answer differs"];
    out_.details += where + "\n  expected: " + text(plain) + "\n  found: " + text(got) + "\n";
  }
  Observation result() const { return out_; }

  const Case& scene;
  const Moment of;

 private:
  const Maker& make_;
  const std::vector<Answers> plain_;
  Observation out_;
};

// Without this, a detector that always says the same would pass all the rest.
Observation answers_follow_the_motion(const Maker& make, Moment of) {
  Comparison c(make, of);
  c.add("first and last", !same(c.plain().front(), c.plain().back()), c.plain().front(),
        c.plain().back());
  return c.result();
}

Observation repeated_query(const Maker& make, Moment of) {
  Comparison c(make, of);
  const auto detector = c.detector();
  for (std::size_t i = 0; i < c.count(); ++i) {
    c.add(i, c.ask_about(*detector, i));
    detector->trace();
    detector->notes();
    for (int again = 0; again < 2; ++again) c.add(i, ask_again(*detector, of));
  }
  return c.result();
}

// A query appends to the set: what the caller has in it stays.
Observation appended_answer(const Maker& make, Moment of) {
  Comparison c(make, of);
  const std::size_t last = c.count() - 1;
  const auto detector = c.detector();
  c.ask_about(*detector, last);
  for (Question question : detector->semantics().questions) {
    if (!is_of(question, of)) continue;
    ContactSet set;
    set.bodies.push_back({7, 8});
    set.impacts.push_back({{7, 8}, 0.5});
    detector->query(question, set);
    const bool kept = !set.bodies.empty() && set.bodies.front() == BodyPair{7, 8} &&
                      !set.impacts.empty() && set.impacts.front().bodies == BodyPair{7, 8};
    c.add(name_of(question), kept, c.plain()[last], {{question, set}});
  }
  return c.result();
}

Observation update_without_motion(const Maker& make, Moment of) {
  Comparison c(make, of);
  const auto detector = c.detector();
  for (std::size_t i = 0; i < c.count(); ++i)
    for (int again = 0; again < 3; ++again) c.add(i, c.ask_about(*detector, i));
  return c.result();
}

Observation large_motion_and_back(const Maker& make, Moment of) {
  Comparison c(make, of);
  Case away = c.scene;
  for (FrameData& frame : away.frames) {
    std::vector<std::vector<Vec3>> nodes = frame.nodes;
    for (std::vector<Vec3>& body : nodes)
      for (Vec3& n : body) n = 1024.0 * n + Vec3(0x1p20, 0, -0x1p18);
    frame = make_frame(away.bodies, std::move(nodes));
  }
  const auto detector = c.detector();
  for (std::size_t i = 0; i < c.count(); ++i) {
    ask(*detector, away, of, i);
    c.add(i, c.ask_about(*detector, i));
  }
  return c.result();
}

Observation in_any_order(const Maker& make, Moment of) {
  Comparison c(make, of);
  const auto detector = c.detector();
  for (std::size_t i : {5, 0, 5, 3, 3, 1, 4, 2, 0})
    if (i < c.count()) c.add(i, c.ask_about(*detector, i));
  return c.result();
}

Observation fresh_structure(const Maker& make, Moment of) {
  Comparison c(make, of);
  for (std::size_t i = 0; i < c.count(); ++i) c.add(i, c.ask_about(*c.detector(), i));
  return c.result();
}

Observation prepare_again(const Maker& make, Moment of) {
  Comparison c(make, of);
  const Case other =
      of == Moment::kFrame ? cases_of(CaseGroup::kMany).front() : step_cases().front();
  const auto detector = c.detector(other.bodies);
  ask(*detector, other, of, 0);
  detector->prepare(c.scene.bodies);
  for (std::size_t i = 0; i < c.count(); ++i) c.add(i, c.ask_about(*detector, i));
  return c.result();
}

/// The deformed bodies of one frame as rest shapes, without lattices, in all frames.
Case rebuilt(const Case& scene, std::size_t frame) {
  Case out{scene.name, {}, {}, {}};
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body& body = scene.bodies[b];
    out.bodies.push_back({body.name, make_bare_shape({scene.frames[frame].vertices[b],
                                                      body.shape->mesh.triangles})});
  }
  for (const FrameData& data : scene.frames)
    out.frames.push_back(make_frame(out.bodies, data.vertices));
  return out;
}

// The structure is built where it was refitted before.
Observation rebuilt_structure(const Maker& make, Moment of) {
  Comparison c(make, of);
  for (std::size_t i = 0; i < c.count(); ++i) {
    const Case scene = rebuilt(c.scene, i);
    c.add(i, ask(*c.detector(scene.bodies), scene, of, i));
  }
  return c.result();
}

// Each thread makes, prepares and drives a detector of its own. The barrier sets both off together,
// twice, so that both instances are there when the frames begin.
Observation two_threads(const Maker& make, Moment of) {
  constexpr int kRounds = 5;
  Comparison c(make, of);
  std::vector<std::vector<Answers>> answers(2);
  std::vector<std::exception_ptr> failures(2);
  std::barrier together(2);
  const auto run = [&](std::size_t i) {
    together.arrive_and_wait();
    try {
      const auto detector = c.detector();
      together.arrive_and_wait();
      for (int round = 0; round < kRounds; ++round)
        for (const Answers& a : all_answers(*detector, c.scene, of)) answers[i].push_back(a);
    } catch (...) {
      failures[i] = std::current_exception();
      together.arrive_and_drop();
    }
  };
  std::thread other(run, 1);
  run(0);
  other.join();
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
  for (const std::vector<Answers>& of_thread : answers)
    for (std::size_t i = 0; i < of_thread.size(); ++i) c.add(i % c.count(), of_thread[i]);
  return c.result();
}

/// The same case with its bodies in the opposite order.
Case reversed(Case scene) {
  std::reverse(scene.bodies.begin(), scene.bodies.end());
  for (FrameData& frame : scene.frames) {
    std::reverse(frame.nodes.begin(), frame.nodes.end());
    std::reverse(frame.vertices.begin(), frame.vertices.end());
  }
  return scene;
}

Observation swapped_bodies(const Maker& make, Moment of) {
  Comparison c(make, of);
  for (const Case& scene : cases_about(of)) {
    const Case other = reversed(scene);
    const auto forward = c.detector(scene.bodies), backward = c.detector(other.bodies);
    for (std::size_t i = 0; i < count_of(scene, of); ++i) {
      const Answers a = ask(*forward, scene, of, i), b = ask(*backward, other, of, i);
      c.add(scene.name + ", " + std::to_string(i), mirrored(a, b, scene.bodies.size()), a, b);
    }
  }
  return c.result();
}

// Of a detector of both: neither kind of update leaves anything to the other.
Observation frames_between(const Maker& make, Moment of) {
  Comparison c(make, of);
  const auto detector = c.detector();
  if (!answers_any(detector->semantics(), Moment::kFrame)) return {};
  const std::vector<Answers> frames = all_answers(*detector, c.scene, Moment::kFrame);
  for (std::size_t i = 0; i < c.count(); ++i) {
    c.add(i, c.ask_about(*detector, i));
    const Answers frame = ask(*detector, c.scene, Moment::kFrame, i);
    c.add("frame " + std::to_string(i), same(frames[i], frame), frames[i], frame);
    c.add(i, c.ask_about(*detector, i));
  }
  return c.result();
}

// The places that a step points to outlive the questions, the step itself need not: what it holds
// is another step's by the time of these.
Observation step_of_the_call_alone(const Maker& make, Moment of) {
  Comparison c(make, of);
  const auto detector = c.detector();
  for (std::size_t i = 0; i < c.count(); ++i) {
    Step step = step_of(c.scene, i, *detector);
    detector->update_step(step);
    step = step_of(c.scene, (i + 2) % c.count(), *detector);
    c.add(i, ask_again(*detector, of));
  }
  return c.result();
}

std::vector<LifecycleCheck> made_checks(Moment of) {
  std::vector<LifecycleCheck> checks = {{"answers-follow-the-motion", answers_follow_the_motion},
                                        {"repeated-query", repeated_query},
                                        {"appended-answer", appended_answer},
                                        {"update-without-motion", update_without_motion},
                                        {"large-motion-and-back", large_motion_and_back},
                                        {"frames-in-any-order", in_any_order},
                                        {"fresh-structure", fresh_structure},
                                        {"prepare-again", prepare_again},
                                        {"rebuilt-structure", rebuilt_structure},
                                        {"two-threads", two_threads},
                                        {"swapped-bodies", swapped_bodies}};
  if (of == Moment::kFrame) return checks;
  for (LifecycleCheck& check : checks)
    check.name = check.run == in_any_order ? "steps-in-any-order" : "step-" + check.name;
  checks.push_back({"step-frames-between", frames_between});
  checks.push_back({"step-of-the-call-alone", step_of_the_call_alone});
  return checks;
}

}  // namespace

const std::vector<LifecycleCheck>& lifecycle_checks(Moment of) {
  static const std::vector<LifecycleCheck> frames = made_checks(Moment::kFrame),
                                           steps = made_checks(Moment::kStep);
  return of == Moment::kFrame ? frames : steps;
}

}  // namespace contactcheck::test
