#include "reference/run/job.h"

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "core/types/input_file.h"

namespace contactcheck {
namespace {
using nlohmann::json;

RunSettings settings_from(const json& j) {
  RunSettings s;
  j.at("detectors").get_to(s.detectors);
  j.at("plugins").get_to(s.plugins);
  j.at("frames").get_to(s.frames);
  j.at("repeats").get_to(s.repeats);
  j.at("processes").get_to(s.processes);
  j.at("time_budget").get_to(s.time_budget);
  j.at("fewest_timed_frames").get_to(s.fewest_timed_frames);
  j.at("sweep_bytes").get_to(s.sweep_bytes);
  j.at("timing").get_to(s.timing);
  j.at("closed_loop").get_to(s.closed_loop);
  j.at("threads").get_to(s.threads);
  j.at("call_limit").get_to(s.call_limit);
  j.at("memory_limit").get_to(s.memory_limit);
  return s;
}

}  // namespace

nlohmann::json to_json(const RunSettings& s) {
  return {{"detectors", s.detectors},
          {"plugins", s.plugins},
          {"frames", s.frames},
          {"repeats", s.repeats},
          {"processes", s.processes},
          {"time_budget", s.time_budget},
          {"fewest_timed_frames", s.fewest_timed_frames},
          {"sweep_bytes", s.sweep_bytes},
          {"timing", s.timing},
          {"closed_loop", s.closed_loop},
          {"threads", s.threads},
          {"call_limit", s.call_limit},
          {"memory_limit", s.memory_limit}};
}

void write_job(const std::filesystem::path& file, const Job& job) {
  json j = {{"scene_file", job.scene_file.string()},
            {"settings", to_json(job.settings)},
            {"skip", job.skip},
            {"process", job.process},
            {"order", job.order},
            {"prefixes", job.prefixes},
            {"answers", json::array()},
            {"answer_file", job.answer_file.string()},
            {"recording_file", job.recording_file.string()}};
  for (const JudgedAnswers& answers : job.answers) j["answers"].push_back(to_json(answers));
  if (job.text)
    j["text"] = {
        {"text", job.text->text}, {"name", job.text->name}, {"folder", job.text->folder.string()}};
  if (job.unjudged) j["unjudged"] = {{"why", job.unjudged->why}, {"frame", job.unjudged->frame}};
  if (job.pairs) j["pairs"] = {{"count", job.pairs->count}, {"seed", job.pairs->seed}};
  write_file_atomically(file, j.dump());
}

Job read_job(const std::filesystem::path& file) {
  const json j = json::parse(read_text_file(file));
  Job job;
  job.scene_file = j.at("scene_file").get<std::string>();
  if (j.contains("pairs"))
    job.pairs = PairSpec{j.at("pairs").at("count").get<std::uint64_t>(),
                         j.at("pairs").at("seed").get<std::uint64_t>()};
  if (j.contains("text"))
    job.text = SceneText{j.at("text").at("text").get<std::string>(),
                         j.at("text").at("name").get<std::string>(),
                         j.at("text").at("folder").get<std::string>()};
  if (j.contains("unjudged"))
    job.unjudged = Unjudged{j.at("unjudged").at("why").get<std::string>(),
                            j.at("unjudged").at("frame").get<std::uint32_t>()};
  job.settings = settings_from(j.at("settings"));
  j.at("skip").get_to(job.skip);
  j.at("process").get_to(job.process);
  j.at("order").get_to(job.order);
  j.at("prefixes").get_to(job.prefixes);
  for (const json& answers : j.at("answers"))
    job.answers.push_back(judged_answers_from_json(answers));
  job.answer_file = j.at("answer_file").get<std::string>();
  job.recording_file = j.at("recording_file").get<std::string>();
  return job;
}

std::string read_text_file(const std::filesystem::path& file) {
  const std::string name = "file \"" + file.string() + "\"";
  std::ifstream in = open_input_file(file, name);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw InputError(name + " cannot be read: " + std::strerror(errno) + ".");
  return text.str();
}

}  // namespace contactcheck
