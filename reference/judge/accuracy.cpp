#include "reference/judge/accuracy.h"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "core/types/check.h"
#include "reference/judge/answer_check.h"
#include "reference/judge/episodes.h"
#include "reference/judge/graded_errors.h"
#include "reference/judge/run_notes.h"
#include "reference/judge/step_judge.h"

namespace contactcheck::judge {
namespace {

std::uint64_t heap_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

// Below 0 where more was freed than allocated.
long heap_growth(std::uint64_t before) {
  return static_cast<long>(heap_in_use()) - static_cast<long>(before);
}

std::uint64_t list_bytes(const ContactSet& contacts) {
  std::uint64_t bytes = 0;
  for_each_list([&](ContactList, const auto& list) { bytes += list.capacity() * sizeof(list[0]); },
                contacts);
  return bytes;
}

}  // namespace

JudgedScene judge_scene(const scene::Scene& scene, process::ProgressWriter& progress) {
  JudgedScene judged;
  judged.scene = &scene;
  judged.positions = scene::FramePositions(scene);
  oracle::Oracle oracle(scene.bodies);
  oracle::SurfaceGeometry geometry(scene.bodies);
  PairTally pairs;
  const oracle::WantedSteps steps = wanted_steps(scene);
  std::optional<oracle::StepOracle> step_oracle;
  if (steps.between || steps.own) {
    if (scene.frames < 2) {
      judged.refused = "contact within steps is between frames, and there is only one";
      return judged;
    }
    step_oracle.emplace(scene.bodies);
  }
  for (std::size_t f = 0; f < scene.frames; ++f) {
    progress.enter(process::SharedProgress::kNoDetector, f, process::Phase::kTruth);
    const scene::FramePosition& position = judged.positions[f];
    for (std::size_t b = 0; b < position.nodes.size(); ++b)
      for (std::size_t n = 0; n < position.nodes[b].size(); ++n)
        if (!position.nodes[b][n].allFinite()) {
          judged.refused = "frame " + std::to_string(f) + ", body \"" + scene.bodies[b].name +
                           "\": node " + std::to_string(n) + " is not finite";
          return judged;
        }

    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
      if (const auto torn = torn_weld(*scene.bodies[b].shape, position.vertices[b])) {
        judged.refused = "frame " + std::to_string(f) + ", body \"" + scene.bodies[b].name +
                         "\": vertices " + std::to_string((*torn)[0]) + " and " +
                         std::to_string((*torn)[1]) + " are welded and come apart";
        return judged;
      }

    for (const std::vector<Vec3>& vertices : position.vertices)
      for (const Vec3& vertex : vertices)
        judged.reach = std::max(judged.reach, vertex.cwiseAbs().maxCoeff());

    const Frame frame = judged.frame(f);
    try {
      judged.truth.push_back(oracle.judge(frame, wanted_truth(scene)));
      if (step_oracle && f > 0)
        judged.steps.push_back(
            step_oracle->judge(judged.step(f - 1), judged.truth[f - 1].surface.triangles, steps));
    } catch (const RefusedInput& e) {
      judged.refused = "frame " + std::to_string(f) + ": " + e.what();
      return judged;
    }
    const oracle::Truth& truth = judged.truth.back();
    note_open_bodies(scene.bodies, f, truth.open, judged.open);
    judged.contact_frames.push_back(!truth.surface.bodies.empty() ||
                                    !truth.surface.self_bodies.empty());
    if (scene.pairs()) {
      check_pairs(*scene.pairs(), f, position.vertices, truth, pairs);
      progress.part(kShareOfTruth * static_cast<double>(f) / static_cast<double>(scene.frames));
    }
    if (scene.grades_lengths()) {
      geometry.set_frame(frame);
      std::vector<double>& lengths = judged.contour.emplace_back();
      for (const ElementPair& pair : truth.surface.triangles)
        lengths.push_back(geometry.intersection_length(pair));
    }
  }
  if (scene.pairs()) judged.pairs = std::move(pairs);
  return judged;
}

namespace {

// Only vertices are fed in single precision: the truth of cells and boxes is made of nodes.
RoundedScene* rounded_scene(JudgingTools& tools, const Detector& detector,
                            const Semantics& semantics) {
  if (semantics.precision != Precision::kSingle || !detector.needs_vertices()) return nullptr;
  return tools.rounded({semantics.scale, semantics.local_origin});
}
std::vector<Level> levels_of_vertices(std::vector<Level> levels) {
  std::erase_if(levels, [](Level level) {
    return level == Level::kCell || level == Level::kBox || is_impact(level);
  });
  return levels;
}

// One detector and all frames of a scene, with the sums over them: a function a step.
class AccuracyPass {
 public:
  /// Prepares the detector, whose semantics are final only then.
  AccuracyPass(JudgingTools& tools, std::uint32_t position, Detector& detector,
               process::ProgressWriter& progress, results::Run& run)
      : tools_(tools),
        scene_(*tools.judged.scene),
        position_(position),
        detector_(detector),
        progress_(progress),
        run_(run),
        held_(prepare()),
        levels_(judged_levels(scene_.bodies, tools.judged.open, run.semantics, scene_.levels,
                              &run.not_judged)),
        rounded_(rounded_scene(tools, detector, run.semantics)),
        rounded_levels_(rounded_ == nullptr ? std::vector<Level>{} : levels_of_vertices(levels_)),
        totals_(run.semantics, levels_, scene_.pairs() ? 0 : kListedPairs),
        rounded_totals_(run.semantics, rounded_levels_),
        graded_(scene_.bodies, run.semantics, scene_.size()) {
    for (const Question question : run.semantics.questions)
      outcome_.answers.push_back({question, {}});
    if (!tools.judged.steps.empty()) impacts_.emplace(tools.judged, run.semantics);
  }

  // Frame f, and the step that begins there.
  void judge_frame(std::size_t f) {
    contacts_.clear();
    ask_about(f, false);
    progress_.enter(position_, f, process::Phase::kTrace);
    const StageTrace trace = detector_.trace();
    notes_.add_frame(detector_.notes());
    called("trace");
    if (f + 1 < scene_.frames) ask_about(f, true);
    true_pairs_.push_back(true_body_pairs(run_.semantics.solid, tools_.judged.truth[f]));
    reported_pairs_.push_back(own_bodies_);
    hash_ = chain_hash(hash_, f, contacts_);
    progress_.enter(process::SharedProgress::kNoDetector, f, process::Phase::kTruth);
    compare(f);
    grade(f);
    if (rounded_ != nullptr) compare_rounded(f);
    add_stages(scene_.bodies, trace, tools_.judged.truth[f].surface.triangles, stages_);
  }

  /// Fills what `run` has of the sums.
  AccuracyOutcome finish() {
    const std::vector<bool>& contact = tools_.judged.contact_frames;
    run_.frames = scene_.frames;
    run_.contact_frames =
        static_cast<std::size_t>(std::count(contact.begin(), contact.end(), true));
    run_.contact_hash = results::hex(hash_);
    run_.levels = std::move(totals_.levels);
    run_.levels_rounded = std::move(rounded_totals_.levels);
    run_.per_frame = std::move(totals_.per_frame);
    run_.per_frame.covered_length_fraction = std::move(covered_);
    run_.stages = std::move(stages_);
    outcome_.differences = std::move(totals_.differences);
    outcome_.disagreements = std::move(totals_.disagreements);
    if (scene_.grades_lengths()) run_.geometry = graded_.summary();
    run_.geometry.depth_kind = run_.semantics.depth;
    if (impacts_) run_.impacts = std::move(impacts_->sums);
    if (scene_.follows_time() && !is_of_steps(run_.semantics.questions.front()))
      run_.geometry.episodes = find_episodes(true_pairs_, reported_pairs_);
    sum_up_episodes(run_.geometry);  // once more when gaps are measured
    for (const std::string& why : tools_.judged.open)
      if (run_.semantics.solid && !why.empty())
        run_.notes.push_back("containment not judged: " + why);
    for (const std::string& note : notes_.summary()) run_.notes.push_back(note);
    if (const std::string note = exchanged_.sentence(); !note.empty()) run_.notes.push_back(note);
    return std::move(outcome_);
  }

 private:
  // What the detector's calls have left on the heap, bytes.
  long prepare() {
    progress_.enter(position_, 0, process::Phase::kPrepare);
    const std::uint64_t heap_before = heap_in_use();
    const auto start = std::chrono::steady_clock::now();
    detector_.expect(semantics_in(scene_.levels, detector_.semantics()).questions);
    detector_.prepare(scene_.bodies);
    run_.prepare_ms =
        1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const long held = heap_growth(heap_before);
    run_.prepared_bytes = run_.memory_bytes = bytes_with(held);
    called("prepare");
    run_.semantics = semantics_in(scene_.levels, detector_.semantics());
    if (run_.semantics.questions.empty())
      throw RefusedInput(
          "it answers about steps from frame to frame alone, and the scene has no level of them");
    return held;
  }

  // What it has on this heap, or where other processes do its work, what these have: buffers of
  // pipes are all that is here.
  std::uint64_t bytes_with(long held) const {
    return detector_.bytes_elsewhere().value_or(
        static_cast<std::uint64_t>(std::max<long>(held, 0)));
  }

  // Asks all questions about a frame, or about the step that begins there. Each list is then that
  // of the answer it is judged by.
  void ask_about(std::size_t f, bool step) {
    bool given = false;
    for (JudgedQuestion& asking : outcome_.answers) {
      const Question question = asking.question;
      if (is_of_steps(question) != step) continue;
      const bool own = question == run_.semantics.questions.front();
      if (!given) give(f, step, own);
      given = true;
      answer_.clear();
      progress_.enter(position_, f, process::Phase::kQuery);
      const std::uint64_t heap_before = heap_in_use(), list_before = list_bytes(answer_);
      detector_.query(question, answer_);
      if (own) {
        // The list of contacts is ours, and grows while it is filled.
        held_ += heap_growth(heap_before) - static_cast<long>(list_bytes(answer_) - list_before);
        run_.memory_bytes = std::max(run_.memory_bytes, bytes_with(held_));
      }
      called("query");
      answer_.canonicalize();
      check_answer(scene_, f, answer_);
      asking.frames.push_back(fingerprint_of(answer_, asked(question, run_.semantics)));
      if (own) {
        add_counts(detector_.counts());
        own_bodies_ = answer_.bodies;
      }
      for_each_list(
          [&](ContactList list, auto& judged, const auto& answered) {
            if (own ? is_of_step(list) == step : question_about(list, run_.semantics) == question)
              judged = answered;
          },
          contacts_, answer_);
    }
  }

  void give(std::size_t f, bool step, bool own) {
    progress_.enter(position_, f, process::Phase::kUpdate);
    const std::uint64_t heap_before = heap_in_use();
    if (step) {
      detector_.update_step(tools_.judged.step(f));
    } else {
      detector_.update(tools_.judged.frame(f));
    }
    if (own) held_ += heap_growth(heap_before);
    called("update");
  }

  void add_counts(const std::vector<Count>& counts) {
    if (run_.counters.empty())
      for (const Count& count : counts) run_.counters.emplace_back(count.name, 0);
    CONTACTCHECK_INVARIANT(counts.size() == run_.counters.size(), "the same counts every frame");
    for (std::size_t i = 0; i < counts.size(); ++i) run_.counters[i].second += counts[i].value;
  }

  void compare(std::size_t f) {
    const Semantics& semantics = run_.semantics;
    const TrueNear near =
        true_near(tools_.oracle, tools_.judged.frame(f), levels_, semantics.margin);
    // After the last frame there is no step: nothing is true or reported there.
    const bool steps_on = impacts_ && f + 1 < scene_.frames;
    if (steps_on) impacts_->begin(f, contacts_);
    for (const Level level : levels_) {
      if (is_impact(level)) {
        totals_.add(f, level, steps_on ? impacts_->compare(level, contacts_) : LevelComparison{});
        continue;
      }
      const LevelComparison comparison =
          compare_at(level, scene_.bodies, semantics, tools_.judged.truth[f], contacts_, near);
      totals_.add(f, level, comparison);
      if (level == Level::kTriangle) exchanged_.add_frame(comparison);
    }
    if (impacts_ && f > 0) impacts_->add(f - 1, reported_pairs_[f - 1], reported_pairs_[f], step_);
    if (impacts_) {
      for_each_list(
          [](ContactList list, auto& kept, const auto& answered) {
            if (is_of_step(list)) kept = answered;
          },
          step_, contacts_);
    }
  }

  // Errors with a size: depths, normals, lengths, distances.
  void grade(std::size_t f) {
    std::optional<double>& covered = covered_.emplace_back();
    if (!scene_.grades_lengths()) return;
    tools_.geometry.set_frame(tools_.judged.frame(f));
    covered = graded_.add_frame(tools_.judged.truth[f], tools_.judged.contour[f], contacts_,
                                tools_.geometry);
  }

  // The same answer against the truth for the rounded vertices.
  void compare_rounded(std::size_t f) {
    const Semantics& semantics = run_.semantics;
    const oracle::Truth& truth = rounded_->truth(f, tools_.oracle);
    const TrueNear near =
        true_near(tools_.oracle, rounded_->frame(f), levels_, semantics.margin * semantics.scale);
    for (const Level level : rounded_levels_)
      rounded_totals_.add(f, level,
                          compare_at(level, scene_.bodies, semantics, truth, contacts_, near));
  }

  void called(const char* what) { note_environment(guard_, what, run_); }

  JudgingTools& tools_;
  const scene::Scene& scene_;
  std::uint32_t position_;
  Detector& detector_;
  process::ProgressWriter& progress_;
  results::Run& run_;
  const process::FloatEnvironmentGuard guard_;
  long held_;
  std::vector<Level> levels_;
  RoundedScene* rounded_;  ///< null: fed no rounded vertices
  std::vector<Level> rounded_levels_;

  ContactSet contacts_;  ///< what is judged of all answers about a frame and its step
  ContactSet answer_;
  std::vector<BodyPair> own_bodies_;
  ContactSet step_;  ///< the answer about the step before this frame
  std::optional<StepSums> impacts_;
  AccuracyOutcome outcome_;
  LevelTotals totals_, rounded_totals_;
  GradedErrors graded_;
  std::vector<std::optional<double>> covered_;
  BodyPairsPerFrame true_pairs_, reported_pairs_;
  std::vector<results::Stage> stages_;
  FrameNotes notes_;
  ExchangedPairs exchanged_;
  std::uint64_t hash_ = 0;
};

}  // namespace

AccuracyOutcome run_accuracy(JudgingTools& tools, std::uint32_t position, Detector& detector,
                             process::ProgressWriter& progress, results::Run& run) {
  AccuracyPass pass(tools, position, detector, progress, run);
  for (std::size_t f = 0; f < tools.judged.scene->frames; ++f) pass.judge_frame(f);
  return pass.finish();
}

}  // namespace contactcheck::judge
