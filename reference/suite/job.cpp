#include "reference/suite/job.h"

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>
#include <tuple>

#include "core/deform/atomic_file.h"
#include "core/types/check.h"
#include "core/types/input_file.h"
#include "reference/results/results_json.h"
#include "reference/text/described_json.h"

namespace contactcheck::judge {

// Only lists that have records are written: most answers have one or two of a dozen.
template <typename Io>
void fields(Io& io, AnswerFingerprint& print) {
  std::vector<std::tuple<std::size_t, std::uint64_t, std::uint64_t>> lists;
  for (std::size_t list = 0; list < kContactLists; ++list)
    if (print.sizes[list] > 0) lists.emplace_back(list, print.sizes[list], print.hashes[list]);
  io("lists", lists);
  if constexpr (Io::kReads)
    for (const auto& [list, size, hash] : lists) {
      print.sizes.at(list) = size;
      print.hashes.at(list) = hash;
    }
}

template <typename Io>
void fields(Io& io, JudgedQuestion& judged) {
  CONTACTCHECK_FIELDS(io, judged, question, frames);
}

}  // namespace contactcheck::judge

namespace contactcheck::timing {

static auto elements(PhaseSample& s) {
  return std::tie(s.map, s.update, s.query, s.cpu, s.taken, s.reported);
}

template <typename Io>
void fields(Io& io, QuestionSamples& s) {
  CONTACTCHECK_FIELDS(io, s, question, lazy_map, playback, cold);
}

}  // namespace contactcheck::timing

namespace contactcheck::scene {

static auto elements(PairSpec& pairs) { return std::tie(pairs.count, pairs.seed); }
static auto elements(SceneText& text) { return std::tie(text.text, text.name, text.folder); }
static auto elements(DrawnSpec& drawn) {
  return std::tie(drawn.rules, drawn.rules_name, drawn.seed, drawn.number, drawn.redrawn,
                  drawn.meshes);
}

}  // namespace contactcheck::scene

namespace contactcheck::suite {

using text::Json;

template <typename Io>
void fields(Io& io, RunSettings& s) {
  CONTACTCHECK_FIELDS(io, s, detectors, plugins, frames, processes, one_pass_beyond, seed,
                      step_repeats, timing, closed_loop, threads, call_limit, memory_limit);
}

static auto elements(Unjudged& unjudged) { return std::tie(unjudged.why, unjudged.frame); }
static auto elements(Turn& turn) { return std::tie(turn.position, turn.question, turn.cold); }

template <typename Io>
void fields(Io& io, Job& job) {
  CONTACTCHECK_FIELDS(io, job, scene, settings, skip, unjudged, turns, cold_frames, answers,
                      answer_file, recording_file, temporary);
}

template <typename Io>
void fields(Io& io, DetectorAnswer& answer) {
  CONTACTCHECK_FIELDS(io, answer, position, answers);
}

template <typename Io>
void fields(Io& io, TurnAnswer& answer) {
  CONTACTCHECK_FIELDS(io, answer, turn, error, failed_frame, lazy_map);
  io("frames", answer.samples);
  io("notes", answer.notes);
}

template <typename Io>
void fields(Io& io, SceneAnswer& answer) {
  CONTACTCHECK_FIELDS(io, answer, contact_frames, contact_steps, detectors, timed);
}

// Texts of libraries may hold anything; JSON takes UTF-8 alone.
static std::string text_of(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<std::pair<std::string, std::string>> named_settings(const RunSettings& settings) {
  const Json all = text::described(settings);
  std::vector<std::pair<std::string, std::string>> out;
  for (const auto& [name, value] : all.items())
    if (name != "detectors") out.emplace_back(name, text_of(value));
  return out;
}

void write_job(const std::filesystem::path& file, const Job& job) {
  write_file_atomically(file, text::described(job).dump());
}

Job read_job(const std::filesystem::path& file) {
  Job job;
  text::read_described(Json::parse(read_text_file(file)), job);
  return job;
}

// Scene, rows and disagreements are written as results.json has them. Contacts are moved and not
// copied: those of all detectors may be the largest thing that a worker holds.
void write_answer(const std::filesystem::path& file, SceneAnswer answer) {
  Json out = text::described(answer);
  results::Results found;
  found.scenes.push_back(std::move(answer.scene));
  found.disagreements = std::move(answer.disagreements);
  out["contacts"] = Json::array();
  for (DetectorAnswer& d : answer.detectors) {
    found.runs.push_back(std::move(d.run));
    out["contacts"].push_back(std::move(d.contacts));
  }
  out["truth_contacts"] = std::move(answer.truth_contacts);
  out["results"] = results::to_json(found);
  write_file_atomically(file, text_of(out));
}

SceneAnswer read_answer(const std::filesystem::path& file) {
  const Json j = Json::parse(read_text_file(file));
  SceneAnswer answer;
  text::read_described(j, answer);
  results::Results found = results::from_json(j.at("results"));
  answer.scene = std::move(found.scenes.at(0));
  answer.disagreements = std::move(found.disagreements);
  j.at("truth_contacts").get_to(answer.truth_contacts);
  for (std::size_t i = 0; i < answer.detectors.size(); ++i) {
    answer.detectors[i].run = std::move(found.runs.at(i));
    j.at("contacts").at(i).get_to(answer.detectors[i].contacts);
  }
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

nlohmann::ordered_json samples_json(timing::QuestionSamples samples) {
  return text::described(samples);
}

timing::QuestionSamples samples_from_json(const nlohmann::ordered_json& json) {
  timing::QuestionSamples out;
  text::read_described(json, out);
  return out;
}

}  // namespace contactcheck::suite
