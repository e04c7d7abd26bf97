#include "reference/suite/run_identity.h"

#include <algorithm>
#include <sstream>

#include "core/types/hash.h"
#include "reference/adapters/register.h"
#include "reference/results/results.h"
#include "reference/suite/machine.h"

namespace contactcheck::suite {
namespace {

void add_file(const std::filesystem::path& file, Fnv1a& hash) {
  const std::string bytes = read_text_file(file);
  hash.bytes(bytes.data(), bytes.size());
}

std::string line(const std::string& name, const std::string& value) {
  return name + ": " + value + "\n";
}

}  // namespace

std::string content_of(const scene::SceneSource& source, const scene::Scene& scene) {
  if (const auto* pairs = std::get_if<scene::PairSpec>(&source))
    return std::to_string(pairs->count) + " random pairs, seed " + std::to_string(pairs->seed);
  if (const auto* drawn = std::get_if<scene::DrawnSpec>(&source)) {
    Fnv1a rules;
    rules.bytes(drawn->rules.data(), drawn->rules.size());
    for (const std::filesystem::path& mesh : drawn->meshes) add_file(mesh, rules);
    return "scene " + std::to_string(drawn->number) + " of seed " + std::to_string(drawn->seed) +
           " by rules " + results::hex(rules.digest());
  }
  Fnv1a hash;
  if (const auto* text = std::get_if<scene::SceneText>(&source)) {
    hash.bytes(text->text.data(), text->text.size());
  } else {
    add_file(std::get<std::filesystem::path>(source), hash);
  }
  for (const Body& body : scene.bodies) {
    const std::uint64_t mesh = content_hash(body.shape->mesh);
    hash.bytes(&mesh, sizeof mesh);
  }
  for (const auto& frame : scene.recorded)
    for (const std::vector<Vec3>& nodes : frame)
      hash.bytes(nodes.data(), sizeof(Vec3) * nodes.size());
  return results::hex(hash.digest());
}

std::string hash_of_file(const std::filesystem::path& file) {
  Fnv1a hash;
  add_file(file, hash);
  return results::hex(hash.digest());
}

std::string program_lines(const std::filesystem::path& program) {
  return line("version", CONTACTCHECK_VERSION) + line("program", hash_of_file(program));
}

std::string machine_lines() {
  std::string out;
  for (const auto& [member, value] : results::members_of(describe_machine()))
    out += line(member, value);
  return out;
}

RunIdentity::RunIdentity(const SuiteRequest& request) {
  common_ = program_lines(request.executable);
  for (const auto& [library, version] : adapters::library_versions())
    common_ += line(library, version);
  common_ += machine_lines();
  for (const auto& [setting, value] : named_settings(request.settings))
    common_ += line(setting, value);
}

std::string RunIdentity::of(const SceneTask& task) const {
  std::string identity = common_ + line("content", task.content);
  for (const std::string& name : task.detectors) identity += line("detector", name);
  for (const std::string& name : task.references) identity += line("reference", name);
  return identity;
}

std::vector<std::string> differences(const std::string& one, const std::string& other) {
  const auto lines_of = [](const std::string& identity) {
    std::istringstream text(identity);
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  };
  const std::vector<std::string> lines[2] = {lines_of(one), lines_of(other)};
  std::vector<std::string> out;
  for (const int side : {0, 1})
    for (const std::string& line : lines[side]) {
      const auto& others = lines[1 - side];
      const std::string name = line.substr(0, line.find(": "));
      if (std::find(others.begin(), others.end(), line) == others.end() &&
          std::find(out.begin(), out.end(), name) == out.end())
        out.push_back(name);
    }
  return out;
}

}  // namespace contactcheck::suite
