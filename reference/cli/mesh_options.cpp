#include "reference/cli/mesh_options.h"

#include <CLI/CLI.hpp>
#include <string>

#include "core/types/check.h"
#include "reference/scene/amount.h"
#include "reference/scene/file_text.h"

namespace contactcheck {
namespace {

constexpr double kLargestSize = 1e6;  // metres, as in scene files

std::optional<double> size_of(const std::string& text) {
  if (text == "file") return std::nullopt;
  const std::optional<double> size = parse_double(text);
  if (!size || !(*size > 0.0) || !(*size <= kLargestSize))
    throw InputError("--size: " + in_quotes(text) +
                     " is neither \"file\" nor a number of metres above 0, at most 1000000");
  return size;
}

std::string motions_help() {
  std::string out = "how they meet (default approach):";
  for (const NamedMotion& motion : named_motions())
    out += std::string(&motion == &named_motions().front() ? " " : "; ") + motion.name + ": " +
           motion.says;
  return out;
}

}  // namespace

void add_mesh_options(CLI::App& run, RunArguments& arguments) {
  MeshSceneRequest& request = arguments.meshes;
  CLI::Option* mesh =
      run.add_option_function<std::vector<std::string>>(
             "--mesh",
             [&request](const std::vector<std::string>& files) {
               request.meshes.assign(files.begin(), files.end());
             },
             "a mesh file (OBJ, PLY, OFF, STL, others through assimp), twice or more: they "
             "become a scene, each in a lattice of about 150 kept cells, beside the targets or "
             "alone; 2 s, 60 frames unless --frames says otherwise")
          ->allow_extra_args(false)
          ->type_name("FILE");
  run.add_option("--motion", request.motion, motions_help())->type_name("NAME")->needs(mesh);
  run.add_option_function<std::string>(
         "--size", [&request](const std::string& text) { request.size = size_of(text); },
         "largest side of each mesh in metres (default 1), or file: as it is there")
      ->type_name("METRES")
      ->needs(mesh);
  run.add_option("--save-scene", arguments.save_scene,
                 "keep the scene of the meshes as a scene file, to be edited and run again; a file "
                 "that is there is not written over")
      ->type_name("FILE")
      ->needs(mesh);
}

}  // namespace contactcheck
