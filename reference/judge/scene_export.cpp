#include "reference/judge/scene_export.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "check_script.h"
#include "core/deform/atomic_file.h"
#include "core/deform/byte_stream.h"
#include "core/types/check.h"
#include "core/types/mesh.h"
#include "reference/judge/judged_scene.h"
#include "reference/oracle/frame_certificate.h"
#include "reference/oracle/oracle.h"
#include "reference/results/results.h"
#include "reference/text/file_text.h"

namespace contactcheck::judge {
namespace {

// A surface as PLY, in doubles: the bits of the vertices that were judged.

// A binary little-endian PLY file: x, y, z as doubles in metres, faces as lists of three ints.
// `comment`, one line, says what it is.
std::string ply_bytes(std::span<const Vec3> vertices, const std::vector<Triangle>& triangles,
                      const std::string& comment) {
  ByteWriter out;
  out.raw("ply\nformat binary_little_endian 1.0\ncomment " + comment + "\nelement vertex " +
          std::to_string(vertices.size()) +
          "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
          std::to_string(triangles.size()) +
          "\nproperty list uchar int vertex_indices\nend_header\n");
  for (const Vec3& v : vertices)
    for (int axis = 0; axis < 3; ++axis) out.f64(v[axis]);
  for (const Triangle& t : triangles) {
    out.raw("\3");
    for (std::uint32_t corner : t) out.u32(corner);
  }
  return out.bytes();
}

// The certificate of a frame as JSON: truth/frame_NNNN.json of an export.

std::string pair_text(const BodyPair& pair) { return fmt::format("[{},{}]", pair.a, pair.b); }

std::string triangles_text(const ElementPair& t) {
  return fmt::format("{},{},{},{}", t.body_a, t.body_b, t.a, t.b);
}

std::string weights_text(const std::array<std::string, 3>& w) {
  return fmt::format(R"(["{}","{}","{}"])", w[0], w[1], w[2]);
}

// fmt writes the shortest decimal that reads back as the same double.
std::string number_text(const oracle::certify::ExactNumber& number) {
  if (const auto* value = std::get_if<double>(&number)) return fmt::format("{}", *value);
  return '"' + std::get<std::string>(number) + '"';
}

std::string contact_text(const oracle::certify::CertifiedContact& contact) {
  return fmt::format("[{},{},{}]", triangles_text(contact.triangles),
                     weights_text(contact.witness.p), weights_text(contact.witness.q));
}

std::string gap_text(const oracle::certify::CertifiedGap& gap) {
  const auto& n = gap.plane.normal;
  return fmt::format("[{},[{},{},{},{}]]", triangles_text(gap.triangles), number_text(n[0]),
                     number_text(n[1]), number_text(n[2]), number_text(gap.plane.offset));
}

// One item a line.
template <typename Items, typename Text>
std::string list_text(const Items& items, const Text& text) {
  std::string out = "[";
  for (const auto& item : items) out += (out.size() > 1 ? ",\n  " : "\n  ") + text(item);
  return out + (items.empty() ? "]" : "\n ]");
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

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char *kSchema = "contactcheck-certificates/1", *kIndex = "scene.json";

// Names of bodies may contain anything; the number distinguishes those that end up alike.
std::string folder_of_body(std::size_t index, const std::string& name) {
  constexpr std::size_t kLongest = 60;
  std::string out = "bodies/" + std::to_string(index) + "-";
  for (char c : name.substr(0, kLongest)) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                       c == '-' || c == '_';
    out += plain ? c : '_';
  }
  return out;
}

std::string frame_name(std::size_t frame) {
  const std::string digits = std::to_string(frame);
  return "frame_" + std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits;
}

std::string crc32_of(const std::string& bytes) {
  const auto* data = reinterpret_cast<const Bytef*>(bytes.data());
  char text[9];
  std::snprintf(text, sizeof text, "%08lx", crc32_z(crc32_z(0, nullptr, 0), data, bytes.size()));
  return text;
}

void require_finite(const scene::Scene& scene, std::size_t frame, std::size_t body,
                    const char* kind, const std::vector<Vec3>& points) {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].allFinite())
      throw InputError("scene " + text::in_quotes(scene.id) + ", frame " + std::to_string(frame) +
                       ", body " + text::in_quotes(scene.bodies[body].name) + ": " + kind + " " +
                       std::to_string(i) + " is not finite");
}

}  // namespace

ExportSummary export_scene(const scene::Scene& scene, std::size_t every, const fs::path& folder,
                           const std::function<void()>& before_frame) {
  CONTACTCHECK_INVARIANT(every > 0, "every frame, every second, ...");
  oracle::Oracle oracle(scene.bodies);
  oracle::certify::Certifier certifier(scene.bodies);
  Json bodies = Json::array(), frames = Json::array(), checksums = Json::object();
  ExportSummary summary;
  const auto make_folder = [&](const std::string& name) {
    std::error_code error;
    fs::create_directories(folder / name, error);
    if (error)
      throw InputError("cannot create " + text::in_quotes((folder / name).string()) + ": " +
                       error.message());
  };
  const auto write = [&](const std::string& name, const std::string& bytes) {
    write_file_atomically(folder / name, bytes);
    checksums[name] = crc32_of(bytes);
  };

  const bool own = any_self(scene.levels);
  oracle::WantedTruth wanted;
  wanted.self = own;

  make_folder("truth");
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body& body = scene.bodies[b];
    const std::string body_folder = folder_of_body(b, body.name);
    make_folder(body_folder);
    bodies.push_back({{"name", body.name},
                      {"folder", body_folder},
                      {"vertices", body.shape->given_vertex_count()},
                      {"triangles", body.shape->mesh.triangles.size()},
                      {"welded", !body.shape->welded.empty()}});
    if (!body.shape->welded.empty())
      write(body_folder + "/welded.json",
            Json(body.shape->given.numbered(body.shape->welded)).dump() + "\n");
    write(body_folder + "/order.json", Json(certifier.order(b)).dump() + "\n");
  }
  write_check_script(folder);

  for (std::size_t f = 0; f < scene.frames; f += every) {
    before_frame();
    const std::vector<std::vector<Vec3>> nodes = scene.nodes_of_frame(f);
    std::vector<std::vector<Vec3>> vertices;
    for (std::size_t b = 0; b < nodes.size(); ++b) {
      const BodyShape& shape = *scene.bodies[b].shape;
      vertices.emplace_back(shape.mesh.vertices.size());
      require_finite(scene, f, b, "node", nodes[b]);
      map_body(shape, nodes[b], vertices.back());
      require_finite(scene, f, b, "vertex", vertices.back());
    }
    const Frame frame = make_frame(f, scene.time_of(f), nodes, vertices);
    const ContactSet truth = oracle.judge(frame, wanted).surface;
    const oracle::certify::FrameCertificate certificate =
        certifier.certify(frame, truth.triangles, own ? &truth.self : nullptr);
    for (std::size_t b = 0; b < vertices.size(); ++b) {
      const BodyShape& shape = *scene.bodies[b].shape;
      write(bodies[b].at("folder").get<std::string>() + "/" + frame_name(f) + ".ply",
            ply_bytes(shape.given.spread(vertices[b]), shape.given.numbered(shape.mesh.triangles),
                      "contactcheck export: vertices in metres"));
    }
    write("truth/" + frame_name(f) + ".json", frame_text(f, truth.bodies, certificate));

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

  const Json index = {{"schema", kSchema},
                      {"version", CONTACTCHECK_VERSION},
                      {"scene", scene.id},
                      {"title", scene.title},
                      {"scene_frames", scene.frames},
                      {"every", every},
                      {"self", own},
                      {"contact_hash", results::hex(summary.contact_hash)},
                      {"bodies", bodies},
                      {"frames", frames},
                      {"crc32", checksums}};
  write_file_atomically(folder / kIndex, index.dump(1) + "\n");
  return summary;
}

void write_check_script(const fs::path& folder) {
  write_file_atomically(folder / "check.py", kCheckScript);
}

bool is_export(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_regular_file(folder / kIndex, ignored)) return false;
  const Json index = Json::parse(text::read_file_bytes(folder / kIndex, "export"), nullptr, false);
  return index.is_object() && index.value("schema", Json()) == kSchema;
}

}  // namespace contactcheck::judge
