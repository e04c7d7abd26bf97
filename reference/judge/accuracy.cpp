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

std::uint64_t list_bytes(const ContactSet& c) {
  const auto bytes = [](const auto& list) { return list.capacity() * sizeof(list[0]); };
  return bytes(c.bodies) + bytes(c.cells) + bytes(c.triangles) + bytes(c.vertices) + bytes(c.near) +
         bytes(c.self) + bytes(c.self_cells) + bytes(c.self_near) + bytes(c.self_bodies) +
         bytes(c.piece_contacts) + bytes(c.vertex_contacts);
}

}  // namespace

JudgedScene judge_scene(const scene::Scene& scene, process::ProgressWriter& progress) {
  JudgedScene judged;
  judged.scene = &scene;
  judged.positions = scene::FramePositions(scene);
  oracle::Oracle oracle(scene.bodies);
  oracle::SurfaceGeometry geometry(scene.bodies);
  PairTally pairs;
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
    } catch (const RefusedInput& e) {
      judged.refused = "frame " + std::to_string(f) + ": " + e.what();
      return judged;
    }
    const oracle::Truth& truth = judged.truth.back();
    note_open_bodies(scene.bodies, f, truth.open, judged.open);
    judged.contact_frames.push_back(!truth.surface.bodies.empty() ||
                                    !truth.surface.self_bodies.empty());
    if (scene.pairs) {
      check_pairs(*scene.pairs, f, position.vertices, truth, pairs);
      progress.part(kShareOfTruth * static_cast<double>(f) / static_cast<double>(scene.frames));
    }
    if (scene.grades_lengths()) {
      geometry.set_frame(frame);
      std::vector<double>& lengths = judged.contour.emplace_back();
      for (const ElementPair& pair : truth.surface.triangles)
        lengths.push_back(geometry.intersection_length(pair));
    }
  }
  if (scene.pairs) judged.pairs = std::move(pairs);
  return judged;
}

AccuracyOutcome run_accuracy(JudgingTools& tools, std::uint32_t position, Detector& detector,
                             process::ProgressWriter& progress, results::Run& run) {
  const scene::Scene& scene = *tools.judged.scene;
  const process::FloatEnvironmentGuard guard;

  // Prepare. The semantics are final only then.
  progress.enter(position, 0, process::Phase::kPrepare);
  std::uint64_t heap_before = heap_in_use();
  const auto start = std::chrono::steady_clock::now();
  detector.expect(semantics_in(scene.levels, detector.semantics()).questions);
  detector.prepare(scene.bodies);
  run.prepare_ms =
      1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  long held = heap_growth(heap_before);  // what the detector's calls have left on the heap, bytes
  run.prepared_bytes = run.memory_bytes = static_cast<std::uint64_t>(std::max<long>(held, 0));
  note_environment(guard, "prepare", run);
  run.semantics = semantics_in(scene.levels, detector.semantics());
  const Semantics& semantics = run.semantics;
  const Question own = semantics.questions.front();

  const std::vector<Level> levels =
      judged_levels(scene.bodies, tools.judged.open, semantics, scene.levels, &run.not_judged);
  RoundedScene* rounded = nullptr;
  std::vector<Level> rounded_levels;
  if (semantics.precision == Precision::kSingle && detector.needs_vertices())
    rounded = tools.rounded({semantics.scale, semantics.local_origin});
  if (rounded != nullptr) {
    // Only vertices are fed in single precision. The truth of cells and boxes is made of nodes.
    rounded_levels = levels;
    std::erase_if(rounded_levels,
                  [](Level level) { return level == Level::kCell || level == Level::kBox; });
  }

  // Sums over frames.
  AccuracyOutcome outcome;
  for (const Question question : semantics.questions) outcome.answers.push_back({question, {}});
  LevelTotals totals(semantics, levels, scene.pairs ? 0 : kListedPairs);
  LevelTotals rounded_totals(semantics, rounded_levels);
  GradedErrors graded(scene.bodies, semantics, scene.size());
  std::vector<std::optional<double>> covered;
  BodyPairsPerFrame true_pairs, reported_pairs;
  std::vector<results::Stage> stages;
  FrameNotes notes;
  ExchangedPairs exchanged;
  std::uint64_t hash = 0;
  ContactSet contacts, other;

  for (std::size_t f = 0; f < scene.frames; ++f) {
    const Frame frame = tools.judged.frame(f);
    const oracle::Truth& truth = tools.judged.truth[f];

    // 1. The detector's own question.
    contacts.clear();
    progress.enter(position, f, process::Phase::kUpdate);
    heap_before = heap_in_use();
    detector.update(frame);
    held += heap_growth(heap_before);
    note_environment(guard, "update", run);
    progress.enter(position, f, process::Phase::kQuery);
    heap_before = heap_in_use();
    const std::uint64_t list_before = list_bytes(contacts);
    detector.query(own, contacts);
    // The list of contacts is ours, and grows while it is filled.
    held += heap_growth(heap_before) - static_cast<long>(list_bytes(contacts) - list_before);
    run.memory_bytes =
        std::max(run.memory_bytes, static_cast<std::uint64_t>(std::max<long>(held, 0)));
    note_environment(guard, "query", run);
    contacts.canonicalize();
    check_answer(scene, f, contacts);
    outcome.answers.front().frames.push_back(fingerprint_of(contacts, asked(own, semantics)));
    const std::vector<Count> counts = detector.counts();
    if (run.counters.empty())
      for (const Count& count : counts) run.counters.emplace_back(count.name, 0);
    CONTACTCHECK_INVARIANT(counts.size() == run.counters.size(), "the same counts every frame");
    for (std::size_t i = 0; i < counts.size(); ++i) run.counters[i].second += counts[i].value;
    true_pairs.push_back(true_body_pairs(semantics.solid, truth));
    reported_pairs.push_back(contacts.bodies);

    // 2. Its other questions. Each level is judged by the answer to its question, depths and
    // normals by the answer to `contacts`.
    for (std::size_t q = 1; q < outcome.answers.size(); ++q) {
      const Question question = outcome.answers[q].question;
      ask(detector, question, scene, f, other);
      outcome.answers[q].frames.push_back(fingerprint_of(other, asked(question, semantics)));
      note_environment(guard, "query", run);
      const auto judges = [&](Level level) { return question_of(level, semantics) == question; };
      if (judges(Level::kBody)) contacts.bodies = other.bodies;
      if (judges(Level::kCell)) contacts.cells = other.cells;
      if (judges(Level::kTriangle)) contacts.triangles = other.triangles;
      if (judges(Level::kVertex)) contacts.vertices = other.vertices;
      if (judges(Level::kNear)) contacts.near = other.near;
      if (judges(Level::kSelf)) {
        contacts.self = other.self;
        contacts.self_cells = other.self_cells;
        contacts.self_near = other.self_near;
        contacts.self_bodies = other.self_bodies;
      }
      if (question == Question::kContacts) {
        contacts.piece_contacts = other.piece_contacts;
        contacts.vertex_contacts = other.vertex_contacts;
      }
    }
    hash = chain_hash(hash, f, contacts);
    progress.enter(position, f, process::Phase::kTrace);
    const StageTrace trace = detector.trace();
    notes.add_frame(detector.notes());
    note_environment(guard, "trace", run);

    // 3. The answer compared with the ground truth, at each level.
    progress.enter(process::SharedProgress::kNoDetector, f, process::Phase::kTruth);
    TrueNear near = true_near(tools.oracle, frame, levels, semantics.margin);
    for (const Level level : levels) {
      const LevelComparison comparison =
          compare_at(level, scene.bodies, semantics, truth, contacts, near);
      totals.add(f, level, comparison);
      if (level == Level::kTriangle) exchanged.add_frame(comparison);
    }

    // 4. Errors with a size.
    std::optional<double>& covered_here = covered.emplace_back();
    if (scene.grades_lengths()) {
      tools.geometry.set_frame(frame);
      covered_here = graded.add_frame(truth, tools.judged.contour[f], contacts, tools.geometry);
    }

    // 5. The same answer compared with the truth for the rounded vertices.
    if (rounded != nullptr) {
      const oracle::Truth& rounded_truth = rounded->truth(f, tools.oracle);
      near = true_near(tools.oracle, rounded->frame(f), levels, semantics.margin * semantics.scale);
      for (const Level level : rounded_levels)
        rounded_totals.add(
            f, level, compare_at(level, scene.bodies, semantics, rounded_truth, contacts, near));
    }

    // 6. Which stage missed which true pairs.
    add_stages(scene.bodies, trace, truth.surface.triangles, stages);
  }

  const std::vector<bool>& contact = tools.judged.contact_frames;
  run.frames = scene.frames;
  run.contact_frames = static_cast<std::size_t>(std::count(contact.begin(), contact.end(), true));
  run.contact_hash = results::hex(hash);
  run.levels = std::move(totals.levels);
  run.levels_rounded = std::move(rounded_totals.levels);
  run.per_frame = std::move(totals.per_frame);
  run.per_frame.covered_length_fraction = std::move(covered);
  run.stages = std::move(stages);
  outcome.differences = std::move(totals.differences);
  outcome.disagreements = std::move(totals.disagreements);
  if (scene.grades_lengths()) run.geometry = graded.summary();
  run.geometry.depth_kind = semantics.depth;
  if (scene.follows_time()) run.geometry.episodes = find_episodes(true_pairs, reported_pairs);
  sum_up_episodes(run.geometry);  // once more when gaps are measured
  for (const std::string& why : tools.judged.open)
    if (semantics.solid && !why.empty()) run.notes.push_back("containment not judged: " + why);
  for (const std::string& note : notes.summary()) run.notes.push_back(note);
  if (const std::string note = exchanged.sentence(); !note.empty()) run.notes.push_back(note);
  return outcome;
}

}  // namespace contactcheck::judge
