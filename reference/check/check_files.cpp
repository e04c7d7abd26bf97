#include "reference/check/check_files.h"

#include <array>
#include <initializer_list>
#include <utility>

#include "reference/report/formats/csv.h"

namespace contactcheck::check {
namespace {

constexpr std::array<const char*, 19> kColumns = {
    "kind",          "frame",         "file",          "body_a",     "body_b",
    "allowed",       "pairs",         "first_a",       "first_b",    "depth_lower_m",
    "depth_upper_m", "depth_unknown", "time_lower",    "time_upper", "start",
    "end",           "later_pairs",   "passing_pairs", "inside"};

/// A line under these titles.
class Line {
 public:
  void set(const std::string& title, const Json& value) {
    for (std::size_t i = 0; i < kColumns.size(); ++i)
      if (kColumns[i] == title && !value.is_null())
        cells_[i] = value.is_string() ? value.get<std::string>() : value.dump();
  }
  std::string text() const {
    std::string out;
    for (const std::string& cell : cells_)
      out += (&cell == cells_.data() ? "" : ",") + report::csv_cell(cell);
    return out + "\r\n";
  }

 private:
  std::array<std::string, kColumns.size()> cells_;
};

Line line_of(const char* kind, const Json& frame, const Json& file, const Json& a, const Json& b) {
  Line line;
  line.set("kind", kind);
  line.set("frame", frame);
  line.set("file", file);
  line.set("body_a", a);
  line.set("body_b", b);
  return line;
}

// "vertex 5", "edge 3 7", "triangle 2"
std::string element_text(const Json& element) {
  if (element.contains("vertex")) return "vertex " + element["vertex"].dump();
  if (element.contains("triangle")) return "triangle " + element["triangle"].dump();
  return "edge " + element["edge"][0].dump() + " " + element["edge"][1].dump();
}

std::string frame_lines(const Json& event) {
  std::string out;
  for (const Json& c : event.at("contacts")) {
    Line line = line_of("frame", event["frame"], event["file"], c["bodies"][0], c["bodies"][1]);
    line.set("allowed", "no");
    line.set("pairs", c["triangle_pairs"]);
    if (c["first"].is_null()) {
      line.set("inside", "yes");
    } else {
      line.set("first_a", "triangle " + c["first"][0].dump());
      line.set("first_b", "triangle " + c["first"][1].dump());
    }
    if (c["depth"].is_null()) {
      line.set("depth_unknown", c["depth_unknown"]["reason"]);
    } else {
      line.set("depth_lower_m", c["depth"]["lower"]);
      line.set("depth_upper_m", c["depth"]["upper"]);
    }
    out += line.text();
  }
  for (const Json& self : event.at("self")) {
    Line line = line_of("frame", event["frame"], event["file"], self["body"], self["body"]);
    std::size_t pairs = 0;
    for (const Level level : kSelfClasses) pairs += self[name_of(level)].get<std::size_t>();
    line.set("allowed", "no");
    line.set("pairs", pairs);
    line.set("first_a", "triangle " + self["first"][0].dump());
    line.set("first_b", "triangle " + self["first"][1].dump());
    out += line.text();
  }
  return out;
}

std::string step_lines(const FoundContacts& step) {
  const Json& event = step.event;
  std::string out;
  for (std::size_t i = 0; i < step.found.size(); ++i) {
    const Json& c = event.at("contacts").at(i);
    Line line = line_of("step", event["step"], event["files"][0], c["bodies"][0], c["bodies"][1]);
    line.set("allowed", !step.found[i] ? "frames" : c["allowed"].get<bool>() ? "yes" : "no");
    line.set("start", c["start"]);
    line.set("end", c["end"]);
    line.set("later_pairs", c["later_pairs"]);
    line.set("passing_pairs", c["passing_pairs"]);
    if (const Json& first = c["first"]; !first.is_null()) {
      // The vertex comes first, of whichever body.
      const bool swapped = first["elements"][0]["body"] != c["bodies"][0];
      line.set("first_a", element_text(first["elements"][swapped ? 1 : 0]));
      line.set("first_b", element_text(first["elements"][swapped ? 0 : 1]));
      line.set("time_lower", first["time"]["lower"]);
      line.set("time_upper", first["time"]["upper"]);
    }
    out += line.text();
  }
  return out;
}

Json without_name(Json event) {
  event.erase("event");
  return event;
}

}  // namespace

std::string check_csv(const CheckSummary& summary) {
  std::string out;
  for (const char* title : kColumns) out += (out.empty() ? "" : ",") + std::string(title);
  out += "\r\n";
  for (const CheckedFrame& frame : summary.listed()) {
    if (!frame.step.event.is_null()) out += step_lines(frame.step);
    if (!frame.here.event.is_null()) out += frame_lines(frame.here.event);
  }
  return out;
}

Json check_json(const CheckSummary& summary, const std::string& command, const Json& start,
                int exit_code) {
  Json out = {{"schema", "contactcheck-check/1"}, {"command", command}};
  for (const auto& [key, value] : start.items())
    if (key == "frames")
      out["checked_frames"] = value;
    else if (key != "event" && key != "schema" && key != "out")
      out[key] = value;
  Json frames = Json::array(), steps = Json::array();
  for (const CheckedFrame& frame : summary.listed()) {
    if (!frame.step.event.is_null()) steps.push_back(without_name(frame.step.event));
    if (!frame.here.event.is_null()) frames.push_back(without_name(frame.here.event));
  }
  out["frames"] = std::move(frames);
  out["steps"] = std::move(steps);
  out["summary"] = summary.event();
  out["exit_code"] = exit_code;
  return out;
}

}  // namespace contactcheck::check
