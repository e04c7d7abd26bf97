#include "tests/conformance/observation.h"

#include <algorithm>
#include <map>

#include "core/types/check.h"
#include "core/types/impact.h"
#include "core/types/local_origin.h"
#include "reference/judge/judge.h"
#include "reference/judge/step_judge.h"
#include "reference/oracle/oracle.h"
#include "reference/oracle/step_truth.h"
#include "reference/process/float_environment.h"
#include "tests/conformance/answers.h"

namespace contactcheck::test {
namespace {

// The level `box` is made of nodes, which no detector in single precision is fed.
std::vector<Level> judgeable_levels(const Case& scene, const Semantics& semantics) {
  oracle::Oracle oracle(scene.bodies);
  std::vector<std::string> open;
  for (std::size_t f = 0; f < scene.frames.size(); ++f)
    judge::note_open_bodies(scene.bodies, f, oracle.containment(scene.frames[f].frame(f), {}).open,
                            open);
  std::vector<Level> levels =
      judge::judged_levels(scene.bodies, open, semantics, semantics.levels, nullptr);
  std::erase_if(levels, is_impact);  // observe_steps() judges these
  if (semantics.precision == Precision::kSingle)
    std::erase_if(levels, [](Level l) { return l == Level::kCell || l == Level::kBox; });
  return levels;
}

oracle::WantedTruth wanted_truth(const std::vector<Level>& levels, const Semantics& semantics) {
  const auto has = [&](Level l) {
    return std::find(levels.begin(), levels.end(), l) != levels.end();
  };
  oracle::WantedTruth wanted;
  wanted.containment = has(Level::kContainment) || semantics.solid;
  wanted.vertices = has(Level::kVertex);
  wanted.boxes = has(Level::kBox);
  wanted.self = any_self(levels);
  return wanted;
}

// Stored as a float in between: g++ 12 may leave out a way there and back.
double fed_coordinate(double x, double origin, const Semantics& semantics) {
  const volatile float fed =
      semantics.local_origin ? local_value(x, origin) : fed_value(x, semantics.scale);
  return fed;
}

/// The vertices as the detector was fed them, in double.
FrameData as_fed(FrameData data, const Semantics& semantics) {
  if (semantics.precision == Precision::kDouble) return data;
  const Vec3 origin = semantics.local_origin ? local_origin(data.frame(0)) : Vec3::Zero();
  for (std::vector<Vec3>& body : data.vertices)
    for (Vec3& v : body)
      for (int k = 0; k < 3; ++k) v[k] = fed_coordinate(v[k], origin[k], semantics);
  return data;
}

// The own question answers for the elements, `body` for the bodies: as a run judges them.
ContactSet judged_answer(const Answers& answers, const Semantics& semantics) {
  ContactSet set = answers.at(semantics.questions.front());
  const auto body = answers.find(Question::kBody);
  if (body != answers.end()) set.bodies = body->second.bodies;
  if (const auto self = answers.find(Question::kSelf); self != answers.end()) {
    set.self = self->second.self;
    set.self_cells = self->second.self_cells;
    set.self_near = self->second.self_near;
    set.self_bodies = self->second.self_bodies;
  }
  return set;
}

std::unique_ptr<Detector> prepared(const Maker& make, const std::vector<Body>& bodies) {
  std::unique_ptr<Detector> detector = make();
  detector->prepare(bodies);
  return detector;
}

bool visits_are_named(const StageTrace& trace) {
  return std::all_of(trace.stages.begin(), trace.stages.end(), [](const StageRecord& s) {
    return !s.name.empty() && !s.unit.empty() && (s.visited == 0 || !s.visited_unit.empty());
  });
}

class Observer {
 public:
  Observer(const Maker& make, const Case& scene)
      : scene_(scene),
        detector_(prepared(make, scene.bodies)),
        semantics_(detector_->semantics()),
        levels_(judgeable_levels(scene, semantics_)),
        wanted_(wanted_truth(levels_, semantics_)),
        oracle_(scene.bodies),
        totals_(semantics_, levels_) {}

  void add_frame(std::size_t f) {
    const Answers answers = ask(*detector_, scene_.frames[f], f);
    for (const auto& [question, set] : answers) {
      count("invalid id", invalid_ids(set, scene_.bodies));
      count("unusable contact", unusable_contacts(set));
      count("list of another question", lists_of_other_questions(set, question));
    }
    count("contradiction", contradictions(answers, semantics_));
    count("unnamed visits", visits_are_named(detector_->trace()) ? 0 : 1);
    judge(f, judged_answer(answers, semantics_));
    out_.details += "\n  frame " + std::to_string(f) + ": " + text(answers);
  }

  void judge(std::size_t f, const ContactSet& answer) {
    const FrameData fed = as_fed(scene_.frames[f], semantics_);
    const Frame frame = fed.frame(f);
    // The margin as fed: semantics give it in metres.
    const judge::TrueNear near =
        judge::true_near(oracle_, frame, levels_, semantics_.margin * semantics_.scale);
    const oracle::Truth truth = oracle_.judge(frame, wanted_);
    for (const Level level : levels_)
      totals_.add(f, level,
                  judge::compare_at(level, scene_.bodies, semantics_, truth, answer, near));
  }

  Observation result() {
    for (const auto& [level, counts] : totals_.levels) {
      const std::string name = name_of(level);
      count(name + " missed", counts.missed);
      count(name + " spurious", counts.spurious);
      out_.details += "\n  " + name + ": truth " + std::to_string(counts.truth) + ", reported " +
                      std::to_string(counts.reported) + ", hit " + std::to_string(counts.hit);
    }
    for (const std::string& note : detector_->notes()) out_.details += "\n  note: " + note;
    return out_;
  }

 private:
  void count(const std::string& what, std::uint64_t times) {
    if (times > 0) out_.findings[what] += times;
  }

  const Case& scene_;
  std::unique_ptr<Detector> detector_;
  const Semantics semantics_;
  const std::vector<Level> levels_;
  const oracle::WantedTruth wanted_;
  oracle::Oracle oracle_;
  judge::LevelTotals totals_;
  Observation out_;
};

const std::vector<oracle::StepTruth>& step_truths(const Case& scene) {
  // Of each case once: the truth takes longer than any detector.
  static std::map<std::string, std::vector<oracle::StepTruth>> known;
  const auto [place, is_new] = known.try_emplace(scene.name);
  if (is_new) place->second = step_truth_of(scene);
  return place->second;
}

class StepObserver {
 public:
  StepObserver(const Maker& make, const Case& scene)
      : scene_(scene),
        detector_(prepared(make, scene.bodies)),
        levels_(detector_->semantics().levels) {
    CONTACTCHECK_INVARIANT(detector_->semantics().precision == Precision::kDouble,
                           "steps are fed in doubles");
    std::erase_if(levels_, [](Level level) { return !is_impact(level); });
  }

  void add_step(std::size_t s) {
    const process::FloatEnvironmentGuard environment;
    const Answers answers = ask(*detector_, scene_, Moment::kStep, s);
    const std::string changed = environment.check_and_restore();
    count("floating-point environment", changed.empty() ? 0 : 1);
    ContactSet judged;
    for (const auto& [question, set] : answers) {
      count("invalid id", invalid_ids(set, scene_.bodies));
      count("unusable time", unusable_times(set));
      count("list of another question", lists_of_other_questions(set, question));
      for_each_list(
          [&](ContactList list, auto& all, const auto& answered) {
            if (is_of_step(list) && judge::question_about(list, detector_->semantics()) == question)
              all = answered;
          },
          judged, set);
    }
    out_.details += "\n  step " + std::to_string(s) + ": " + text(answers) + changed;
    judge(step_truths(scene_)[s], judged);
  }

  Observation result() {
    for (const std::string& note : detector_->notes()) out_.details += "\n  note: " + note;
    return out_;
  }

 private:
  void judge(const oracle::StepTruth& truth, const ContactSet& answer) {
    for (const Level level : levels_) {
      const results::LevelCounts counts =
          judge::compare_step_at(level, truth.contacts, answer).counts;
      const std::string name = name_of(level);
      count(name + " missed", counts.missed);
      count(name + " spurious", counts.spurious);
      out_.details += "\n    " + name + ": truth " + std::to_string(counts.truth) + ", reported " +
                      std::to_string(counts.reported) + ", hit " + std::to_string(counts.hit);
    }
    for (const BodyImpact& impact : answer.impacts)
      for (const oracle::FirstImpact& first : truth.first)
        if (impact.bodies == first.bodies && impact.time) judge(first, *impact.time);
  }

  // Both the time and the truth are within a width of the time that is meant.
  void judge(const oracle::FirstImpact& first, double time) {
    count("time early", time < first.earliest - kImpactTimeWidth ? 1 : 0);
    count("time late", time > first.latest ? 1 : 0);
    out_.details +=
        "\n    time " + std::to_string(time) + ", truth " + std::to_string(first.earliest);
  }

  void count(const std::string& what, std::uint64_t times) {
    if (times > 0) out_.findings[what] += times;
  }

  const Case& scene_;
  std::unique_ptr<Detector> detector_;
  std::vector<Level> levels_;
  Observation out_;
};

}  // namespace

std::vector<oracle::StepTruth> step_truth_of(const Case& scene) {
  oracle::Oracle frames(scene.bodies);
  oracle::StepOracle steps(scene.bodies);
  std::vector<oracle::StepTruth> out;
  for (std::size_t s = 0; s < count_of(scene, Moment::kStep); ++s) {
    const Frame start = scene.frames[s].frame(s), end = scene.frames[s + 1].frame(s + 1);
    const oracle::Truth at_start = frames.judge(start, {});
    out.push_back(steps.judge({start, end}, at_start.surface.triangles, {true, true}));
  }
  return out;
}

Observation observe_steps(const Maker& make, const Case& scene) {
  return guarded([&] {
    StepObserver observer(make, scene);
    for (std::size_t s = 0; s < count_of(scene, Moment::kStep); ++s) observer.add_step(s);
    return observer.result();
  });
}

Observation observe(const Maker& make, const Case& scene) {
  return guarded([&] {
    Observer observer(make, scene);
    for (std::size_t f = 0; f < scene.frames.size(); ++f) observer.add_frame(f);
    return observer.result();
  });
}

Observation guarded(const std::function<Observation()>& what) {
  try {
    return what();
  } catch (const RefusedInput& e) {
    return {{{"refused", 1}}, e.what()};
  } catch (const std::exception& e) {
    return {{{"exception", 1}}, e.what()};
  }
}

}  // namespace contactcheck::test
