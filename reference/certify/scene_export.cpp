#include "reference/certify/scene_export.h"

#include <zlib.h>

#include <nlohmann/json.hpp>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "reference/certify/check_script.h"
#include "reference/certify/frame_certificate.h"
#include "reference/certify/frame_text.h"
#include "reference/certify/ply.h"
#include "reference/oracle/oracle.h"
#include "reference/results/results.h"
#include "reference/scene/file_text.h"

namespace contactcheck::certify {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char *kSchema = "contactcheck-certificates/1", *kIndex = "scene.json";

// Names of bodies may hold anything; the number keeps those apart that end up alike.
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

class Exporter {
 public:
  Exporter(const Scene& scene, fs::path folder)
      : scene_(scene), folder_(std::move(folder)), oracle_(scene.bodies), certifier_(scene.bodies) {
    make_folder("truth");
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) add_body(b);
    write_file_atomically(folder_ / "check.py", kCheckScript);
  }

  void add_frame(std::size_t index) {
    const auto nodes = scene_.nodes_of_frame(index);
    const auto vertices = map_bodies(index, nodes);
    Frame frame{index, scene_.time_of(index), {}};
    for (std::size_t b = 0; b < nodes.size(); ++b) frame.bodies.push_back({nodes[b], vertices[b]});
    const ContactSet truth = oracle_.judge(frame, {}).surface;
    const FrameCertificate certificate = certifier_.certify(frame, truth.triangles);
    write_surfaces(index, vertices);
    write("truth/" + frame_name(index) + ".json", frame_text(index, truth.bodies, certificate));
    list_frame(index, truth, certificate);
  }

  ExportSummary finish(std::size_t every) {
    const Json index = {{"schema", kSchema},
                        {"version", CONTACTCHECK_VERSION},
                        {"scene", scene_.id},
                        {"title", scene_.title},
                        {"scene_frames", scene_.frames},
                        {"every", every},
                        {"contact_hash", results::hex(summary_.contact_hash)},
                        {"bodies", bodies_},
                        {"frames", frames_},
                        {"crc32", checksums_}};
    write_file_atomically(folder_ / kIndex, index.dump(1) + "\n");
    return summary_;
  }

 private:
  void add_body(std::size_t b) {
    const Body& body = scene_.bodies[b];
    const std::string folder = folder_of_body(b, body.name);
    make_folder(folder);
    bodies_.push_back({{"name", body.name},
                       {"folder", folder},
                       {"vertices", body.shape->mesh.vertices.size()},
                       {"triangles", body.shape->mesh.triangles.size()}});
    write(folder + "/order.json", Json(certifier_.order(b)).dump() + "\n");
  }

  std::vector<std::vector<Vec3>> map_bodies(std::size_t frame,
                                            const std::vector<std::vector<Vec3>>& nodes) const {
    std::vector<std::vector<Vec3>> out;
    for (std::size_t b = 0; b < nodes.size(); ++b) {
      const BodyShape& shape = *scene_.bodies[b].shape;
      out.emplace_back(shape.mesh.vertices.size());
      require_finite(frame, b, "node", nodes[b]);
      map_body(shape, nodes[b], out.back());
      require_finite(frame, b, "vertex", out.back());
    }
    return out;
  }

  void require_finite(std::size_t frame, std::size_t body, const char* kind,
                      const std::vector<Vec3>& points) const {
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!points[i].allFinite())
        throw InputError("scene " + in_quotes(scene_.id) + ", frame " + std::to_string(frame) +
                         ", body " + in_quotes(scene_.bodies[body].name) + ": " + kind + " " +
                         std::to_string(i) + " is not finite");
  }

  void write_surfaces(std::size_t frame, const std::vector<std::vector<Vec3>>& vertices) {
    for (std::size_t b = 0; b < vertices.size(); ++b)
      write(bodies_[b].at("folder").get<std::string>() + "/" + frame_name(frame) + ".ply",
            ply_bytes(vertices[b], scene_.bodies[b].shape->mesh.triangles,
                      "contactcheck export: vertices in metres"));
  }

  void list_frame(std::size_t index, const ContactSet& truth, const FrameCertificate& certificate) {
    summary_.frames += 1;
    summary_.contacts += certificate.contacts.size();
    summary_.gaps += certificate.gaps.size();
    summary_.contact_hash = chain_hash(summary_.contact_hash, index, truth);
    Json entry = {{"frame", index}, {"time", scene_.time_of(index)}};
    if (scene_.family) entry["case"] = scene_.family->values[index];
    entry["body_pairs"] = truth.bodies.size();
    entry["contacts"] = certificate.contacts.size();
    entry["gaps"] = certificate.gaps.size();
    frames_.push_back(std::move(entry));
  }

  void write(const std::string& name, const std::string& bytes) {
    write_file_atomically(folder_ / name, bytes);
    checksums_[name] = crc32_of(bytes);
  }

  void make_folder(const std::string& name) const {
    std::error_code error;
    fs::create_directories(folder_ / name, error);
    if (error)
      throw InputError("cannot create " + in_quotes((folder_ / name).string()) + ": " +
                       error.message());
  }

  const Scene& scene_;
  const fs::path folder_;
  Oracle oracle_;
  Certifier certifier_;
  Json bodies_ = Json::array(), frames_ = Json::array(), checksums_ = Json::object();
  ExportSummary summary_;
};

}  // namespace

ExportSummary export_scene(const Scene& scene, std::size_t every, const fs::path& folder,
                           const std::function<void()>& before_frame) {
  CONTACTCHECK_INVARIANT(every > 0, "every frame, every second, ...");
  Exporter exporter(scene, folder);
  for (std::size_t f = 0; f < scene.frames; f += every) {
    before_frame();
    exporter.add_frame(f);
  }
  return exporter.finish(every);
}

bool is_export(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_regular_file(folder / kIndex, ignored)) return false;
  const Json index = Json::parse(read_file_bytes(folder / kIndex, "export"), nullptr, false);
  return index.is_object() && index.value("schema", Json()) == kSchema;
}

}  // namespace contactcheck::certify
