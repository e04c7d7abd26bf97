#include "reference/run/timing.h"

#include <chrono>
#include <stdexcept>

#include "reference/run/cpu_time.h"
#include "reference/run/float_environment.h"

namespace contactcheck {
namespace {

using Clock = std::chrono::steady_clock;

double nanoseconds(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double, std::nano>(to - from).count();
}

struct MappedFrame {
  std::vector<std::vector<Vec3>> nodes, vertices;
  Frame frame;
};

void point_to_frame(const JudgedScene& judged, std::size_t index, MappedFrame& mapped) {
  mapped.frame.index = index;
  mapped.frame.time = judged.scene->time_of(index);
  mapped.nodes = judged.scene->nodes_of_frame(index);  // nothing is mapped outside the clock
  mapped.frame.bodies.clear();
  for (std::size_t b = 0; b < judged.scene->bodies.size(); ++b)
    mapped.frame.bodies.push_back({mapped.nodes[b], mapped.vertices[b]});
}

// The phase is marked outside of what the clock takes, which the mark must not lengthen.
PhaseSample time_frame(const Scene& scene, Question question, Detector& detector,
                       MappedFrame& mapped, ContactSet& contacts, ProgressWriter& progress) {
  PhaseSample sample;
  const bool needs_vertices = detector.needs_vertices();
  const auto before_map = Clock::now();
  if (needs_vertices) {
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
      map_body(*scene.bodies[b].shape, mapped.frame.bodies[b].nodes, mapped.vertices[b]);
  }
  const auto after_map = Clock::now();
  progress.go_on(Phase::kUpdate);
  const auto before_update = Clock::now();
  detector.update(mapped.frame);
  const auto after_update = Clock::now();
  const std::optional<double> update_reported = detector.reported_ns();
  progress.go_on(Phase::kQuery);
  const auto before_query = Clock::now();
  detector.query(question, contacts);
  const auto after_query = Clock::now();
  sample.map = needs_vertices ? nanoseconds(before_map, after_map) : 0.0;
  sample.update = nanoseconds(before_update, after_update);
  sample.query = nanoseconds(before_query, after_query);
  const std::optional<double> query_reported = detector.reported_ns();
  if (update_reported && query_reported) sample.reported = *update_reported + *query_reported;
  return sample;
}

}  // namespace

Pass time_pass(const JudgedScene& judged, const PassRequest& request, Detector& detector,
               ProgressWriter& progress) {
  const Scene& scene = *judged.scene;
  MappedFrame mapped;
  for (const Body& body : scene.bodies)
    mapped.vertices.emplace_back(body.shape->mesh.vertices.size(), Vec3::Zero());
  ContactSet contacts;
  Pass out;
  CpuBook cpu(request.threads, request.children);
  const FloatEnvironmentGuard guard;
  for (const std::size_t index : request.frames) {
    point_to_frame(judged, index, mapped);
    progress.enter(request.position, index, Phase::kMap);
    contacts.clear();
    if (request.sweep != nullptr) request.sweep->run();
    cpu.before_call();
    PhaseSample& sample = out.emplace_back(
        time_frame(scene, request.asked.question, detector, mapped, contacts, progress));
    sample.cpu = cpu.after_call(sample.total());
    guard.check_and_restore();  // flush-to-zero would make the next one faster
    contacts.canonicalize();
    const std::string difference =
        answer_difference(print_of(contacts, request.asked), request.judged->at(index));
    if (!difference.empty()) throw std::runtime_error(difference);
  }
  cpu.settle([&] { progress.go_on(Phase::kQuery); });
  if (const std::string complaint = cpu.complaint(); !complaint.empty())
    throw std::runtime_error(complaint);
  return out;
}

}  // namespace contactcheck
