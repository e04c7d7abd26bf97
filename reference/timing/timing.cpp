#include "reference/timing/timing.h"

#include <stdexcept>

#include "reference/process/float_environment.h"
#include "reference/timing/cpu_time.h"

namespace contactcheck::timing {
namespace {

struct MappedFrame {
  std::vector<std::vector<Vec3>> nodes, vertices;
  Frame frame;
};

void point_to_frame(const scene::Scene& scene, std::size_t index, MappedFrame& mapped) {
  mapped.frame.index = index;
  mapped.frame.time = scene.time_of(index);
  mapped.nodes = scene.nodes_of_frame(index);  // nothing is mapped outside the clock
  mapped.frame.bodies.clear();
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    mapped.frame.bodies.push_back({mapped.nodes[b], mapped.vertices[b]});
}

// The phase is marked outside of what the clock takes, which the mark must not lengthen.
PhaseSample time_frame(const scene::Scene& scene, Question question, Detector& detector,
                       MappedFrame& mapped, ContactSet& contacts,
                       process::ProgressWriter& progress) {
  PhaseSample sample;
  CallClock clock;
  if (detector.needs_vertices()) {
    clock.start();
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
      map_body(*scene.bodies[b].shape, mapped.frame.bodies[b].nodes, mapped.vertices[b]);
    sample.map = clock.stop();
  }
  progress.go_on(process::Phase::kUpdate);
  clock.start();
  detector.update(mapped.frame);
  sample.update = clock.stop();
  const std::optional<double> update_reported = detector.reported_ns();
  progress.go_on(process::Phase::kQuery);
  clock.start();
  detector.query(question, contacts);
  sample.query = clock.stop();
  sample.taken = clock.taken();
  const std::optional<double> query_reported = detector.reported_ns();
  if (update_reported && query_reported) sample.reported = *update_reported + *query_reported;
  return sample;
}

}  // namespace

Pass time_pass(const scene::Scene& scene, const PassRequest& request, Detector& detector,
               process::ProgressWriter& progress) {
  MappedFrame mapped;
  for (const Body& body : scene.bodies)
    mapped.vertices.emplace_back(body.shape->mesh.vertices.size(), Vec3::Zero());
  ContactSet contacts;
  Pass out;
  CpuBook cpu(request.threads, request.children);
  const process::FloatEnvironmentGuard guard;
  for (const std::size_t index : request.frames) {
    point_to_frame(scene, index, mapped);
    progress.enter(request.position, index, process::Phase::kMap);
    contacts.clear();
    if (request.sweep != nullptr) request.sweep->run();
    cpu.before_call();
    PhaseSample& sample = out.emplace_back(
        time_frame(scene, request.asked.question, detector, mapped, contacts, progress));
    sample.cpu = cpu.after_call();
    guard.check_and_restore();  // flush-to-zero would make the next one faster
    contacts.canonicalize();
    const std::string difference = judge::answer_difference(
        judge::fingerprint_of(contacts, request.asked), request.judged->at(index));
    if (!difference.empty()) throw std::runtime_error(difference);
  }
  cpu.settle([&] { progress.go_on(process::Phase::kQuery); });
  if (const std::string complaint = cpu.complaint(); !complaint.empty())
    throw std::runtime_error(complaint);
  return out;
}

}  // namespace contactcheck::timing
