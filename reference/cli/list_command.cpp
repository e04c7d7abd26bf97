#include <cstdio>

#include "core/detect/registry.h"
#include "reference/adapters/register.h"
#include "reference/cli/commands.h"
#include "reference/scene/catalogue.h"

namespace contactcheck {
namespace {

void print_entries(const char* title, const std::vector<CatalogueEntry>& entries) {
  std::printf("%s\n", title);
  for (const CatalogueEntry& e : entries)
    std::printf("  %-26s %s\n", e.id.c_str(), e.title.c_str());
  std::printf("\n");
}

std::string allowed(const OptionInfo& option) {
  if (option.choices.empty()) return "";
  std::string text;
  for (const std::string& choice : option.choices) text += (text.empty() ? "" : "|") + choice;
  return " (" + text + ")";
}

void print_detector(const DetectorInfo& info) {
  const std::string note =
      info.absent_because.empty() ? "" : "  [absent: " + info.absent_because + "]";
  std::printf("  %-26s %s%s\n", info.id.c_str(), info.summary.c_str(), note.c_str());
  for (const OptionInfo& o : info.options)
    std::printf("  %-26s   :%s=%s%s  %s\n", "", o.name.c_str(), o.default_value.c_str(),
                allowed(o).c_str(), o.help.c_str());
}

}  // namespace

int list_command() {
  const auto fixtures = fixtures_directory();
  print_entries("Suites", list_suites(fixtures));
  print_entries("Scenes", list_scenes(fixtures));
  DetectorCatalog catalog;
  register_core_detectors(catalog);
  register_reference_detectors(catalog);
  std::printf("Detectors (ID[:option=value,...]; options show their defaults)\n");
  for (const DetectorInfo& info : catalog.all()) print_detector(info);
  return 0;
}

}  // namespace contactcheck
