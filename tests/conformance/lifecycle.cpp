#include "tests/conformance/lifecycle.h"

#include <algorithm>
#include <barrier>
#include <exception>
#include <thread>

#include "tests/conformance/answers.h"

namespace contactcheck::test {
namespace {

std::vector<Answers> all_answers(Detector& detector, const Case& scene) {
  std::vector<Answers> out;
  for (std::size_t f = 0; f < scene.frames.size(); ++f)
    out.push_back(ask(detector, scene.frames[f], f));
  return out;
}

/// The answers of a detector that goes once through the frames, and how others differ from them.
class Comparison {
 public:
  explicit Comparison(const Maker& make)
      : scene(moving_case()), make_(make), plain_(all_answers(*detector(), scene)) {}

  std::unique_ptr<Detector> detector() const { return detector(scene.bodies); }
  std::unique_ptr<Detector> detector(const std::vector<Body>& bodies) const {
    std::unique_ptr<Detector> made = make_();
    made->prepare(bodies);
    return made;
  }
  Answers ask_frame(Detector& detector, std::size_t f) const {
    return ask(detector, scene.frames[f], f);
  }
  const std::vector<Answers>& plain() const { return plain_; }

  void add(std::size_t f, const Answers& got) {
    add("frame " + std::to_string(f), same(plain_[f], got), plain_[f], got);
  }
  void add(const std::string& where, bool as_expected, const Answers& plain, const Answers& got) {
    if (as_expected) return;
    ++out_.findings["answer differs"];
    out_.details += where + "\n  expected: " + text(plain) + "\n  found: " + text(got) + "\n";
  }
  Observation result() const { return out_; }

  const Case& scene;

 private:
  const Maker& make_;
  const std::vector<Answers> plain_;
  Observation out_;
};

// Without this, a detector that always says the same would pass all the rest.
Observation answers_follow_the_motion(const Maker& make) {
  Comparison c(make);
  c.add("first and last frame", !same(c.plain().front(), c.plain().back()), c.plain().front(),
        c.plain().back());
  return c.result();
}

Observation repeated_query(const Maker& make) {
  Comparison c(make);
  const auto detector = c.detector();
  for (std::size_t f = 0; f < c.scene.frames.size(); ++f) {
    c.add(f, c.ask_frame(*detector, f));
    detector->trace();
    detector->notes();
    for (int i = 0; i < 2; ++i) c.add(f, ask_again(*detector));
  }
  return c.result();
}

// A query appends to the set: what the caller has in it stays.
Observation appended_answer(const Maker& make) {
  Comparison c(make);
  const std::size_t last = c.scene.frames.size() - 1;
  const auto detector = c.detector();
  c.ask_frame(*detector, last);
  for (Question question : detector->semantics().questions) {
    ContactSet set;
    set.bodies.push_back({7, 8});
    detector->query(question, set);
    const bool kept = !set.bodies.empty() && set.bodies.front() == BodyPair{7, 8};
    c.add(name_of(question), kept, c.plain()[last], {{question, set}});
  }
  return c.result();
}

Observation update_without_motion(const Maker& make) {
  Comparison c(make);
  const auto detector = c.detector();
  for (std::size_t f = 0; f < c.scene.frames.size(); ++f)
    for (int i = 0; i < 3; ++i) c.add(f, c.ask_frame(*detector, f));
  return c.result();
}

Observation large_motion_and_back(const Maker& make) {
  Comparison c(make);
  const auto detector = c.detector();
  for (std::size_t f = 0; f < c.scene.frames.size(); ++f) {
    std::vector<std::vector<Vec3>> nodes = c.scene.frames[f].nodes;
    for (std::vector<Vec3>& body : nodes)
      for (Vec3& n : body) n = 1024.0 * n + Vec3(0x1p20, 0, -0x1p18);
    ask(*detector, make_frame(c.scene.bodies, std::move(nodes)));
    c.add(f, c.ask_frame(*detector, f));
  }
  return c.result();
}

Observation frames_in_any_order(const Maker& make) {
  Comparison c(make);
  const auto detector = c.detector();
  for (std::size_t f : {5, 0, 5, 3, 3, 1, 4, 2, 0}) c.add(f, c.ask_frame(*detector, f));
  return c.result();
}

Observation fresh_structure(const Maker& make) {
  Comparison c(make);
  for (std::size_t f = 0; f < c.scene.frames.size(); ++f) c.add(f, c.ask_frame(*c.detector(), f));
  return c.result();
}

Observation prepare_again(const Maker& make) {
  Comparison c(make);
  const Case other = cases_of(CaseGroup::kMany).front();
  const auto detector = c.detector(other.bodies);
  ask(*detector, other.frames.front());
  detector->prepare(c.scene.bodies);
  for (std::size_t f = 0; f < c.scene.frames.size(); ++f) c.add(f, c.ask_frame(*detector, f));
  return c.result();
}

// The deformed bodies as rest shapes, without lattices: the structure is built where it was
// refitted before.
Observation rebuilt_structure(const Maker& make) {
  Comparison c(make);
  for (std::size_t f = 0; f < c.scene.frames.size(); ++f) {
    const FrameData& frame = c.scene.frames[f];
    std::vector<Body> bodies;
    for (std::size_t b = 0; b < c.scene.bodies.size(); ++b) {
      const Body& body = c.scene.bodies[b];
      bodies.push_back(
          {body.name, make_bare_shape({frame.vertices[b], body.shape->mesh.triangles})});
    }
    c.add(f, ask(*c.detector(bodies), make_frame(bodies, frame.vertices), f));
  }
  return c.result();
}

// Each thread makes, prepares and drives a detector of its own. The barrier sets both off together,
// twice, so that both instances are there when the frames begin.
Observation two_threads(const Maker& make) {
  constexpr int kRounds = 5;
  Comparison c(make);
  std::vector<std::vector<Answers>> answers(2);
  std::vector<std::exception_ptr> failures(2);
  std::barrier together(2);
  const auto run = [&](std::size_t i) {
    together.arrive_and_wait();
    try {
      const auto detector = c.detector();
      together.arrive_and_wait();
      for (int round = 0; round < kRounds; ++round)
        for (const Answers& a : all_answers(*detector, c.scene)) answers[i].push_back(a);
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
    for (std::size_t i = 0; i < of_thread.size(); ++i)
      c.add(i % c.scene.frames.size(), of_thread[i]);
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

Observation swapped_bodies(const Maker& make) {
  Comparison c(make);
  for (const Case& scene : all_cases()) {
    const Case other = reversed(scene);
    const auto forward = c.detector(scene.bodies), backward = c.detector(other.bodies);
    for (std::size_t f = 0; f < scene.frames.size(); ++f) {
      const Answers a = ask(*forward, scene.frames[f], f), b = ask(*backward, other.frames[f], f);
      c.add(scene.name + ", frame " + std::to_string(f), mirrored(a, b, scene.bodies.size()), a, b);
    }
  }
  return c.result();
}

}  // namespace

const std::vector<LifecycleCheck>& lifecycle_checks() {
  static const std::vector<LifecycleCheck> checks = {
      {"answers-follow-the-motion", answers_follow_the_motion},
      {"repeated-query", repeated_query},
      {"appended-answer", appended_answer},
      {"update-without-motion", update_without_motion},
      {"large-motion-and-back", large_motion_and_back},
      {"frames-in-any-order", frames_in_any_order},
      {"fresh-structure", fresh_structure},
      {"prepare-again", prepare_again},
      {"rebuilt-structure", rebuilt_structure},
      {"two-threads", two_threads},
      {"swapped-bodies", swapped_bodies}};
  return checks;
}

}  // namespace contactcheck::test
