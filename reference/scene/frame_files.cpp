#include "reference/scene/frame_files.h"

#include <algorithm>
#include <cctype>
#include <compare>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <set>
#include <utility>

#include "core/deform/name_check.h"
#include "core/types/check.h"
#include "reference/scene/point_cache.h"
#include "reference/text/file_text.h"
#include "reference/text/shell_word.h"
#include "reference/text/words.h"

namespace contactcheck::scene {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_separator(char c) { return std::string_view("_-. =").find(c) != std::string_view::npos; }

/// A decimal number of any length, as it is written in a name.
struct Number {
  bool negative = false;
  std::string whole, fraction;  ///< without zeros in front, behind

  explicit Number(std::string_view text) {
    negative = text.starts_with('-');
    if (negative) text.remove_prefix(1);
    const std::size_t point = std::min(text.find('.'), text.size()),
                      first = std::min(text.find_first_not_of('0'), point);
    whole = text.substr(first, point - first);
    if (point < text.size()) fraction = text.substr(point + 1);
    fraction.erase(fraction.find_last_not_of('0') + 1);
    negative = negative && !(whole.empty() && fraction.empty());
  }

  std::strong_ordering operator<=>(const Number& other) const {
    if (negative != other.negative) return other.negative <=> negative;
    const Number &a = negative ? other : *this, &b = negative ? *this : other;
    if (a.whole.size() != b.whole.size()) return a.whole.size() <=> b.whole.size();
    if (const auto order = a.whole <=> b.whole; order != 0) return order;
    return a.fraction <=> b.fraction;
  }
  bool operator==(const Number&) const = default;

  /// Where it is a whole number of at most nine digits.
  std::optional<int> counted() const {
    if (!fraction.empty() || whole.size() > 9) return std::nullopt;
    const int value = whole.empty() ? 0 : std::stoi(whole);
    return negative ? -value : value;
  }
};

/// Where a number stands in a path.
struct Place {
  std::size_t begin, end;
};

// The letters before a number, with a separator between them or without one, in lower case.
std::string word_before(const std::string& path, std::size_t number) {
  std::size_t end = number;
  while (end > 0 && is_separator(path[end - 1])) --end;
  std::size_t begin = end;
  while (begin > 0 && is_letter(path[begin - 1])) --begin;
  return text::lower_case(path.substr(begin, end - begin));
}

bool is_time(const std::string& word) { return word == "t" || word == "time"; }
bool counts_frames(const std::string& word) {
  static const std::set<std::string> words = {"frame",  "frames", "frm",      "f",
                                              "fr",     "iter",   "step",     "steps",
                                              "sample", "tick",   "timestep", "iteration"};
  return is_time(word) || words.contains(word);
}

// The numbers in the path without its extension.
std::vector<Place> numbers_in(const std::string& path, std::size_t end) {
  std::vector<Place> out;
  for (std::size_t at = 0; at < end;) {
    if (!is_digit(path[at])) {
      ++at;
      continue;
    }
    Place place{at, at};
    while (place.end < end && is_digit(path[place.end])) ++place.end;
    if (is_time(word_before(path, at)) && place.end + 1 < end && path[place.end] == '.' &&
        is_digit(path[place.end + 1])) {
      ++place.end;
      while (place.end < end && is_digit(path[place.end])) ++place.end;
    }
    // A sign, and no hyphen between a word and its number.
    if (at > 0 && path[at - 1] == '-' &&
        (at == 1 || path[at - 2] == '/' || (is_separator(path[at - 2]) && path[at - 2] != '-')))
      --place.begin;
    out.push_back(place);
    at = place.end;
  }
  return out;
}

/// A path and its numbers.
struct NumberedFile {
  fs::path file;
  std::string path;
  std::size_t name_begin = 0, extension_begin = 0;
  std::vector<Place> places;

  explicit NumberedFile(const fs::path& given) : file(given), path(given.string()) {
    extension_begin = path.size() - given.extension().string().size();
    name_begin = path.size() - given.filename().string().size();
    places = numbers_in(path, extension_begin);
  }

  std::string number_text(std::size_t place) const {
    return path.substr(places[place].begin, places[place].end - places[place].begin);
  }
  // The path with a byte of 0 in place of its numbers.
  std::string without_numbers() const {
    std::string out;
    std::size_t at = 0;
    for (const Place& place : places) {
      out += path.substr(at, place.begin - at) + '\0';
      at = place.end;
    }
    return out + path.substr(at, extension_begin - at) +
           text::lower_case(path.substr(extension_begin));
  }
  // Its name, or the end of its path that has all of these places, with words in place of them.
  std::string with_words(const std::vector<std::pair<Place, std::string>>& words) const {
    std::size_t at = name_begin;
    for (const auto& [place, word] : words)
      if (place.begin < at) at = path.rfind('/', place.begin) + 1;
    std::string out;
    for (const auto& [place, word] : words) {
      out += path.substr(at, place.begin - at) + word;
      at = place.end;
    }
    return out + path.substr(at);
  }
};

/// Files of one body, in the order of their numbers.
struct BodyFiles {
  std::string name;    ///< what its name is made of
  std::string folder;  ///< and where it is not alone with that
  struct File {
    fs::path file;
    std::optional<Number> number;
    std::string before, after;  ///< of the number
  };
  std::vector<File> files;
  fs::path cache;

  bool moves() const { return files.size() > 1; }
};

// What is left of a name without its number, and without a word that only says what that is.
std::string name_without(const std::string& before, const std::string& after) {
  std::string front = before, back = after;
  const auto is_loose = [](char c) {
    return is_separator(c) || std::string_view("()[]").find(c) != std::string_view::npos;
  };
  while (!front.empty() && is_loose(front.back())) front.pop_back();
  std::size_t word = front.size();
  while (word > 0 && is_letter(front[word - 1])) --word;
  if (counts_frames(text::lower_case(front.substr(word)))) front.resize(word);
  while (!front.empty() && is_loose(front.back())) front.pop_back();
  while (!back.empty() && is_loose(back.front())) back.erase(0, 1);
  while (!back.empty() && is_loose(back.back())) back.pop_back();
  return front + (front.empty() || back.empty() ? "" : "_") + back;
}

BodyFiles resting(const fs::path& file) {
  BodyFiles out{name_without(file.stem().string(), ""),
                file.parent_path().filename().string(),
                {{file, std::nullopt, {}, {}}},
                {}};
  if (out.name.empty()) out.name = file.stem().string();
  return out;
}

/// Gathers bodies in the order in which their first files are given.
class Bodies {
 public:
  void add_resting(const fs::path& file) { bodies_.push_back(resting(file)); }

  void add_frame(const NumberedFile& file, Place place) {
    const std::string key = file.path.substr(0, place.begin) + '\0' +
                            file.path.substr(place.end, file.extension_begin - place.end) +
                            text::lower_case(file.path.substr(file.extension_begin));
    const auto [at, is_new] = known_.try_emplace(key, bodies_.size());
    if (is_new) {
      const bool in_name = place.begin >= file.name_begin;
      const std::string stem = file.file.stem().string();
      const std::size_t begin = place.begin - file.name_begin, end = place.end - file.name_begin;
      bodies_.push_back(
          {in_name ? name_without(stem.substr(0, begin), stem.substr(end)) : name_without(stem, ""),
           in_name ? file.file.parent_path().filename().string() : "",
           {},
           {}});
    }
    bodies_[at->second].files.push_back(
        {file.file, Number(file.path.substr(place.begin, place.end - place.begin)),
         file.path.substr(0, place.begin), file.path.substr(place.end)});
  }

  std::vector<BodyFiles>& all() { return bodies_; }

 private:
  std::vector<BodyFiles> bodies_;
  std::map<std::string, std::size_t> known_;
};

// How much says that a number is the frame's.
enum class Hint { kNone, kZeros, kWord };

/// Files whose paths differ in numbers alone.
class Family {
 public:
  void add(const NumberedFile& file) { files_.push_back(file); }
  const std::vector<NumberedFile>& files() const { return files_; }

  /// The place of the frame's number; none where no number differs.
  std::optional<std::size_t> frame_place() const {
    std::vector<std::size_t> differing;
    for (std::size_t i = 0; i < files_[0].places.size(); ++i)
      if (std::ranges::any_of(files_, [&](const NumberedFile& file) {
            return Number(file.number_text(i)) != Number(files_[0].number_text(i));
          }))
        differing.push_back(i);
    if (differing.empty()) return std::nullopt;
    if (differing.size() == 1) {
      if (hint(differing[0]) == Hint::kNone && may_count_bodies(differing[0]))
        refuse_readings(differing);
      return differing[0];
    }
    Hint best = Hint::kNone;
    for (const std::size_t place : differing) best = std::max(best, hint(place));
    const auto has_best = [&](std::size_t place) { return hint(place) == best; };
    if (best == Hint::kNone || std::ranges::count_if(differing, has_best) != 1)
      refuse_readings(differing);
    return *std::ranges::find_if(differing, has_best);
  }

 private:
  Hint hint(std::size_t place) const {
    if (counts_frames(word_before(files_[0].path, files_[0].places[place].begin)))
      return Hint::kWord;
    // "0007", and not the "01" of a body.
    const auto has_zeros = [&](const NumberedFile& file) {
      const std::string text = file.number_text(place);
      return text.size() > 2 && text[0] == '0';
    };
    return in_folder(place) || std::ranges::none_of(files_, has_zeros) ? Hint::kNone : Hint::kZeros;
  }
  bool in_folder(std::size_t place) const {
    return files_[0].places[place].begin < files_[0].name_begin;
  }
  bool may_count_bodies(std::size_t place) const {
    const std::size_t begin = files_[0].places[place].begin;
    return in_folder(place) ||
           (begin > files_[0].name_begin && is_letter(files_[0].path[begin - 1]));
  }

  // With the pattern of each reading.
  [[noreturn]] void refuse_readings(const std::vector<std::size_t>& differing) const {
    const std::vector<Place>& places = files_[0].places;
    const auto pattern = [&](const std::vector<std::pair<Place, std::string>>& words) {
      return "--frames " + text::in_shell(files_[0].with_words(words));
    };
    std::string readings;
    for (const std::size_t frame : differing) {
      std::vector<std::pair<Place, std::string>> words;
      for (const std::size_t place : differing)
        words.emplace_back(places[place], place == frame ? "{frame}" : "{body}");
      readings += (readings.empty() ? "" : ", or ") + pattern(words);
    }
    if (differing.size() == 1)
      readings += " if it counts frames of one body, " +
                  pattern({{places[differing[0]], "{body}"}}) + " if it counts bodies";
    if (const Place &a = places[differing[0]], &b = places[differing.back()];
        a.end + 1 == b.begin && files_[0].path[a.end] == '.')
      readings += ", or " + pattern({{{a.begin, b.end}, "{frame}"}});
    throw InputError(text::in_quotes(files_[0].path) + " and " +
                     (files_.size() == 2 ? text::in_quotes(files_[1].path)
                                         : std::to_string(files_.size() - 1) + " more files") +
                     " differ in " + (differing.size() == 1 ? "a number" : "several numbers") +
                     " with two readings: " + readings);
  }

  std::vector<NumberedFile> files_;
};

// By what their numbers leave of their paths, and where the first of them was named.
std::vector<Family> families_of(const std::vector<NumberedFile>& files) {
  std::vector<Family> out;
  std::map<std::string, std::size_t> known;
  for (const NumberedFile& file : files) {
    const auto [at, is_new] = known.try_emplace(file.without_numbers(), out.size());
    if (is_new) out.emplace_back();
    out[at->second].add(file);
  }
  // "a-1" beside "a0": the hyphen is a sign or is none.
  for (const auto& [path, family] : known)
    for (std::size_t at = path.find(std::string("-\0", 2)); at != std::string::npos;
         at = path.find(std::string("-\0", 2), at + 1)) {
      std::string unsigned_path = path;
      unsigned_path.erase(at, 1);
      if (const auto other = known.find(unsigned_path); other != known.end())
        throw InputError(
            text::in_quotes(out[family].files()[0].path) + " and " +
            text::in_quotes(out[other->second].files()[0].path) +
            " have two readings, with a hyphen or with a sign before the number: say with "
            "--frames, as in \"cloth{frame}.obj\", which it is");
    }
  return out;
}

// "{body}_{frame}.obj" for the ends of paths.
struct Pattern {
  std::regex regex;
  bool has_frame;

  explicit Pattern(const std::string& text) {
    std::string out = "(?:.*/)?";
    std::size_t frames = 0;
    for (std::size_t at = 0; at < text.size();) {
      const std::string_view rest = std::string_view(text).substr(at);
      if (rest.starts_with("{frame}")) {
        out += "(-?[0-9]+(?:\\.[0-9]+)?)";
        ++frames;
        at += 7;
      } else if (rest.starts_with("{body}")) {
        out += "[^/]+";
        at += 6;
      } else {
        if (std::string_view(R"(\^$.|?*+()[]{})").find(text[at]) != std::string_view::npos)
          out += '\\';
        out += text[at++];
      }
    }
    if (frames > 1 || (frames == 0 && text.find("{body}") == std::string::npos))
      throw InputError("--frames " + text::in_quotes(text) +
                       " must have {frame} once, or {body} for bodies at rest");
    has_frame = frames == 1;
    regex.assign(out, std::regex::icase);
  }
};

// As the patterns say; whatever matches none is at rest.
void add_by_patterns(const std::vector<NumberedFile>& files, const FrameRules& rules,
                     Bodies& bodies) {
  std::vector<Pattern> patterns;
  for (const std::string& text : rules.patterns) patterns.emplace_back(text);
  std::vector<std::size_t> matches(patterns.size());
  for (const NumberedFile& file : files) {
    std::smatch match;
    const auto found = std::ranges::find_if(patterns, [&](const Pattern& pattern) {
      return std::regex_match(file.path, match, pattern.regex);
    });
    if (found != patterns.end()) ++matches[static_cast<std::size_t>(found - patterns.begin())];
    if (found == patterns.end() || !found->has_frame) {
      bodies.add_resting(file.file);
      continue;
    }
    const auto begin = static_cast<std::size_t>(match.position(1));
    bodies.add_frame(file, {begin, begin + static_cast<std::size_t>(match.length(1))});
  }
  for (std::size_t i = 0; i < patterns.size(); ++i)
    if (matches[i] == 0)
      throw InputError("--frames " + text::in_quotes(rules.patterns[i]) + " matches no file");
}

// Those of one family together.
void add_by_names(const std::vector<NumberedFile>& files, Bodies& bodies) {
  for (const Family& family : families_of(files)) {
    const std::optional<std::size_t> place = family.frame_place();
    for (const NumberedFile& file : family.files()) {
      if (place)
        bodies.add_frame(file, file.places[*place]);
      else
        bodies.add_resting(file.file);
    }
  }
}

// In the order in which their first files are named. A mesh with its cache is no frame of another.
std::vector<BodyFiles> bodies_of(const std::vector<fs::path>& files, const FrameRules& rules) {
  Bodies bodies;
  std::vector<NumberedFile> meshes;
  std::vector<std::pair<fs::path, fs::path>> cached;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (is_point_cache(files[i]))
      throw InputError(text::in_quotes(files[i].string()) +
                       " is a point cache; the mesh that it moves is named before it");
    if (i + 1 < files.size() && is_point_cache(files[i + 1])) {
      cached.emplace_back(files[i], files[i + 1]);
      ++i;
    } else {
      meshes.emplace_back(files[i]);
    }
  }
  if (rules.patterns.empty())
    add_by_names(meshes, bodies);
  else
    add_by_patterns(meshes, rules, bodies);
  std::vector<BodyFiles> out = std::move(bodies.all());
  for (const auto& [mesh, cache] : cached) {
    out.push_back(resting(mesh));
    out.back().cache = cache;
  }
  std::map<fs::path, std::size_t> first_named;
  for (std::size_t i = 0; i < files.size(); ++i) first_named.try_emplace(files[i], i);
  const auto place_of = [&](const BodyFiles& body) { return first_named.at(body.files[0].file); };
  std::ranges::stable_sort(out, {}, place_of);
  return out;
}

void sort_frames(BodyFiles& body) {
  std::ranges::stable_sort(body.files, {}, [](const auto& file) { return *file.number; });
  std::optional<int> step;
  for (std::size_t i = 1; i < body.files.size(); ++i) {
    const auto &a = body.files[i - 1], &b = body.files[i];
    if (*a.number == *b.number)
      throw InputError(text::in_quotes(a.file.string()) + " and " +
                       text::in_quotes(b.file.string()) + " are one frame of one body");
    const auto from = a.number->counted(), to = b.number->counted();
    if (!from || !to) continue;  // times go on as they like
    if (step && *to - *from != *step)
      throw InputError("the numbers of " + text::in_quotes(a.before + "*" + a.after) + " go from " +
                       std::to_string(*from) + " to " + std::to_string(*to) +
                       ", and before in steps of " + std::to_string(*step) +
                       "; all steps must be alike");
    step = *to - *from;
  }
}

// Frames that not every moving body has are taken from it, and named.
void keep_common_frames(std::vector<BodyFiles>& bodies, std::vector<std::string>& unchecked) {
  std::optional<std::vector<Number>> common;
  for (const BodyFiles& body : bodies) {
    if (!body.moves()) continue;
    std::vector<Number> numbers, both;
    for (const auto& file : body.files) numbers.push_back(*file.number);
    if (common) std::ranges::set_intersection(*common, numbers, std::back_inserter(both));
    common = common ? std::move(both) : std::move(numbers);
  }
  if (!common) return;
  for (BodyFiles& body : bodies) {
    if (!body.moves()) continue;
    if (common->empty())
      throw InputError("no frame is one of all bodies: the numbers of " +
                       text::in_quotes(body.files[0].file.string()) + " go on to " +
                       text::in_quotes(body.files.back().file.string()) +
                       ", and others have none of them");
    std::erase_if(body.files, [&](const auto& file) {
      const bool kept = std::ranges::binary_search(*common, *file.number);
      if (!kept) unchecked.push_back(file.file.string());
      return !kept;
    });
  }
}

// A pattern of a shell where files differ in their numbers alone.
std::string shown_files(const BodyFiles& body) {
  const auto word = [](const std::string& part) {
    return part.empty() ? "" : text::in_shell(part);
  };
  const auto& first = body.files[0];
  std::string out;
  if (body.files.size() > 1 && std::ranges::all_of(body.files, [&](const auto& file) {
        return file.before == first.before && file.after == first.after;
      }))
    return word(first.before) + "*" + word(first.after);
  for (const auto& file : body.files) out += (out.empty() ? "" : " ") + word(file.file.string());
  return out + (body.cache.empty() ? "" : " " + word(body.cache.string()));
}

// Its name, or where all frames have one the folder, too.
std::string label(const BodyFiles& body, std::size_t frame) {
  const fs::path& file = body.files[frame].file;
  const bool alike = body.files[0].file.filename() == body.files.back().file.filename();
  return (alike ? file.parent_path().filename() / file.filename() : file.filename()).string();
}

std::string name_for(const BodyFiles& body, const std::vector<BodyFiles>& all, const Json& bodies) {
  const auto same_name = [&](const BodyFiles& other) { return other.name == body.name; };
  const bool alone = !body.name.empty() && std::ranges::count_if(all, same_name) == 1;
  std::string stem = alone || body.folder.empty() ? body.name : body.folder;
  if (!name_fault(stem).empty()) stem = "body";
  const auto taken = [&](const std::string& name) {
    return std::ranges::any_of(bodies, [&](const Json& other) { return other.at("name") == name; });
  };
  std::string name = stem;
  for (std::size_t i = 2; taken(name); ++i) name = stem + "-" + std::to_string(i);
  return name;
}

Json body_json(const BodyFiles& body, const FrameRules& rules) {
  Json json, recording = Json::object();
  if (body.moves()) {
    for (const auto& file : body.files) recording["files"].push_back(file.file.string());
    if (rules.repair) recording["repair"] = true;
  } else {
    json["mesh"] = {{"file", body.files[0].file.string()}};
    if (rules.repair) json["mesh"]["repair"] = true;
  }
  if (!body.cache.empty()) {
    recording["cache"] = body.cache.string();
    if (!rules.cache_space.empty()) recording["space"] = rules.cache_space;
  }
  if (!recording.empty()) json["recording"] = std::move(recording);
  return json;
}

}  // namespace

FrameFiles frame_files(const std::vector<fs::path>& files, const FrameRules& rules,
                       const std::string& id, const std::vector<Level>& levels) {
  FrameFiles out;
  std::vector<BodyFiles> groups = bodies_of(files, rules);
  for (BodyFiles& body : groups)
    if (body.moves()) sort_frames(body);
  for (const BodyFiles& body : groups) out.shown.push_back(shown_files(body));
  keep_common_frames(groups, out.unchecked);
  Json bodies = Json::array(), level_names = Json::array();
  bool recorded = false;
  for (const BodyFiles& body : groups) {
    Json json = {{"name", name_for(body, groups, bodies)}};
    json.update(body_json(body, rules));
    recorded = recorded || json.contains("recording");
    if (out.labels.empty() && json.contains("recording") && body.cache.empty())
      for (std::size_t frame = 0; frame < body.files.size(); ++frame)
        out.labels.push_back(label(body, frame));
    if (!body.moves()) out.others.push_back(body.files[0].file);
    if (!body.cache.empty()) out.others.push_back(body.cache);
    if (body.moves()) out.moving.resize(body.files.size());
    for (std::size_t frame = 0; frame < out.moving.size() && body.moves(); ++frame)
      out.moving[frame].push_back(body.files[frame].file);
    bodies.push_back(std::move(json));
  }
  for (const Level level : levels) level_names.push_back(name_of(level));
  Json scene = {{"id", id}, {"time_step", 1}, {"levels", level_names}, {"bodies", bodies}};
  if (!recorded) scene["frames"] = 1;
  out.scene = {scene.dump(), "frames to be checked", fs::current_path()};
  return out;
}

}  // namespace contactcheck::scene
