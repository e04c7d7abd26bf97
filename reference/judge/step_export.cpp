#include "reference/judge/step_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>

#include "core/types/check.h"
#include "core/types/shared_corners.h"
#include "reference/judge/export_folder.h"
#include "reference/judge/judged_scene.h"
#include "reference/oracle/certificate_text.h"
#include "reference/oracle/oracle.h"
#include "reference/oracle/step_certificate.h"
#include "reference/oracle/step_truth.h"
#include "reference/scene/frame_positions.h"
#include "reference/text/file_text.h"

namespace contactcheck::judge {
namespace {

namespace certify = oracle::certify;
using Json = nlohmann::ordered_json;

// One pair of bodies a line, in truth/step_NNNN.json of an export.

template <typename Items, typename Text>
std::string row_text(const Items& items, const Text& text) {
  std::string out;
  for (const auto& item : items) out += (out.empty() ? "" : ",") + text(item);
  return '[' + out + ']';
}

std::string apart_text(const certify::ApartCertificate& proof) {
  const auto direction = [](const certify::StepDirection& n) {
    return fmt::format("[{},{},{}]", n[0], n[1], n[2]);
  };
  const auto triangles = [](const certify::ApartByElements& of) {
    return '[' + certify::plane_text(of.at_start) + ',' +
           row_text(of.elements, certify::impact_text) + ']';
  };
  return fmt::format(R"("decisions":"{}","directions":{},"triangles":{},"elements":{})",
                     proof.decisions, row_text(proof.directions, direction),
                     row_text(proof.triangles, triangles),
                     row_text(proof.elements, certify::impact_text));
}

std::string contact_text(const scene::Scene& scene, const certify::ContactProof& proof) {
  if (const auto* touch = std::get_if<certify::TouchAtStart>(&proof))
    return fmt::format(R"("touch":[{},{},{}])", touch->triangles.a, touch->triangles.b,
                       certify::witness_text(touch->witness));
  const auto& meet = std::get<certify::ElementsMeet>(proof);
  const auto number = [&](std::size_t element, std::size_t point) {
    return scene.bodies[meet.bodies[element]].shape->given.number_of(meet.vertices[point]);
  };
  const std::string elements =
      meet.kind == ImpactKind::vertex_triangle
          ? fmt::format("[{},{}],[{},{}]", meet.bodies[0], number(0, 0), meet.bodies[1],
                        meet.triangle)
          : fmt::format("[{},{},{}],[{},{},{}]", meet.bodies[0], number(0, 0), number(0, 1),
                        meet.bodies[1], number(1, 2), number(1, 3));
  return fmt::format(R"("meet":["{}",{},{}])", name_of(meet.kind), elements,
                     certify::impact_text(meet.proof));
}

/// What meets in one step, by the oracle.
struct FoundInStep {
  std::vector<ElementPair> at_start;  ///< pairs of triangles, of one body without a common vertex
  oracle::StepTruth truth;

  bool meet(BodyPair bodies) const {
    const ContactSet& found = truth.contacts;
    const auto is_own = [&](const auto& x) { return x.body == bodies.a; };
    return std::ranges::any_of(at_start,
                               [&](const ElementPair& x) {
                                 return BodyPair{x.body_a, x.body_b} == bodies;
                               }) ||
           std::ranges::any_of(truth.first,
                               [&](const auto& first) { return first.bodies == bodies; }) ||
           (bodies.a == bodies.b && (std::ranges::any_of(found.self_impact_vertices, is_own) ||
                                     std::ranges::any_of(found.self_impact_edges, is_own)));
  }
};

/// Pairs of bodies by what was proven of them.
struct Counts {
  std::size_t apart = 0, contacts = 0, unproved = 0;
};

class StepExporter {
 public:
  StepExporter(const scene::Scene& scene, bool own)
      : scene_(scene),
        own_(own),
        oracle_(scene.bodies),
        steps_(scene.bodies),
        certifier_(scene.bodies) {}

  std::vector<std::vector<std::uint32_t>> orders() const {
    std::vector<std::vector<std::uint32_t>> out;
    for (std::size_t b = 0; b < scene_.bodies.size(); ++b) out.push_back(certifier_.order(b));
    return out;
  }

  /// The text of a step's file.
  std::string prove(const Step& step, StepExportSummary& summary, Counts& counts) {
    const FoundInStep found = find(step);
    certifier_.begin(step);
    const auto prove = [&](BodyPair bodies) {
      const std::string proof = found.meet(bodies)
                                    ? prove_contact(step, bodies, found, summary, counts)
                                    : prove_apart(bodies, counts);
      return fmt::format(R"({{"bodies":[{},{}],{}}})", bodies.a, bodies.b, proof);
    };
    return fmt::format("{{\"step\": {},\n \"pairs\": {}}}\n", step.index(),
                       list_text(pairs(), prove));
  }

 private:
  FoundInStep find(const Step& step) {
    oracle::WantedTruth wanted;
    wanted.self = own_;
    const ContactSet start = oracle_.judge(step.start, wanted).surface;
    FoundInStep found{start.triangles, steps_.judge(step, start.triangles, {true, own_})};
    for (const SelfPair& pair : start.self) {
      const std::vector<Triangle>& linked = scene_.bodies[pair.body].shape->linked();
      if (shared_corners(linked[pair.a], linked[pair.b]).count == 0)
        found.at_start.push_back({pair.body, pair.body, pair.a, pair.b});
    }
    return found;
  }

  std::vector<BodyPair> pairs() const {
    const auto count = static_cast<std::uint32_t>(scene_.bodies.size());
    std::vector<BodyPair> out;
    for (std::uint32_t a = 0; a < count; ++a)
      for (std::uint32_t b = a + 1; b < count; ++b) out.push_back({a, b});
    for (std::uint32_t a = 0; own_ && a < count; ++a) out.push_back({a, a});
    return out;
  }

  std::string prove_apart(BodyPair bodies, Counts& counts) const {
    const auto proof = certifier_.prove_apart(bodies);
    ++(proof ? counts.apart : counts.unproved);
    return proof ? apart_text(*proof) : R"("unproved":"apart")";
  }

  std::string prove_contact(const Step& step, BodyPair bodies, const FoundInStep& found,
                            StepExportSummary& summary, Counts& counts) const {
    const auto proof = certifier_.prove_contact(bodies, found.at_start, found.truth.contacts);
    ++(proof ? counts.contacts : counts.unproved);
    if (!proof) return R"("unproved":"contact")";
    const auto* meet = std::get_if<certify::ElementsMeet>(&*proof);
    summary.contacts.push_back({step.index(), bodies, meet == nullptr ? 0.0 : meet->time.earliest});
    return contact_text(scene_, *proof);
  }

  const scene::Scene& scene_;
  bool own_;
  oracle::Oracle oracle_;
  oracle::StepOracle steps_;
  certify::StepCertifier certifier_;
};

}  // namespace

void require_steps(const scene::Scene& scene) {
  const std::string looks = "--between looks from frame to frame, and ",
                    name = "scene " + text::in_quotes(scene.id);
  if (!scene.follows_time()) throw InputError(looks + "those of " + name + " are separate cases");
  if (scene.frames < 2) throw InputError(looks + name + " has one frame");
}

StepExportSummary export_steps(const scene::Scene& scene, const std::filesystem::path& folder,
                               const std::function<void()>& before_step) {
  const bool own = any_self(scene.levels) || std::ranges::any_of(scene.levels, is_self_impact);
  StepExporter exporter(scene, own);
  ExportFolder out(scene, exporter.orders(), folder);
  const scene::FramePositions positions(scene);
  const auto frame = [&](std::size_t f) {
    const scene::FramePosition& position = positions[f];
    return make_frame(f, scene.time_of(f), position.nodes, position.vertices);
  };
  const auto write_surfaces = [&](std::size_t f) {
    scene::require_judgeable(scene, f, positions[f]);
    out.write_surfaces(f, positions[f]);
  };
  StepExportSummary summary;
  Json steps = Json::array();
  write_surfaces(0);
  for (std::size_t k = 0; k + 1 < scene.frames; ++k) {
    before_step();
    write_surfaces(k + 1);
    Counts counts;
    out.write_truth("step", k, exporter.prove({frame(k), frame(k + 1)}, summary, counts));
    steps.push_back({{"step", k},
                     {"apart", counts.apart},
                     {"contacts", counts.contacts},
                     {"unproved", counts.unproved}});
    summary.steps += 1;
    summary.apart += counts.apart;
    summary.unproved += counts.unproved;
  }
  out.write_index(kStepsIndex, {{"schema", kStepsIndex.schema},
                                {"version", CONTACTCHECK_VERSION},
                                {"scene", scene.id},
                                {"title", scene.title},
                                {"frames", scene.frames},
                                {"paths", "straight from frame to frame"},
                                {"self", own},
                                {"bodies", out.bodies()},
                                {"steps", steps}});
  return summary;
}

}  // namespace contactcheck::judge
