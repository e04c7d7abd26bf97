#include "reference/run/accuracy.h"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "core/types/check.h"
#include "reference/compare/episodes.h"
#include "reference/compare/graded_judge.h"
#include "reference/compare/judge.h"
#include "reference/compare/stage_losses.h"
#include "reference/run/answer_check.h"
#include "reference/run/run_notes.h"

namespace contactcheck {
namespace {

std::uint64_t heap_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

// What was taken since then; below 0 where more was given back.
long signed_growth(std::uint64_t before) {
  return static_cast<long>(heap_in_use()) - static_cast<long>(before);
}

template <typename T>
std::uint64_t held_bytes(const std::vector<T>& list) {
  return list.capacity() * sizeof(T);
}

std::uint64_t list_bytes(const ContactSet& c) {
  return held_bytes(c.bodies) + held_bytes(c.cells) + held_bytes(c.triangles) +
         held_bytes(c.vertices) + held_bytes(c.near) + held_bytes(c.piece_contacts) +
         held_bytes(c.vertex_contacts);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// The levels whose truth is made of vertices, which alone are fed in single precision.
std::vector<Level> vertex_levels(std::vector<Level> levels) {
  std::erase_if(levels, [](Level level) { return level == Level::kCell || level == Level::kBox; });
  return levels;
}

bool judges_near(const std::vector<Level>& levels) {
  return std::find(levels.begin(), levels.end(), Level::kNear) != levels.end();
}

/// One detector on one scene, from prepare to the last frame.
class AccuracyPass {
 public:
  AccuracyPass(JudgingTools& tools, std::uint32_t position, Detector& detector,
               ProgressWriter& progress, results::Run& run)
      : tools_(tools),
        scene_(*tools.judged.scene),
        position_(position),
        detector_(detector),
        progress_(progress),
        run_(run) {}

  AccuracyOutcome run() {
    prepare();
    make_judges();
    for (const Question question : run_.semantics.questions)
      outcome_.answers.push_back({question, {}});
    for (std::size_t f = 0; f < scene_.frames; ++f) add_frame(f);
    finish();
    return outcome_;
  }

 private:
  void prepare() {
    progress_.enter(position_, 0, Phase::kPrepare);
    const std::uint64_t heap_before = heap_in_use();
    const auto start = std::chrono::steady_clock::now();
    detector_.prepare(scene_.bodies);
    run_.prepare_ms = 1e3 * seconds_since(start);
    held_ = signed_growth(heap_before);
    run_.prepared_bytes = run_.memory_bytes = static_cast<std::uint64_t>(std::max<long>(held_, 0));
    note_environment(guard_, "prepare", run_);
    run_.semantics = detector_.semantics();
  }

  // After prepare(): only then are the semantics final.
  void make_judges() {
    const Semantics& semantics = run_.semantics;
    levels_ = judged_levels(scene_.bodies, semantics, scene_.levels, &run_.not_judged);
    judge_.emplace(scene_.bodies, semantics, levels_, scene_.pairs ? 0 : kListedPairs);
    graded_.emplace(scene_.bodies, semantics, scene_.size());
    losses_.emplace(scene_.bodies);
    if (semantics.precision != Precision::kSingle || !detector_.needs_vertices()) return;
    rounded_ = tools_.rounded(rounding_of(semantics));
    if (rounded_ != nullptr)
      rounded_judge_.emplace(scene_.bodies, semantics, vertex_levels(levels_));
  }

  void add_frame(std::size_t f) {
    const Frame frame = tools_.judged.frame(f);
    const AnswerCheck check(scene_, f);
    answer_own_question(frame, check);
    hash_ = chain_hash(hash_, f, contacts_);
    truth_pairs_.push_back(tools_.judged.truth[f].surface.bodies);
    reported_pairs_.push_back(contacts_.bodies);
    answer_other_questions(check);
    progress_.enter(position_, f, Phase::kTrace);
    const StageTrace trace = detector_.trace();
    notes_.add_frame(detector_.notes());
    note_environment(guard_, "trace", run_);
    progress_.enter(SharedProgress::kNoDetector, f, Phase::kTruth);
    judge_frame(frame);
    losses_->add_frame(trace, tools_.judged.truth[f].surface.triangles);
  }

  void answer_own_question(const Frame& frame, const AnswerCheck& check) {
    contacts_.clear();
    progress_.enter(position_, frame.index, Phase::kUpdate);
    const std::uint64_t heap_before = heap_in_use();
    detector_.update(frame);
    held_ += signed_growth(heap_before);
    note_environment(guard_, "update", run_);
    progress_.enter(position_, frame.index, Phase::kQuery);
    const std::uint64_t heap_asked = heap_in_use(), list_before = list_bytes(contacts_);
    detector_.query(own(), contacts_);
    // The list of contacts is ours, and grows while it is filled.
    held_ += signed_growth(heap_asked) - static_cast<long>(list_bytes(contacts_) - list_before);
    run_.memory_bytes =
        std::max(run_.memory_bytes, static_cast<std::uint64_t>(std::max<long>(held_, 0)));
    note_environment(guard_, "query", run_);
    contacts_.canonicalize();
    check(contacts_);
    remember(own(), contacts_);
    add_counts();
  }

  void remember(Question question, const ContactSet& answer) {
    for (JudgedQuestion& judged : outcome_.answers)
      if (judged.question == question)
        judged.frames.push_back(print_of(answer, {question, question == own()}));
  }

  void add_counts() {
    const std::vector<Count> counts = detector_.counts();
    if (run_.counters.empty()) {
      for (const Count& count : counts) run_.counters.emplace_back(count.name, count.value);
      return;
    }
    CONTACTCHECK_INVARIANT(counts.size() == run_.counters.size(), "the same counts every frame");
    for (std::size_t i = 0; i < counts.size(); ++i) run_.counters[i].second += counts[i].value;
  }

  void answer_other_questions(const AnswerCheck& check) {
    for (Question question : run_.semantics.questions) {
      if (question == own()) continue;
      ask(detector_, question, check, other_);
      remember(question, other_);
      note_environment(guard_, "query", run_);
      if (question == Question::kBody) contacts_.bodies = other_.bodies;
      if (question == Question::kContacts) {
        contacts_.piece_contacts = other_.piece_contacts;
        contacts_.vertex_contacts = other_.vertex_contacts;
      }
    }
  }

  void judge_frame(const Frame& frame) {
    const std::size_t f = frame.index;
    const Truth& truth = tools_.judged.truth[f];
    std::vector<NearPair> near;
    if (judges_near(levels_)) near = tools_.oracle.near(frame, run_.semantics.margin);
    judge_->add_frame(f, truth, contacts_, near);
    grade_frame(frame, truth);
    if (rounded_judge_) judge_rounded(f);
  }

  void grade_frame(const Frame& frame, const Truth& truth) {
    if (!scene_.grades_lengths()) return covered_.push_back(std::nullopt);
    tools_.geometry.set_frame(frame);
    graded_->add_frame(truth, tools_.judged.contour[frame.index], contacts_, tools_.geometry);
    covered_.push_back(graded_->last_covered_fraction());
  }

  void judge_rounded(std::size_t f) {
    const Truth& truth = rounded_->truth(f, tools_.oracle);
    std::vector<NearPair> near;
    if (judges_near(levels_))
      near = tools_.oracle.near(rounded_->frame(f), run_.semantics.margin * run_.semantics.scale);
    rounded_judge_->add_frame(f, truth, contacts_, near);
  }

  void finish() {
    const std::vector<bool>& contact = tools_.judged.contact_frames;
    run_.frames = scene_.frames;
    run_.contact_frames =
        static_cast<std::size_t>(std::count(contact.begin(), contact.end(), true));
    run_.levels = judge_->levels();
    if (rounded_judge_) run_.levels_rounded = rounded_judge_->levels();
    run_.per_frame = judge_->per_frame();
    run_.per_frame.covered_length_fraction = covered_;
    outcome_.differences = judge_->differences();
    outcome_.disagreements = judge_->disagreements();
    if (scene_.grades_lengths()) run_.geometry = graded_->errors();
    run_.geometry.depth_kind = run_.semantics.depth;
    if (scene_.follows_time())
      run_.geometry.episodes = find_episodes(truth_pairs_, reported_pairs_);
    sum_up_episodes(run_.geometry);  // once more when gaps are measured (hover.h)
    run_.contact_hash = results::hex(hash_);
    run_.stages = losses_->stages();
    for (const std::string& note : notes_.summary()) run_.notes.push_back(note);
  }

  Question own() const { return run_.semantics.questions.front(); }

  JudgingTools& tools_;
  const Scene& scene_;
  std::uint32_t position_;
  Detector& detector_;
  ProgressWriter& progress_;
  results::Run& run_;
  long held_ = 0;  ///< heap that the detector's calls have left, bytes
  const FloatEnvironmentGuard guard_;
  std::vector<Level> levels_;
  std::optional<Judge> judge_, rounded_judge_;
  std::optional<GradedJudge> graded_;
  std::optional<StageLosses> losses_;
  RoundedScene* rounded_ = nullptr;
  std::uint64_t hash_ = 0;
  ContactSet contacts_, other_;
  BodyPairsPerFrame truth_pairs_, reported_pairs_;
  std::vector<std::optional<double>> covered_;
  FrameNotes notes_;
  AccuracyOutcome outcome_;
};

}  // namespace

AccuracyOutcome run_accuracy(JudgingTools& tools, std::uint32_t position, Detector& detector,
                             ProgressWriter& progress, results::Run& run) {
  return AccuracyPass(tools, position, detector, progress, run).run();
}

}  // namespace contactcheck
