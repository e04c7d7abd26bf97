#include "reference/view/view_bytes.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numeric>
#include <vector>

#include "core/types/check.h"
#include "reference/view/contacts_file.h"
#include "reference/view/scene_view.h"

namespace contactcheck {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::string_view kMagic = "CCVIEW1\n";
constexpr std::size_t kAlignment = 4;

// Of a recording's bytes at least a quarter comes into the view: nodes half, vertices more than a
// quarter (52 bytes become 14 or 16), triangles with their labels likewise (20 become 6 or 12).
constexpr std::size_t kLargestShrinking = 4;

struct Candidate {
  std::string scene;
  SceneView view;
  std::string why;  ///< why it is left out; empty: it is not
  std::size_t size() const {
    return view.header.dump(-1, ' ', false, Json::error_handler_t::replace).size() +
           view.arrays.size();
  }
};

std::string file_bytes(const fs::path& folder, const std::string& name) {
  std::error_code error;
  std::ifstream in;
  if (fs::is_regular_file(folder / name, error)) in.open(folder / name, std::ios::binary);
  if (!in.is_open()) throw InputError("\"" + name + "\" cannot be read.");
  std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  return bytes;
}

std::string too_large(std::size_t limit) {
  return "it does not fit into the report's " + std::to_string(limit / 1'000'000) +
         " MB for 3D scenes, the smallest of which come first.";
}

// "" where no run of the scene names one.
std::string recording_of(const Json& results, const Json& scene) {
  for (const Json& run : results.at("runs")) {
    if (run.at("scene") != scene.at("id")) continue;
    const auto name = run.value("recording", std::string());
    if (!name.empty()) return name;
  }
  return "";
}

SceneView read_scene(const fs::path& folder, const std::string& recording_name, const Json& scene) {
  const Recording recording =
      read_recording_bytes(file_bytes(folder, recording_name), recording_name);
  if (recording.scene != scene.at("id").get<std::string>())
    throw InputError("recording \"" + recording_name + "\": it is of the scene \"" +
                     recording.scene + "\".");
  if (!scene.contains("contacts")) return scene_view(recording, nullptr);
  const auto name = scene.at("contacts").get<std::string>();
  return scene_view(recording, read_contacts(file_bytes(folder, name), name, recording));
}

Candidate candidate(const fs::path& folder, const std::string& recording, const Json& scene,
                    std::size_t limit) {
  Candidate out{scene.at("id").get<std::string>(), {}, ""};
  std::error_code error;  // is told by the read
  const std::uintmax_t size = fs::file_size(folder / recording, error);
  if (!error && size / kLargestShrinking > limit) {
    out.why = too_large(limit);
    return out;
  }
  try {
    out.view = read_scene(folder, recording, scene);
  } catch (const InputError& e) {
    out.why = e.what();
  }
  return out;
}

// The smallest scenes first: they are the most for the room.
void leave_out_beyond(std::size_t limit, std::vector<Candidate>& scenes) {
  std::vector<std::size_t> sizes, order(scenes.size());
  for (const Candidate& scene : scenes) sizes.push_back(scene.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sizes[a] < sizes[b]; });
  std::size_t used = 0;
  for (std::size_t i : order) {
    if (!scenes[i].why.empty()) continue;
    if (used + sizes[i] > limit)
      scenes[i] = {scenes[i].scene, {}, too_large(limit)};
    else
      used += sizes[i];
  }
}

std::string container(std::vector<Candidate>& scenes) {
  Json header = {
      {"schema", "contactcheck-view/1"}, {"left_out", Json::array()}, {"scenes", Json::array()}};
  std::string arrays;
  for (Candidate& scene : scenes) {
    if (!scene.why.empty()) {
      header["left_out"].push_back({{"scene", scene.scene}, {"why", scene.why}});
      continue;
    }
    scene.view.header["base"] = arrays.size();
    header["scenes"].push_back(std::move(scene.view.header));
    arrays += scene.view.arrays;
  }
  // Names come from files, which may hold any bytes.
  std::string text = header.dump(-1, ' ', false, Json::error_handler_t::replace);
  text.resize((text.size() + kAlignment - 1) / kAlignment * kAlignment, ' ');
  std::string out(kMagic);
  for (int i = 0; i < 4; ++i) out += static_cast<char>(text.size() >> (8 * i) & 0xff);
  return out + text + arrays;
}

}  // namespace

std::string view_bytes(const Json& results, const fs::path& folder, std::size_t limit) {
  std::vector<Candidate> scenes;
  for (const Json& scene : results.at("scenes")) {
    const std::string recording = recording_of(results, scene);
    if (!recording.empty()) scenes.push_back(candidate(folder, recording, scene, limit));
  }
  if (scenes.empty()) return "";
  leave_out_beyond(limit, scenes);
  return container(scenes);
}

}  // namespace contactcheck
