// Disagreements as self-contained files: ids, and the vertices as hex floats and as decimals.
#pragma once

#include <filesystem>
#include <string>

#include "reference/judge/judge.h"
#include "reference/judge/judged_scene.h"

namespace contactcheck::suite {

/// Writes what is needed to look at a disagreement without the scene: level, kind, frame, and for
/// pairs of triangles, the six deformed vertices bit for bit; for pairs of cells, the mapped nodes;
/// for a vertex, its place. `..._decimal` repeats hex floats for people. `recording`: the path of
/// the scene's recording from the folder where the case will lie, which `contactcheck reduce` finds
/// the whole frame with; empty where there is none.
void write_case(const std::filesystem::path& file, const judge::JudgedScene& judged,
                const judge::Disagreement& disagreement, const std::string& recording);

/// "0x1.8p+1": reads back as the same double everywhere.
std::string hex_float(double value);

}  // namespace contactcheck::suite
