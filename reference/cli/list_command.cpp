#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "core/detect/registry.h"
#include "reference/cli/commands.h"
#include "reference/cli/detector_sheet.h"
#include "reference/cli/own_detectors.h"
#include "reference/cli/wrapped_text.h"
#include "reference/scene/catalogue.h"

namespace contactcheck::cli {
namespace {

constexpr std::size_t kWidth = 100, kNarrowest = 60, kTextColumn = 29;  // characters

// The width of the terminal, at least kNarrowest; 0 for files and pipes.
std::size_t terminal_width() {
  winsize size = {};
  if (isatty(STDOUT_FILENO) == 0 || ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0) return 0;
  return std::max<std::size_t>(size.ws_col == 0 ? kWidth : size.ws_col, kNarrowest);
}

// One line each where programs read it; on a terminal what is too long goes on below.
void print_entry(const std::string& id, const std::string& text) {
  const std::size_t terminal = terminal_width();
  const std::size_t width = terminal > 0 ? terminal : std::numeric_limits<std::size_t>::max();
  std::printf("  %-26s %s", id.c_str(), wrapped_text(text, kTextColumn, width).c_str());
}

void print_entries(const char* title, const std::vector<scene::CatalogueEntry>& entries) {
  std::printf("%s\n", title);
  for (const scene::CatalogueEntry& e : entries) print_entry(e.id, e.title);
}

void print_lines(const DetectorCatalog& catalog) {
  std::printf("Detectors (options and claims: contactcheck list --detectors)\n");
  for (const DetectorInfo& info : catalog.all()) {
    const std::string note =
        info.absent_because.empty() ? "" : " [absent: " + info.absent_because + "]";
    print_entry(info.id, info.summary + note);
  }
  std::printf("\nDetectors of queries (contactcheck queries)\n");
  for (const ImpactDetectorInfo& info : catalog.impact_detectors())
    print_entry(info.id, info.summary);
}

std::size_t sheet_width() {
  const std::size_t terminal = terminal_width();
  return terminal > 0 ? std::min(terminal, kWidth) : kWidth;
}

void print_sheets(const DetectorCatalog& catalog) {
  std::printf("Detectors (ID[:option=value,...]; everything as with the default options)\n");
  for (const DetectorInfo& info : catalog.all())
    std::printf("\n%s", detector_sheet(info, sheet_width()).c_str());
  std::printf("\nDetectors of queries (contactcheck queries)\n");
  for (const ImpactDetectorInfo& info : catalog.impact_detectors())
    std::printf("\n%s", impact_sheet(info, catalog.parse_impact(info.id), sheet_width()).c_str());
}

// One from outside stands in the catalogue too, but what that holds would load or start it here.
std::string sheet_of(const DetectorSpec& spec, const OwnDetectors& own) {
  const DetectorInfo* const info = own.catalog.find(spec.id);
  const ImpactDetectorInfo* const impacts = own.catalog.find_impact(spec.id);
  for (const plugin::Plugin& plugin : own.plugins)
    if (plugin.declaration.id == spec.id)
      return plugin_sheet(plugin, info != nullptr ? info->options : impacts->options, spec,
                          sheet_width());
  return info != nullptr ? detector_sheet(*info, spec, sheet_width())
                         : impact_sheet(*impacts, spec, sheet_width());
}

// A detector of frames, or only of queries.
DetectorSpec parse_any(const DetectorCatalog& catalog, const std::string& name) {
  const std::string id = name.substr(0, name.find(':'));
  const bool queries_alone = catalog.find(id) == nullptr && catalog.find_impact(id) != nullptr;
  return queries_alone ? catalog.parse_impact(name) : catalog.parse(name);
}

// Everything is looked up before anything is printed; what is named twice is printed once.
void print_named(const ListArguments& arguments, const DetectorCatalog& catalog) {
  const OwnDetectors own =
      load_own_detectors(arguments.named, arguments.commands, suite::RunSettings{}, catalog);
  std::set<std::string> names;
  std::vector<std::string> sheets;
  for (const std::string& name : own.names)
    if (const DetectorSpec spec = parse_any(own.catalog, name); names.insert(spec.name).second)
      sheets.push_back(sheet_of(spec, own));
  std::printf(
      "Detectors (with the options that were given; what libraries and commands claim as with "
      "their\n"
      "default options)\n");
  for (const std::string& sheet : sheets) std::printf("\n%s", sheet.c_str());
}

// Blank lines between sections, none before the first.
class Sections {
 public:
  void next() {
    if (!first_) std::printf("\n");
    first_ = false;
  }

 private:
  bool first_ = true;
};

}  // namespace

int list_command(const ListArguments& arguments, const DetectorCatalog& catalog) {
  const auto fixtures = scene::fixtures_directory();
  const bool named = !arguments.named.empty() || !arguments.commands.empty();
  const bool all = !arguments.suites && !arguments.scenes && !arguments.families &&
                   !arguments.detectors && !named;
  Sections sections;
  if (all || arguments.suites) {
    sections.next();
    auto suites = scene::list_suites(fixtures);
    for (const char* rules : {"drawn.json", "drawn-steps.json"})
      suites.push_back(scene::read_entry(fixtures / rules, "rules"));
    std::ranges::sort(suites, {}, &scene::CatalogueEntry::id);
    print_entries("Suites", suites);
  }
  if (all || arguments.scenes) {
    sections.next();
    print_entries("Scenes", scene::list_scenes(fixtures));
  }
  if (arguments.families) {
    sections.next();
    print_entries("Families of hard cases", scene::list_families(fixtures));
    sections.next();
    print_entries("Families over scales", scene::list_scale_families(fixtures));
  }
  if (all || arguments.detectors) {
    sections.next();
    all ? print_lines(catalog) : print_sheets(catalog);
  }
  if (named) {
    sections.next();
    print_named(arguments, catalog);
  }
  return 0;
}

}  // namespace contactcheck::cli
