#include "reference/timing/timing.h"

#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "reference/process/float_environment.h"
#include "reference/timing/cpu_time.h"

namespace contactcheck::timing {
namespace {

struct MappedFrame {
  std::vector<std::vector<Vec3>> nodes, vertices;
  Frame frame;
  std::optional<std::size_t> mapped;  ///< the frame that `vertices` are of
};

// A detector's input: a frame, or the step that begins there.
class Input {
 public:
  Input(const scene::Scene& scene, bool step, bool vertices)
      : scene_(scene), step_(step), vertices_(vertices) {
    for (MappedFrame* end : {&start_, &end_})
      for (const Body& body : scene.bodies)
        end->vertices.emplace_back(body.shape->mesh.vertices.size(), Vec3::Zero());
  }

  // What a step ends with is what the next one starts with, and is mapped once.
  void point_to(std::size_t index) {
    if (!step_) {
      point_to_frame(index, start_);
      return;
    }
    if (end_.mapped == index) {
      std::swap(start_, end_);
      point_to_vertices(start_);
    } else {
      point_to_frame(index, start_);
    }
    point_to_frame(index + 1, end_);
    joined_ = {start_.frame, end_.frame, given_end_ == index};
  }

  void map() {
    for (MappedFrame* end : {&start_, &end_}) {
      if ((end == &end_ && !step_) || end->mapped == end->frame.index) continue;
      for (std::size_t b = 0; b < scene_.bodies.size(); ++b)
        map_body(*scene_.bodies[b].shape, end->frame.bodies[b].nodes, end->vertices[b]);
      if (step_) end->mapped = end->frame.index;
    }
  }

  void give(Detector& detector) {
    if (step_) {
      detector.update_step(joined_);
      given_end_ = joined_.end.index;
    } else {
      detector.update(start_.frame);
    }
  }

 private:
  void point_to_frame(std::size_t index, MappedFrame& mapped) const {
    mapped.mapped.reset();
    mapped.frame.index = index;
    mapped.frame.time = scene_.time_of(index);
    mapped.nodes = scene_.nodes_of_frame(index);  // nothing is mapped outside the clock
    point_to_vertices(mapped);
  }

  void point_to_vertices(MappedFrame& mapped) const {
    mapped.frame.bodies.clear();
    for (std::size_t b = 0; b < scene_.bodies.size(); ++b)
      mapped.frame.bodies.push_back(
          {mapped.nodes[b], vertices_ ? mapped.vertices[b] : std::span<const Vec3>()});
  }

  const scene::Scene& scene_;
  const bool step_, vertices_;  // one that needs no vertices gets none
  MappedFrame start_, end_;
  Step joined_;
  std::optional<std::size_t> given_end_;  // of the last step that the detector was given
};

// The phase is marked outside of what the clock takes, which the mark must not lengthen.
PhaseSample time_frame(Question question, Detector& detector, Input& input, ContactSet& contacts,
                       process::ProgressWriter& progress) {
  PhaseSample sample;
  CallClock clock;
  if (detector.needs_vertices()) {
    clock.start();
    input.map();
    sample.map = clock.stop();
  }
  progress.go_on(process::Phase::kUpdate);
  clock.start();
  input.give(detector);
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
  Input input(scene, is_of_steps(request.asked.question), detector.needs_vertices());
  ContactSet contacts;
  Pass out;
  CpuBook cpu(request.threads, request.children);
  const process::FloatEnvironmentGuard guard;
  detector.pause();  // what it began while it was prepared goes on within a call
  for (const std::size_t index : request.frames) {
    input.point_to(index);
    progress.enter(request.position, index, process::Phase::kMap);
    contacts.clear();
    if (request.sweep != nullptr) request.sweep->run();
    cpu.before_call();
    detector.resume();
    PhaseSample& sample =
        out.emplace_back(time_frame(request.asked.question, detector, input, contacts, progress));
    detector.pause();
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
