#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <limits>

#include "core/detect/registry.h"
#include "reference/cli/commands.h"
#include "reference/cli/detector_sheet.h"
#include "reference/cli/wrapped_text.h"
#include "reference/scene/catalogue.h"

namespace contactcheck {
namespace {

constexpr std::size_t kWidth = 100, kNarrowest = 60, kTextColumn = 29;  // characters

// Of a terminal; 0 for files and pipes.
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

void print_entries(const char* title, const std::vector<CatalogueEntry>& entries) {
  std::printf("%s\n", title);
  for (const CatalogueEntry& e : entries) print_entry(e.id, e.title);
}

void print_lines(const DetectorCatalog& catalog) {
  std::printf("Detectors (options and claims: contactcheck list --detectors)\n");
  for (const DetectorInfo& info : catalog.all()) {
    const std::string note =
        info.absent_because.empty() ? "" : " [absent: " + info.absent_because + "]";
    print_entry(info.id, info.summary + note);
  }
}

void print_sheets(const DetectorCatalog& catalog) {
  std::printf("Detectors (ID[:option=value,...]; everything as with the default options)\n");
  const std::size_t terminal = terminal_width();
  const std::size_t width = terminal > 0 ? std::min(terminal, kWidth) : kWidth;
  for (const DetectorInfo& info : catalog.all())
    std::printf("\n%s", detector_sheet(info, width).c_str());
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
  const auto fixtures = fixtures_directory();
  const bool all =
      !arguments.suites && !arguments.scenes && !arguments.families && !arguments.detectors;
  Sections sections;
  if (all || arguments.suites) {
    sections.next();
    print_entries("Suites", list_suites(fixtures));
  }
  if (all || arguments.scenes) {
    sections.next();
    print_entries("Scenes", list_scenes(fixtures));
  }
  if (arguments.families) {
    sections.next();
    print_entries("Families of hard cases", list_families(fixtures));
  }
  if (all || arguments.detectors) {
    sections.next();
    all ? print_lines(catalog) : print_sheets(catalog);
  }
  return 0;
}

}  // namespace contactcheck
