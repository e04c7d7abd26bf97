#include "reference/cli/detector_sheet.h"

#include <cstdio>

#include "reference/cli/wrapped_text.h"
#include "reference/text/counted.h"

namespace contactcheck::cli {
namespace {

constexpr std::size_t kIndent = 2, kLabel = 11;  // characters

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

template <typename Items, typename Name>
std::string join(const Items& items, Name&& name, const char* separator = ", ") {
  std::string out;
  for (const auto& item : items) out += (out.empty() ? "" : separator) + std::string(name(item));
  return out;
}

class Sheet {
 public:
  explicit Sheet(std::size_t width) : width_(width) {}

  void title(const std::string& id, const std::string& summary) {
    text_ += id + "\n";
    if (!summary.empty())
      text_ += std::string(kIndent, ' ') + wrapped_text(summary, kIndent, width_);
  }
  void line(const std::string& label, const std::string& value) {
    if (!value.empty()) add(label, wrapped_text(value, kIndent + kLabel + 1, width_));
  }
  /// What is copied, as paths and commands: in one line, however long it is.
  void whole(const std::string& label, const std::string& value) { add(label, value + "\n"); }
  const std::string& text() const { return text_; }

 private:
  void add(std::string label, const std::string& lines) {
    label.resize(kLabel, ' ');
    text_ += std::string(kIndent, ' ') + label + " " + lines;
  }

  std::size_t width_;
  std::string text_;
};

std::string levels_text(const Semantics& s) {
  const auto name = [](Level level) { return name_of(level); };
  if (s.levels.empty()) return "none";
  return join(s.levels, name) + (s.exact ? "; exact: nothing missed, nothing spurious" : "");
}

std::string contact_text(const Semantics& s) {
  std::string text = s.solid ? "of solids: one inside another is in contact" : "of surfaces";
  text += s.closed ? "; touching counts" : "; touching does not count";
  if (s.margin > 0.0) text += "; margin " + number_text(s.margin) + " m, strictly nearer";
  return text;
}

std::string numbers_text(const Semantics& s) {
  std::string text = std::string(name_of(s.precision)) + " precision";
  if (s.local_origin) text += " about a local origin";
  if (s.scale != 1.0) text += ", given at scale " + number_text(s.scale);
  return text;
}

void add_semantics(const Semantics& s, Sheet& sheet) {
  const auto level = [](Level l) { return name_of(l); };
  const auto question = [](Question q) { return name_of(q); };
  sheet.line("claims", levels_text(s));
  sheet.line("informative", join(s.informative, level));
  sheet.line("questions",
             join(s.questions, question) +
                 (s.no_early_end ? "; body without an early end: no speed-up over it" : ""));
  sheet.line("contact", contact_text(s));
  sheet.line("means", s.means);
  sheet.line("numbers", numbers_text(s));
  sheet.line("depth", name_of(s.depth));
}

void add_impacts(const std::vector<ImpactKind>& kinds, Precision precision, Sheet& sheet) {
  sheet.line("queries", join(kinds, [](ImpactKind kind) { return name_of(kind); }) + ", in " +
                            name_of(precision) + " precision");
}

std::string tolerance_text(const ImpactTolerance& tolerance) {
  if (tolerance.absolute == 0 && tolerance.of_start == 0) return "none";
  std::string text;
  if (tolerance.absolute > 0) text = number_text(tolerance.absolute) + " m";
  if (tolerance.of_start > 0)
    text += (text.empty() ? "" : " or ") + number_text(tolerance.of_start) +
            " of the distance at the start";
  return text;
}

std::string allowed_text(const OptionInfo& o) {
  if (!o.choices.empty())
    return join(
        o.choices, [](const std::string& choice) { return choice; }, "|");
  return number_text(o.min) + " to " + number_text(o.max) + (o.integer ? ", whole" : "");
}

void add_options(const std::vector<OptionInfo>& options, const Options& values, Sheet& sheet) {
  const char* label = "options";
  for (const OptionInfo& o : options) {
    const std::string& value = values.at(o.name);
    const std::string other = value == o.default_value ? "" : "; default " + o.default_value;
    sheet.line(label, o.name + "=" + value + " (" + allowed_text(o) + other + "): " + o.help);
    label = "";
  }
}

DetectorSpec with_defaults(const DetectorInfo& info) {
  DetectorSpec spec;
  spec.id = spec.name = info.id;
  for (const OptionInfo& o : info.options) spec.options[o.name] = o.default_value;
  return spec;
}

std::string needs_text(const plugin::Declaration& d) {
  if (d.needs_vertices && d.needs_nodes) return "deformed vertices and lattice nodes";
  if (d.needs_vertices) return "deformed vertices";
  return d.needs_nodes ? "lattice nodes" : "";
}

std::string prepared_text(const plugin::Declaration& d) {
  if (!d.prepares_again) return "";
  return "again for other bodies" +
         (d.warm_up > 0 ? ", warmed up by " + text::counted(d.warm_up, "frame") : "");
}

}  // namespace

std::string detector_sheet(const DetectorInfo& info, std::size_t width) {
  return detector_sheet(info, with_defaults(info), width);
}

std::string detector_sheet(const DetectorInfo& info, const DetectorSpec& spec, std::size_t width) {
  Sheet sheet(width);
  sheet.title(spec.name, info.summary);
  if (info.absent_because.empty()) {
    add_semantics(info.make(spec.options)->semantics(), sheet);
  } else {
    sheet.line("absent", info.absent_because);
  }
  sheet.line("given", info.given);
  add_options(info.options, spec.options, sheet);
  return sheet.text();
}

std::string plugin_sheet(const plugin::Plugin& plugin, const std::vector<OptionInfo>& options,
                         const DetectorSpec& spec, std::size_t width) {
  const plugin::Declaration& declaration = plugin.declaration;
  Sheet sheet(width);
  sheet.title(spec.name, declaration.summary);
  sheet.whole("from", plugin::described(plugin.source));
  sheet.line("version", declaration.version);
  if (declaration.answers_frames()) {
    add_semantics(declaration.semantics, sheet);
    sheet.line("given", needs_text(declaration));
  }
  if (declaration.impacts) {
    const plugin::ImpactClaims& claims = *declaration.impacts;
    add_impacts(claims.kinds, claims.precision, sheet);
    sheet.line("tolerance", tolerance_text(claims.tolerance));
  }
  sheet.line("prepared", prepared_text(declaration));
  add_options(options, spec.options, sheet);
  return sheet.text();
}

std::string impact_sheet(const ImpactDetectorInfo& info, const DetectorSpec& spec,
                         std::size_t width) {
  Sheet sheet(width);
  sheet.title(spec.name, info.summary);
  add_impacts(info.kinds, info.precision, sheet);
  sheet.line("tolerance", tolerance_text(info.make(spec.options)->tolerance()));
  add_options(info.options, spec.options, sheet);
  return sheet.text();
}

}  // namespace contactcheck::cli
