#include "reference/run/timing.h"

#include <chrono>
#include <optional>
#include <stdexcept>

#include "reference/run/float_environment.h"
#include "reference/run/printable.h"

namespace contactcheck {
namespace {

using Clock = std::chrono::steady_clock;

double nanoseconds(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double, std::nano>(to - from).count();
}

// Buffers shared by all entries: every detector maps into the same memory.
struct MappedFrame {
  std::vector<std::vector<Vec3>> vertices;
  Frame frame;
};

// The phase is marked outside of what the clock takes, which the mark must not lengthen.
PhaseSample run_once(const JudgedScene& judged, TimedEntry& entry, MappedFrame& mapped,
                     ContactSet& contacts, ProgressWriter& progress) {
  const Scene& scene = *judged.scene;
  PhaseSample sample;
  const bool needs_vertices = entry.detector->needs_vertices();
  contacts.clear();
  if (needs_vertices) progress.go_on(Phase::kMap);
  const auto before_map = Clock::now();
  if (needs_vertices) {
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
      map_body(*scene.bodies[b].shape, mapped.frame.bodies[b].nodes, mapped.vertices[b]);
  }
  const auto after_map = Clock::now();
  progress.go_on(Phase::kUpdate);
  const auto before_update = Clock::now();
  entry.detector->update(mapped.frame);
  const auto after_update = Clock::now();
  const std::optional<double> update_reported = entry.detector->reported_ns();
  progress.go_on(Phase::kQuery);
  const auto before_query = Clock::now();
  entry.detector->query(entry.question, contacts);
  const auto after_query = Clock::now();
  sample.map = needs_vertices ? nanoseconds(before_map, after_map) : 0.0;
  sample.update = nanoseconds(before_update, after_update);
  sample.query = nanoseconds(before_query, after_query);
  const std::optional<double> query_reported = entry.detector->reported_ns();
  if (update_reported && query_reported) sample.reported = *update_reported + *query_reported;
  return sample;
}

// Both answers of a repeat. The hot one becomes canonical.
void check_answers(const TimedEntry& entry, std::size_t index, const AnswerSizes& cold,
                   ContactSet& hot) {
  if (entry.judged == nullptr) return;
  const AnswerPrint& judged = (*entry.judged)[index];
  const Asked asked = {entry.question, entry.own};
  std::string difference = raw_difference(cold, judged, asked);
  if (difference.empty()) {
    hot.canonicalize();
    difference = answer_difference(print_of(hot, asked), judged);
  }
  if (!difference.empty()) throw std::runtime_error(difference);
}

void run_cold_and_hot(const JudgedScene& judged, std::size_t index, TimedEntry& entry,
                      MappedFrame& mapped, ContactSet& contacts, ProgressWriter& progress) {
  try {
    FrameSamples& samples = entry.samples.frames[index];
    samples.cold.push_back(run_once(judged, entry, mapped, contacts, progress));
    const AnswerSizes cold_answer = sizes_of(contacts);
    samples.hot.push_back(run_once(judged, entry, mapped, contacts, progress));
    check_answers(entry, index, cold_answer, contacts);
  } catch (...) {
    entry.error = "frame " + std::to_string(index) + ", while timed: " + current_exception_text();
  }
}

void point_to_frame(const JudgedScene& judged, std::size_t index, MappedFrame& mapped) {
  mapped.frame.index = index;
  mapped.frame.time = judged.scene->time_of(index);
  mapped.frame.bodies.clear();
  for (std::size_t b = 0; b < judged.scene->bodies.size(); ++b)
    mapped.frame.bodies.push_back({judged.positions[index].nodes[b], mapped.vertices[b]});
}

}  // namespace

void CacheSweep::run() {
  for (std::size_t i = 0; i < buffer_.size(); i += 8) sum_ += buffer_[i]++;
  // The sum must be looked at, or the loop is nobody's business.
  volatile std::uint64_t sink = sum_;
  (void)sink;
}

void run_timing(const JudgedScene& judged, const std::vector<std::size_t>& order,
                std::size_t repeats, std::size_t sweep_bytes, std::vector<TimedEntry>& entries,
                ProgressWriter& progress) {
  CacheSweep sweep(sweep_bytes);
  MappedFrame mapped;
  for (const Body& body : judged.scene->bodies)
    mapped.vertices.emplace_back(body.shape->mesh.vertices.size(), Vec3::Zero());
  ContactSet contacts;
  const FloatEnvironmentGuard guard;
  for (std::size_t place = 0; place < order.size(); ++place) {
    const std::size_t index = order[place];
    point_to_frame(judged, index, mapped);
    progress.part(0.5 + 0.5 * static_cast<double>(place) / static_cast<double>(order.size()));
    for (std::size_t repeat = 0; repeat < repeats; ++repeat) {
      for (std::size_t i = 0; i < entries.size(); ++i) {
        TimedEntry& entry = entries[(i + repeat) % entries.size()];
        if (place >= entry.frames || !entry.error.empty()) continue;
        progress.enter(entry.position, index, Phase::kMap);
        sweep.run();
        run_cold_and_hot(judged, index, entry, mapped, contacts, progress);
        guard.check_and_restore();  // flush-to-zero would make the next one faster
      }
    }
  }
}

}  // namespace contactcheck
