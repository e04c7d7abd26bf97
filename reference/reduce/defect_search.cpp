#include "reference/reduce/defect_search.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>

#include "core/types/check.h"
#include "reference/reduce/probe_worker.h"
#include "reference/reduce/reduction.h"
#include "reference/text/printable.h"

namespace contactcheck::reduce {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kPollInterval = std::chrono::milliseconds(20);
// The exact judgement of a large frame may take longer than a detector is given.
constexpr double kSecondsOfOwnCode = 600.0;
constexpr double kSecondsToLeave = 5.0;
// As for the workers of a run (supervisor.cpp).

std::vector<std::string> words_of(const ProbeSettings& settings) {
  std::vector<std::string> words = {"probe", settings.detector, "--channel-fd",
                                    std::to_string(process::WorkerProcess::kInheritedFd)};
  for (const std::string& plugin : settings.plugins) words.push_back("--plugin=" + plugin);
  return words;
}

}  // namespace

Probe::Connection::Connection(const ProbeSettings& settings, Channel theirs, Channel own)
    : channel(std::move(own)), process(settings.executable, words_of(settings), theirs.fd()) {}

void Probe::connect() {
  auto [theirs, own] = Channel::pair();
  connection_ = std::make_unique<Connection>(settings_, std::move(theirs), std::move(own));
}

void Probe::pass_on_interrupt() {
  if (!interrupts_.interrupted()) return;
  connection_.reset();
  interrupts_.pass_on();
}

ProbeVerdict Probe::ask(const Snapshot& snapshot, const std::vector<Level>& levels) {
  pass_on_interrupt();  // quick answers leave no time to look while they are waited for
  ++asked_;
  const std::string request = probe_request(snapshot, levels);
  // What a detector has overwritten in an earlier frame may strike in the suite's own code; that
  // does not happen in a fresh process.
  for (int attempt = 0; attempt < 2; ++attempt) {
    if (!connection_) connect();
    if (const std::optional<ProbeVerdict> verdict = exchange(request)) return *verdict;
  }
  throw std::runtime_error("a worker process ended while it judged a frame, outside any detector");
}

// Nothing when the process ended before the detector's turn.
std::optional<ProbeVerdict> Probe::exchange(const std::string& request) {
  const bool sent = connection_->channel.send(request);
  const std::string own_limit = limit_passed_before_message(kSecondsOfOwnCode);
  if (!sent || !own_limit.empty() || !connection_->channel.receive()) {
    end_of_process(own_limit);
    return std::nullopt;
  }
  const std::string limit = limit_passed_before_message(settings_.call_limit);
  const std::optional<std::string> answer =
      limit.empty() ? connection_->channel.receive() : std::nullopt;
  return answer ? verdict_from_text(*answer) : end_of_process(limit);
}

std::string Probe::limit_passed_before_message(double seconds) {
  const Clock::time_point start = Clock::now();
  while (!connection_->channel.waits(kPollInterval)) {
    pass_on_interrupt();
    if (std::chrono::duration<double>(Clock::now() - start).count() > seconds) return "time limit";
    if (connection_->process.resident_bytes() > settings_.memory_limit) return "memory limit";
    if (connection_->process.output_bytes() > process::kWorkerOutputLimit) return "output limit";
    // A child of the library may hold the channel open.
    if (connection_->process.has_ended()) break;
  }
  return "";
}

// Its side of the channel is closed; exit handlers of libraries may hang.
bool Probe::leaves_by_itself() const {
  const Clock::time_point start = Clock::now();
  while (!connection_->process.has_ended()) {
    if (std::chrono::duration<double>(Clock::now() - start).count() > kSecondsToLeave) return false;
    std::this_thread::sleep_for(kPollInterval);
  }
  return true;
}

ProbeVerdict Probe::end_of_process(const std::string& limit) {
  if (!limit.empty() || !leaves_by_itself()) connection_->process.kill();
  const int status = connection_->process.reap();
  ProbeVerdict verdict;
  verdict.status = results::Status::kError;
  verdict.how = limit.empty() ? process::describe_status(status) : limit;
  verdict.message = text::printable_line(connection_->process.error_text());
  connection_.reset();
  return verdict;
}

namespace {

// Where it is not known yet what is wrong.
std::vector<Level> levels_of(const ReductionTask& task) {
  if (!task.level.empty()) return levels_for(task.level, task.self);
  std::vector<Level> levels;
  for (const Level level : kLevels)
    if (is_self(level) ? task.self : can_be_reduced(name_of(level))) levels.push_back(level);
  return levels;
}

Snapshot only(const Snapshot& all, const std::set<std::size_t>& bodies) {
  Snapshot out;
  for (const std::size_t b : bodies) {
    out.bodies.push_back(all.bodies[b]);
    out.nodes.push_back(all.nodes[b]);
  }
  return out;
}

bool is_about(const ProbeVerdict& verdict, const Finding& finding,
              const std::array<std::size_t, 2>& bodies) {
  const ElementPair& pair = disagreement_of(verdict, finding).pair;
  return std::minmax<std::size_t>(pair.body_a, pair.body_b) == std::minmax(bodies[0], bodies[1]);
}

using ShowsBodies = std::function<bool(const std::set<std::size_t>&)>;

// `needed` and no more of the others than it takes. @pre all bodies show
std::set<std::size_t> fewest_bodies(std::size_t count, const std::set<std::size_t>& needed,
                                    const ShowsBodies& shows) {
  if (needed.size() == count || (!needed.empty() && shows(needed))) return needed;
  std::vector<std::size_t> others;
  for (std::size_t b = 0; b < count; ++b)
    if (!needed.contains(b)) others.push_back(b);
  const auto with_needed = [&](const std::vector<std::size_t>& some) {
    std::set<std::size_t> bodies = needed;
    bodies.insert(some.begin(), some.end());
    return bodies;
  };
  return with_needed(minimal_subset(
      others, [&](const auto& some) { return shows(with_needed(some)); }, [] { return true; }));
}

// An error tells no bodies: two may do, or with self-contact one.
std::set<std::size_t> bodies_of_error(std::size_t count, bool self, const ShowsBodies& shows) {
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = self ? a : a + 1; b < count; ++b)
      if (shows({a, b})) return {a, b};
  return fewest_bodies(count, {}, shows);
}

[[noreturn]] void refuse_without_finding(const std::vector<ReductionTask>& tasks,
                                         const std::string& detector, bool is_case,
                                         const ProbeVerdict& last) {
  const ReductionTask& task = tasks.front();
  const std::string place = tasks.size() == 1 ? where(task) : task.scene + ", every frame";
  const std::string wanted = (task.kind.empty() ? "wrong" : task.kind) +
                             (task.level.empty() ? "" : " at level " + task.level);
  if (last.status != results::Status::kOk)
    throw InputError(place + ": nothing is " + wanted + ": the answer of " + detector + " is \"" +
                     name_of(last.status) + "\": " + last.message);
  std::string why_not_judged;
  for (const auto& [judged, why] : last.not_judged)
    if (task.level == name_of(judged)) why_not_judged = ": " + why;
  throw InputError(place + ": nothing is " + wanted + (is_case ? " any more" : "") +
                   " in the answer of " + detector + why_not_judged);
}

}  // namespace

std::string where(const ReductionTask& task) { return task.scene + ", " + task.place; }

std::vector<Level> levels_for(const std::string& level_name, bool self) {
  const std::optional<Level> level = level_from_name(level_name);
  if (level && is_self(*level)) return {*level};
  std::vector<Level> levels = {Level::kBody};
  if (level != Level::kBody) levels.push_back(level.value_or(Level::kTriangle));
  if (!level && self) levels.push_back(Level::kSelf);
  return levels;
}

bool can_be_reduced(const std::string& level) {
  const std::optional<Level> known = level_from_name(level);
  return known != Level::kVertex && known != Level::kContainment && !(known && is_impact(*known));
}

void require_reducible(const std::string& level) {
  if (const std::optional<Level> known = level_from_name(level); known && is_impact(*known))
    throw InputError("a disagreement at level " + level +
                     " cannot be reduced: it is of a step between two frames, and reduce has one "
                     "frame; export --queries writes the step's elements");
  if (!can_be_reduced(level))
    throw InputError("a disagreement at level " + level +
                     " cannot be reduced: inside is defined for closed surfaces, and a part of "
                     "one is open");
}

double gap_of(const CaseCandidate& candidate, const ProbeVerdict& verdict, const Finding& finding) {
  if (finding.kind != "spurious") return 0.0;
  const ElementPair& pair = disagreement_of(verdict, finding).pair;
  if (pair.body_a == pair.body_b) return 0.0;
  if (finding.level == name_of(Level::kBody))
    return relative_gap(candidate.meshes[pair.body_a], candidate.meshes[pair.body_b]);
  if (finding.level != name_of(Level::kTriangle)) return 0.0;
  const auto alone = [&](std::uint32_t mesh, std::uint32_t triangle) {
    TriangleMesh out = candidate.meshes[mesh];
    out.triangles = {out.triangles[triangle]};
    drop_unused_vertices(out);
    return out;
  };
  return relative_gap(alone(pair.body_a, pair.a), alone(pair.body_b, pair.b));
}

Defect find_defect(Probe& probe, const std::string& detector, bool is_case,
                   const std::vector<ReductionTask>& tasks) {
  std::optional<Defect> found;
  ProbeVerdict verdict;  // the last one
  for (const ReductionTask& task : tasks) {
    if (task.snapshot.bodies.size() < 2 && !task.self) continue;
    verdict = probe.ask(task.snapshot, levels_of(task));
    std::optional<Finding> finding = finding_of(verdict, task.level, task.kind);
    // Others than the two that a case names may have contributed.
    const bool needs_others =
        !finding && task.frame_of_case.bodies.size() > task.snapshot.bodies.size();
    if (needs_others) {
      verdict = probe.ask(task.frame_of_case, levels_of(task));
      finding = finding_of(verdict, task.level, task.kind);
      // A case is the first of its kind; another one in its frame is not what it is about.
      if (finding && !is_about(verdict, *finding, task.named)) finding.reset();
    }
    if (!finding) continue;
    found = Defect{task, *finding};
    if (needs_others) found->task.snapshot = task.frame_of_case;
    break;
  }
  if (!found) refuse_without_finding(tasks, detector, is_case, verdict);

  ReductionTask& task = found->task;
  Finding& finding = found->finding;
  require_reducible(finding.level);
  const Snapshot whole = task.snapshot;
  const std::size_t count = whole.bodies.size();
  const auto shows_with = [&](const std::set<std::size_t>& bodies) {
    if (bodies.size() < 2 && !task.self) return false;
    return shows(probe.ask(only(whole, bodies), levels_for(finding.level, task.self)), finding);
  };
  const bool has_two = is_case && count <= 2;
  if (finding.kind == "error" && !has_two) {
    task.snapshot = only(whole, bodies_of_error(count, task.self, shows_with));
    return *found;
  }
  if (!has_two) {
    std::array<std::size_t, 2> pair = task.named;
    if (!is_case) {
      const judge::Disagreement& shown = disagreement_of(verdict, finding);
      pair = {std::min(shown.pair.body_a, shown.pair.body_b),
              std::max(shown.pair.body_a, shown.pair.body_b)};
      task.pair = triangles_of(shown, whole);
      task.cells = cells_of(shown);
    }
    const std::set<std::size_t> bodies = fewest_bodies(count, {pair[0], pair[1]}, shows_with);
    task.snapshot = only(whole, bodies);
    for (const std::size_t side : {0, 1})
      task.sides[side] =
          static_cast<std::size_t>(std::distance(bodies.begin(), bodies.find(pair[side])));
    if (bodies.size() > 2) task.cells.reset();  // two cells are two bodies
  }
  if (judge::elements_of(finding.level, finding.kind).first == Element::kTriangle && task.pair) {
    CaseCandidate candidate = candidate_of(task.snapshot);
    candidate.sides = task.sides;
    const auto piece = [&](std::size_t side) {
      return Piece{static_cast<std::uint32_t>(candidate.mesh_of(side)), (*task.pair)[side]};
    };
    finding.general = in_general_position(candidate, piece(0), piece(1));
  }
  return *found;
}

}  // namespace contactcheck::reduce
