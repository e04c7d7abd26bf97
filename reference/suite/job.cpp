#include "reference/suite/job.h"

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "core/types/input_file.h"
#include "reference/results/results_json.h"

namespace contactcheck::suite {
namespace {
using json = nlohmann::ordered_json;

// Every setting, by its name in the file.
template <typename Settings, typename Visit>
void for_each_setting(Settings& s, const Visit& visit) {
  visit("detectors", s.detectors);
  visit("plugins", s.plugins);
  visit("frames", s.frames);
  visit("processes", s.processes);
  visit("one_pass_beyond", s.one_pass_beyond);
  visit("seed", s.seed);
  visit("step_repeats", s.step_repeats);
  visit("timing", s.timing);
  visit("closed_loop", s.closed_loop);
  visit("threads", s.threads);
  visit("call_limit", s.call_limit);
  visit("memory_limit", s.memory_limit);
}

RunSettings settings_from(const json& j) {
  RunSettings s;
  for_each_setting(s, [&](const char* name, auto& value) { j.at(name).get_to(value); });
  return s;
}

json to_json(const RunSettings& s) {
  json out;
  for_each_setting(s, [&](const char* name, const auto& value) { out[name] = value; });
  return out;
}

// Of the records of each list that has any.
json to_json(const judge::JudgedAnswers& answers) {
  json out = json::array();
  for (const judge::JudgedQuestion& question : answers) {
    json frames = json::array();
    for (const judge::AnswerFingerprint& print : question.frames) {
      json lists = json::array();
      for (std::size_t list = 0; list < kContactLists; ++list)
        if (print.sizes[list] > 0) lists.push_back({list, print.sizes[list], print.hashes[list]});
      frames.push_back(std::move(lists));
    }
    out.push_back({{"question", static_cast<int>(question.question)}, {"frames", frames}});
  }
  return out;
}

judge::JudgedAnswers judged_answers_from(const json& answers) {
  judge::JudgedAnswers out;
  for (const json& question : answers) {
    judge::JudgedQuestion& read = out.emplace_back();
    read.question = static_cast<Question>(question.at("question").get<int>());
    for (const json& frame : question.at("frames")) {
      judge::AnswerFingerprint& print = read.frames.emplace_back();
      for (const json& list : frame) {
        const auto number = list.at(0).get<std::size_t>();
        print.sizes.at(number) = list.at(1).get<std::uint64_t>();
        print.hashes.at(number) = list.at(2).get<std::uint64_t>();
      }
    }
  }
  return out;
}

json to_json(const Turn& turn) {
  return {turn.position, static_cast<int>(turn.question), turn.cold};
}

Turn turn_from(const json& turn) {
  return {turn.at(0).get<std::uint32_t>(), static_cast<Question>(turn.at(1).get<int>()),
          turn.at(2).get<bool>()};
}

json to_json(const TurnAnswer& answer) {
  json frames = json::array();
  for (const timing::PhaseSample& s : answer.samples) {
    frames.push_back({s.map, s.update, s.query, s.cpu, s.taken});
    if (s.reported) frames.back().push_back(*s.reported);
  }
  json out = {{"turn", to_json(answer.turn)},
              {"error", answer.error},
              {"lazy_map", answer.lazy_map},
              {"notes", answer.notes},
              {"frames", std::move(frames)}};
  if (answer.failed_frame) out["failed_frame"] = *answer.failed_frame;
  return out;
}

TurnAnswer turn_answer_from(const json& j) {
  TurnAnswer answer;
  answer.turn = turn_from(j.at("turn"));
  j.at("error").get_to(answer.error);
  j.at("lazy_map").get_to(answer.lazy_map);
  j.at("notes").get_to(answer.notes);
  if (j.contains("failed_frame")) answer.failed_frame = j.at("failed_frame").get<std::size_t>();
  for (const json& s : j.at("frames")) {
    timing::PhaseSample& frame = answer.samples.emplace_back();
    frame = {s.at(0).get<double>(), s.at(1).get<double>(), s.at(2).get<double>()};
    frame.cpu = s.at(3).get<double>();
    frame.taken = s.at(4).get<double>();
    if (s.size() > 5) frame.reported = s.at(5).get<double>();
  }
  return answer;
}

json to_json(const scene::SceneSource& source) {
  if (const auto* pairs = std::get_if<scene::PairSpec>(&source))
    return {{"count", pairs->count}, {"seed", pairs->seed}};
  if (const auto* text = std::get_if<scene::SceneText>(&source))
    return {{"text", text->text}, {"name", text->name}, {"folder", text->folder.string()}};
  if (const auto* drawn = std::get_if<scene::DrawnSpec>(&source)) {
    json out = {{"rules", drawn->rules},     {"rules_name", drawn->rules_name},
                {"seed", drawn->seed},       {"number", drawn->number},
                {"redrawn", drawn->redrawn}, {"meshes", json::array()}};
    for (const std::filesystem::path& mesh : drawn->meshes) out["meshes"].push_back(mesh.string());
    return out;
  }
  return std::get<std::filesystem::path>(source).string();
}

scene::SceneSource source_from(const json& j) {
  if (j.contains("count"))
    return scene::PairSpec{j.at("count").get<std::uint64_t>(), j.at("seed").get<std::uint64_t>()};
  if (j.contains("text"))
    return scene::SceneText{j.at("text").get<std::string>(), j.at("name").get<std::string>(),
                            j.at("folder").get<std::string>()};
  if (j.contains("rules")) {
    scene::DrawnSpec drawn;
    j.at("rules").get_to(drawn.rules);
    j.at("rules_name").get_to(drawn.rules_name);
    j.at("seed").get_to(drawn.seed);
    j.at("number").get_to(drawn.number);
    j.at("redrawn").get_to(drawn.redrawn);
    for (const json& mesh : j.at("meshes")) drawn.meshes.emplace_back(mesh.get<std::string>());
    return drawn;
  }
  return std::filesystem::path(j.get<std::string>());
}

// Texts of libraries may hold anything; JSON takes UTF-8 alone.
std::string text_of(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> named_settings(const RunSettings& settings) {
  const json all = to_json(settings);
  std::vector<std::pair<std::string, std::string>> out;
  for (const auto& [name, value] : all.items())
    if (name != "detectors") out.emplace_back(name, text_of(value));
  return out;
}

void write_job(const std::filesystem::path& file, const Job& job) {
  json j = {{"scene", to_json(job.scene)},
            {"settings", to_json(job.settings)},
            {"skip", job.skip},
            {"turns", json::array()},
            {"cold_frames", job.cold_frames},
            {"answers", json::array()},
            {"answer_file", job.answer_file.string()},
            {"recording_file", job.recording_file.string()},
            {"temporary", job.temporary.string()}};
  for (const Turn& turn : job.turns) j["turns"].push_back(to_json(turn));
  for (const judge::JudgedAnswers& answers : job.answers) j["answers"].push_back(to_json(answers));
  if (job.unjudged) j["unjudged"] = {{"why", job.unjudged->why}, {"frame", job.unjudged->frame}};
  write_file_atomically(file, j.dump());
}

Job read_job(const std::filesystem::path& file) {
  const json j = json::parse(read_text_file(file));
  Job job;
  job.scene = source_from(j.at("scene"));
  if (j.contains("unjudged"))
    job.unjudged = Unjudged{j.at("unjudged").at("why").get<std::string>(),
                            j.at("unjudged").at("frame").get<std::uint32_t>()};
  job.settings = settings_from(j.at("settings"));
  j.at("skip").get_to(job.skip);
  for (const json& turn : j.at("turns")) job.turns.push_back(turn_from(turn));
  j.at("cold_frames").get_to(job.cold_frames);
  for (const json& answers : j.at("answers")) job.answers.push_back(judged_answers_from(answers));
  job.answer_file = j.at("answer_file").get<std::string>();
  job.recording_file = j.at("recording_file").get<std::string>();
  job.temporary = j.at("temporary").get<std::string>();
  return job;
}

// Scene, rows and disagreements are written as results.json has them. Moved and not copied: the
// contacts of all detectors may be the largest thing that a worker holds.
void write_answer(const std::filesystem::path& file, SceneAnswer answer) {
  results::Results found;
  found.scenes.push_back(std::move(answer.scene));
  found.disagreements = std::move(answer.disagreements);
  json detectors = json::array();
  for (DetectorAnswer& d : answer.detectors) {
    found.runs.push_back(std::move(d.run));
    detectors.push_back({{"position", d.position},
                         {"answers", to_json(d.answers)},
                         {"contacts", std::move(d.contacts)}});
  }
  json timed = json::array();
  for (const TurnAnswer& turn : answer.timed) timed.push_back(to_json(turn));
  const json out = {{"results", results::to_json(found)},
                    {"contact_frames", answer.contact_frames},
                    {"truth_contacts", std::move(answer.truth_contacts)},
                    {"detectors", std::move(detectors)},
                    {"timed", std::move(timed)}};
  write_file_atomically(file, text_of(out));
}

SceneAnswer read_answer(const std::filesystem::path& file) {
  const json j = json::parse(read_text_file(file));
  results::Results found = results::from_json(j.at("results"));
  SceneAnswer answer;
  answer.scene = std::move(found.scenes.at(0));
  answer.disagreements = std::move(found.disagreements);
  j.at("contact_frames").get_to(answer.contact_frames);
  j.at("truth_contacts").get_to(answer.truth_contacts);
  for (const json& d : j.at("detectors")) {
    DetectorAnswer& read = answer.detectors.emplace_back();
    d.at("position").get_to(read.position);
    read.run = std::move(found.runs.at(answer.detectors.size() - 1));
    read.answers = judged_answers_from(d.at("answers"));
    d.at("contacts").get_to(read.contacts);
  }
  for (const json& turn : j.at("timed")) answer.timed.push_back(turn_answer_from(turn));
  return answer;
}

std::string read_text_file(const std::filesystem::path& file) {
  const std::string name = "file \"" + file.string() + "\"";
  std::ifstream in = open_input_file(file, name);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw InputError(name + " cannot be read: " + std::strerror(errno) + ".");
  return text.str();
}

}  // namespace contactcheck::suite
