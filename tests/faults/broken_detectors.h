// Detectors that are broken on purpose: each takes the oracle's answer and spoils it in one way.
// They exist in tests alone and are in no catalogue.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/detect/detector.h"
#include "reference/oracle/oracle.h"

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace contactcheck::test {

/// Answers with the truth. Subclasses spoil the triangle answer, the body answer, or both.
class TruthfulDetector : public Detector {
 public:
  TruthfulDetector() {
    semantics_.levels = {Level::kBody, Level::kTriangle};
    semantics_.questions = {Question::kTriangles, Question::kBody};
    semantics_.exact = true;
  }
  const Semantics& semantics() const override { return semantics_; }
  bool needs_vertices() const override { return true; }
  void prepare(const std::vector<Body>& bodies) override { oracle_.emplace(bodies); }
  void update(const Frame& frame) override { truth_ = oracle_->judge(frame, {}).surface; }
  void query(Question question, ContactSet& out) override {
    if (question == Question::kBody) {
      out.bodies = spoiled_bodies(truth_.bodies);
    } else {
      out.triangles = spoiled_triangles(truth_.triangles);
    }
  }

 protected:
  virtual std::vector<ElementPair> spoiled_triangles(std::vector<ElementPair> truth) {
    return truth;
  }
  virtual std::vector<BodyPair> spoiled_bodies(std::vector<BodyPair> truth) { return truth; }

  ContactSet truth_;

 private:
  Semantics semantics_;
  std::optional<oracle::Oracle> oracle_;
};

/// Reports bodies 0 and 1 in every frame, to every question. `solid`: takes bodies for solids.
class ReportsFirstTwo : public TruthfulDetector {
 public:
  explicit ReportsFirstTwo(bool solid) : semantics_(TruthfulDetector::semantics()) {
    semantics_.solid = solid;
  }
  const Semantics& semantics() const override { return semantics_; }
  void query(Question question, ContactSet& out) override {
    TruthfulDetector::query(question, out);
    out.bodies = {{0, 1}};
  }

 private:
  Semantics semantics_;
};

/// Drops the pairs 0, 10, 20, ... of every frame.
class DropsEveryTenth : public TruthfulDetector {
  std::vector<ElementPair> spoiled_triangles(std::vector<ElementPair> truth) override {
    std::vector<ElementPair> out;
    for (std::size_t i = 0; i < truth.size(); ++i)
      if (i % 10 != 0) out.push_back(truth[i]);
    return out;
  }
};

/// Reports one more pair of triangles in every frame.
class Invents : public TruthfulDetector {
 public:
  explicit Invents(ElementPair pair) : pair_(pair) {}

 private:
  std::vector<ElementPair> spoiled_triangles(std::vector<ElementPair> truth) override {
    truth.push_back(pair_);
    return truth;
  }
  ElementPair pair_;
};

/// Gives the first body's triangle the number of the second's and the other way round.
class SwapsIds : public TruthfulDetector {
  std::vector<ElementPair> spoiled_triangles(std::vector<ElementPair> truth) override {
    for (ElementPair& p : truth) std::swap(p.a, p.b);
    return truth;
  }
};

/// One frame behind, in both questions.
class AnswersLate : public TruthfulDetector {
 public:
  void update(const Frame& frame) override {
    before_ = std::exchange(now_, {});
    TruthfulDetector::update(frame);
    now_ = truth_;
  }

 private:
  std::vector<ElementPair> spoiled_triangles(std::vector<ElementPair>) override {
    return before_.triangles;
  }
  std::vector<BodyPair> spoiled_bodies(std::vector<BodyPair>) override { return before_.bodies; }
  ContactSet before_, now_;
};

/// Takes contact to be open: bodies whose boxes share no volume do not touch.
class MissesTouching : public TruthfulDetector {
 public:
  void update(const Frame& frame) override {
    TruthfulDetector::update(frame);
    boxes_.clear();
    for (const BodyState& body : frame.bodies) {
      Aabb box;
      for (const Vec3& v : body.vertices) box.extend(v);
      boxes_.push_back(box);
    }
  }

 private:
  bool open_contact(std::uint32_t a, std::uint32_t b) const {
    const Vec3 lo = boxes_[a].lo.cwiseMax(boxes_[b].lo), hi = boxes_[a].hi.cwiseMin(boxes_[b].hi);
    return (lo.array() < hi.array()).all();
  }
  std::vector<ElementPair> spoiled_triangles(std::vector<ElementPair> truth) override {
    std::erase_if(truth, [&](const auto& p) { return !open_contact(p.body_a, p.body_b); });
    return truth;
  }
  std::vector<BodyPair> spoiled_bodies(std::vector<BodyPair> truth) override {
    std::erase_if(truth, [&](const auto& p) { return !open_contact(p.a, p.b); });
    return truth;
  }
  std::vector<Aabb> boxes_;
};

/// Every pair three times, in both orientations: harmless.
class Repeats : public TruthfulDetector {
  std::vector<ElementPair> spoiled_triangles(std::vector<ElementPair> truth) override {
    std::vector<ElementPair> out;
    for (const ElementPair& p : truth)
      out.insert(out.end(), {p, ElementPair{p.body_b, p.body_a, p.b, p.a}, p});
    std::reverse(out.begin(), out.end());
    return out;
  }
};

/// Right about triangles, but never (or always) says that bodies touch.
class LiesAboutBodies : public TruthfulDetector {
 public:
  explicit LiesAboutBodies(bool says_contact) : says_contact_(says_contact) {}

 private:
  std::vector<BodyPair> spoiled_bodies(std::vector<BodyPair>) override {
    return says_contact_ ? std::vector<BodyPair>{{0, 1}} : std::vector<BodyPair>{};
  }
  bool says_contact_;
};

/// Throws in the first frame with contact.
class Throws : public TruthfulDetector {
  std::vector<ElementPair> spoiled_triangles(std::vector<ElementPair> truth) override {
    if (!truth.empty()) throw std::runtime_error("stack overflow in tree");
    return truth;
  }
};

#if defined(__SSE__)
/// Leaves flush-to-zero set, and rounds upward after each answer.
class SpoilsArithmetic : public TruthfulDetector {
 public:
  void query(Question question, ContactSet& out) override {
    TruthfulDetector::query(question, out);
    _mm_setcsr(_mm_getcsr() | 0x8000u);
    _MM_SET_ROUNDING_MODE(_MM_ROUND_UP);
  }
};
#endif

}  // namespace contactcheck::test
