#include "reference/cli/ab_sides.h"

#include <unistd.h>

#include "core/types/check.h"
#include "reference/cli/own_detectors.h"

namespace contactcheck {
namespace {

namespace fs = std::filesystem;

// A program may lie anywhere: its path alone says nothing, but none is called so.
bool is_library(const std::string& text) { return text.substr(0, text.find(':')).ends_with(".so"); }

AbSide program_side(const char* name, const std::string& text, const AbArguments& arguments) {
  const fs::path program = fs::absolute(text);
  if (!fs::is_regular_file(program) || access(program.c_str(), X_OK) != 0)
    throw InputError(std::string(name) + " \"" + text + "\" is not a program that can be run");
  return {name, program, arguments.detectors};
}

AbSide library_side(const char* name, const std::string& text, const AbArguments& arguments) {
  // A name without a folder is a file here, as for any other library.
  AbSide side = {name, fs::read_symlink("/proc/self/exe"), {text}};
  side.detectors.insert(side.detectors.end(), arguments.detectors.begin(),
                        arguments.detectors.end());
  return side;
}

std::string detector_name(const std::string& library, const DetectorCatalog& catalog) {
  const OwnDetectors own = bring_in({library}, {}, RunSettings{}, catalog);
  return own.catalog.parse(own.names.front()).name;
}

// Rows are compared by their names.
void require_one_detector(const AbArguments& arguments, const DetectorCatalog& catalog) {
  const std::string base = detector_name(arguments.base, catalog),
                    head = detector_name(arguments.head, catalog);
  if (base == head) return;
  throw InputError("base \"" + arguments.base.string() + "\" is the detector \"" + base +
                   "\" and head \"" + arguments.head.string() + "\" is \"" + head +
                   "\"; ab compares two builds of one detector with the same options");
}

}  // namespace

std::vector<AbSide> ab_sides(const AbArguments& arguments, const DetectorCatalog& catalog) {
  const bool of_libraries = is_library(arguments.base);
  if (of_libraries != is_library(arguments.head))
    throw InputError("base \"" + arguments.base.string() + "\" and head \"" +
                     arguments.head.string() +
                     "\" are a library and a program; ab compares two of a kind");
  if (of_libraries) require_one_detector(arguments, catalog);
  const auto side = of_libraries ? library_side : program_side;
  return {side("base", arguments.base, arguments), side("head", arguments.head, arguments)};
}

}  // namespace contactcheck
