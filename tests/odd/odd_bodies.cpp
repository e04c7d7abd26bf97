// Asks all exact detectors about odd scenes and compares every answer with the oracle's:
//   odd_bodies [--seed N] [--scenes N] [--seconds N]
//
//   --seed      of the first scene; the next scenes have the next seeds (default 1)
//   --scenes    ends after so many (default: no limit)
//   --seconds   begins no scene later (default 10)
//
// Exit code 1: an answer differs from the oracle's. The line names the seed: --seed N --scenes 1
// runs that scene alone.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "core/types/check.h"
#include "reference/oracle/oracle.h"
#include "tests/conformance/detectors.h"
#include "tests/hard/exact_detectors.h"
#include "tests/odd/odd_scene.h"
#include "tests/odd/seed_arguments.h"

namespace contactcheck::test {
namespace {

struct Totals {
  std::uint64_t scenes = 0, frames = 0, answers = 0, contacts = 0, self_contacts = 0, refused = 0;
  std::uint64_t wrong = 0;
};

template <typename Pair>
std::string difference(const std::vector<Pair>& answer, const std::vector<Pair>& truth) {
  std::vector<Pair> missed, spurious;
  std::set_difference(truth.begin(), truth.end(), answer.begin(), answer.end(),
                      std::back_inserter(missed));
  std::set_difference(answer.begin(), answer.end(), truth.begin(), truth.end(),
                      std::back_inserter(spurious));
  if (missed.empty() && spurious.empty()) return "";
  return std::to_string(missed.size()) + " missed and " + std::to_string(spurious.size()) +
         " spurious of " + std::to_string(truth.size());
}

// A refusal that a detector documents for such a scene.
bool may_refuse(const OddScene& scene, const std::string& because) {
  const bool bare = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                [](const Body& body) { return !body.shape->lattice; });
  const auto says = [&](const char* words) { return because.find(words) != std::string::npos; };
  return (bare && says("needs a lattice for every body")) || says("so near the largest double");
}

class Comparison {
 public:
  Comparison(std::uint64_t seed, const OddScene& scene, Totals& totals)
      : seed_(seed), scene_(scene), totals_(totals) {
    oracle::Oracle oracle(scene.bodies);
    for (const FrameData& frame : scene.frames)
      truths_.push_back(oracle.judge(frame.frame(), {.triangles = true, .self = true}).surface);
  }

  void run(const std::string& name) {
    try {
      const std::unique_ptr<Detector> detector = make_detector(name);
      const bool self = detector->semantics().answers(Question::kSelf);
      if (self) detector->expect({Question::kTriangles, Question::kSelf});
      detector->prepare(scene_.bodies);
      for (std::size_t f = 0; f < scene_.frames.size(); ++f) {
        detector->update(scene_.frames[f].frame(f));
        ContactSet found;
        detector->query(Question::kTriangles, found);
        if (self) detector->query(Question::kSelf, found);
        found.canonicalize();
        ++totals_.answers;
        say(name, f, "contacts", difference(found.triangles, truths_[f].triangles));
        if (self) say(name, f, "self-contacts", difference(found.self, truths_[f].self));
      }
    } catch (const RefusedInput& e) {
      ++totals_.refused;
      if (!may_refuse(scene_, e.what())) say(name, 0, "refused", e.what());
    }
  }

  void count() const {
    ++totals_.scenes;
    totals_.frames += scene_.frames.size();
    for (const ContactSet& truth : truths_) {
      totals_.contacts += truth.triangles.size();
      totals_.self_contacts += truth.self.size();
    }
  }

 private:
  void say(const std::string& detector, std::size_t frame, const char* what,
           const std::string& wrong) {
    if (wrong.empty()) return;
    if (++totals_.wrong <= 20)
      std::printf("seed %llu, frame %zu, %s, %s: %s\n  (%s)\n",
                  static_cast<unsigned long long>(seed_), frame, detector.c_str(), what,
                  wrong.c_str(), scene_.description.c_str());
  }

  std::uint64_t seed_;
  const OddScene& scene_;
  Totals& totals_;
  std::vector<ContactSet> truths_;  // per frame
};

int run(const SeedArguments& arguments) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(arguments.seconds);
  Totals totals;
  while (totals.scenes < arguments.count && Clock::now() < end) {
    const std::uint64_t seed = arguments.seed + totals.scenes;
    const OddScene scene = odd_scene(seed);
    Comparison comparison(seed, scene, totals);
    for (const std::string& name : exact_detectors()) comparison.run(name);
    comparison.count();
  }
  std::printf(
      "%llu scenes from seed %llu, %llu frames, %llu answers of %zu detectors: %llu contacts and "
      "%llu "
      "self-contacts, %llu detectors refused a scene, %llu answers differ from the oracle's\n",
      static_cast<unsigned long long>(totals.scenes),
      static_cast<unsigned long long>(arguments.seed),
      static_cast<unsigned long long>(totals.frames),
      static_cast<unsigned long long>(totals.answers), exact_detectors().size(),
      static_cast<unsigned long long>(totals.contacts),
      static_cast<unsigned long long>(totals.self_contacts),
      static_cast<unsigned long long>(totals.refused),
      static_cast<unsigned long long>(totals.wrong));
  // Of many scenes some have contacts, or the scenes are no test.
  const bool some = totals.scenes < 20 || (totals.contacts > 0 && totals.self_contacts > 0);
  return totals.wrong == 0 && some ? 0 : 1;
}

}  // namespace
}  // namespace contactcheck::test

int main(int argc, char** argv) {
  contactcheck::test::SeedArguments arguments;
  if (!contactcheck::test::parse(argc, argv, "--scenes", arguments)) {
    std::fprintf(stderr, "usage: odd_bodies [--seed N] [--scenes N] [--seconds N]\n");
    return 2;
  }
  return contactcheck::test::run(arguments);
}
