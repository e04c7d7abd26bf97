#include "reference/judge/scene_export.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/types/check.h"
#include "reference/judge/export_folder.h"
#include "reference/judge/judged_scene.h"
#include "reference/oracle/certificate_text.h"
#include "reference/oracle/frame_certificate.h"
#include "reference/oracle/oracle.h"
#include "reference/results/results.h"
#include "reference/scene/frame_positions.h"

namespace contactcheck::judge {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// The certificate of a frame as JSON: truth/frame_NNNN.json of an export.

std::string pair_text(const BodyPair& pair) { return fmt::format("[{},{}]", pair.a, pair.b); }

std::string triangles_text(const ElementPair& t) {
  return fmt::format("{},{},{},{}", t.body_a, t.body_b, t.a, t.b);
}

std::string contact_text(const oracle::certify::CertifiedContact& contact) {
  return fmt::format("[{},{}]", triangles_text(contact.triangles),
                     oracle::certify::witness_text(contact.witness));
}

std::string gap_text(const oracle::certify::CertifiedGap& gap) {
  return fmt::format("[{},{}]", triangles_text(gap.triangles),
                     oracle::certify::plane_text(gap.plane));
}

// One contact or gap a line. `bodies`: the pairs of bodies in contact, canonical.
std::string frame_text(std::size_t frame, const std::vector<BodyPair>& bodies,
                       const oracle::certify::FrameCertificate& certificate) {
  return fmt::format(
      "{{\"frame\": {},\n \"body_pairs\": {},\n \"contacts\": {},\n \"gaps\": {},\n"
      " \"decisions\": \"{}\"}}\n",
      frame, list_text(bodies, pair_text), list_text(certificate.contacts, contact_text),
      list_text(certificate.gaps, gap_text), certificate.decisions);
}

}  // namespace

ExportSummary export_scene(const scene::Scene& scene, std::size_t every, const fs::path& folder,
                           const std::function<void()>& before_frame) {
  CONTACTCHECK_INVARIANT(every > 0, "every frame, every second, ...");
  oracle::Oracle oracle(scene.bodies);
  oracle::certify::Certifier certifier(scene.bodies);
  std::vector<std::vector<std::uint32_t>> orders;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) orders.push_back(certifier.order(b));
  ExportFolder out(scene, orders, folder);
  const scene::FramePositions positions(scene);
  Json frames = Json::array();
  ExportSummary summary;

  const bool own = any_self(scene.levels);
  oracle::WantedTruth wanted;
  wanted.self = own;

  for (std::size_t f = 0; f < scene.frames; f += every) {
    before_frame();
    const scene::FramePosition& position = positions[f];
    scene::require_judgeable(scene, f, position);
    const Frame frame = make_frame(f, scene.time_of(f), position.nodes, position.vertices);
    const ContactSet truth = oracle.judge(frame, wanted).surface;
    const oracle::certify::FrameCertificate certificate =
        certifier.certify(frame, truth.triangles, own ? &truth.self : nullptr);
    out.write_surfaces(f, position);
    out.write_truth("frame", f, frame_text(f, truth.bodies, certificate));

    summary.frames += 1;
    summary.contacts += certificate.contacts.size();
    summary.gaps += certificate.gaps.size();
    summary.contact_hash = chain_hash(summary.contact_hash, f, truth);
    Json entry = {{"frame", f}, {"time", scene.time_of(f)}};
    if (scene.family()) entry["case"] = scene.family()->values[f];
    entry["body_pairs"] = truth.bodies.size();
    entry["contacts"] = certificate.contacts.size();
    entry["gaps"] = certificate.gaps.size();
    frames.push_back(std::move(entry));
  }

  out.write_index(kFramesIndex, {{"schema", kFramesIndex.schema},
                                 {"version", CONTACTCHECK_VERSION},
                                 {"scene", scene.id},
                                 {"title", scene.title},
                                 {"scene_frames", scene.frames},
                                 {"every", every},
                                 {"self", own},
                                 {"contact_hash", results::hex(summary.contact_hash)},
                                 {"bodies", out.bodies()},
                                 {"frames", frames}});
  return summary;
}

}  // namespace contactcheck::judge
