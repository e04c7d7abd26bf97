// What the paper's readings cost, case by case: approximations of the method, none of them a defect
// of a library. The same counts on every machine.
#include "tests/conformance/known_deviations.h"

namespace contactcheck::test {
namespace {

const DetectorNames kPaper = {"ffd-aabb", "ffd-aabb-sphere", "ffd-aabb-sphere2",
                              "ffd-aabb-sphereN"};
const DetectorNames kPaperSpheres = {"ffd-aabb-sphere", "ffd-aabb-sphere2", "ffd-aabb-sphereN"};
const DetectorNames kPaperTriangles = {"ffd-aabb-sphere2+tri:bounds=paper"};
const DetectorNames kSafeCells = {"ffd-aabb-sphere2:bounds=safe", "ffd-aabb:bounds=safe"};
const DetectorNames kGrid = {"ffd-grid"};
const DetectorNames kSmallerSpheres = {"ffd-aabb-sphere2+tri:radius=0.8"};
const DetectorNames kOtherSpheres = {"ffd-aabb-sphere2+tri:radius=0.8",
                                     "ffd-aabb-sphere2+tri:radius=1.25"};
const DetectorNames kSingleFamily = {"ffd-aabb-sphere2+tri:precision=single"};
const DetectorNames kSingle = {"ffd-aabb-sphere2+tri:precision=single", "ffd-lazy:precision=single",
                               "full-refit:precision=single", "bd-tree:precision=single"};

const DetectorNames kFamily = {"ffd-grid",
                               "ffd-aabb",
                               "ffd-aabb-sphere",
                               "ffd-aabb-sphere2",
                               "ffd-aabb-sphereN",
                               "ffd-grid+tri",
                               "ffd-aabb+tri",
                               "ffd-aabb-sphere+tri",
                               "ffd-aabb-sphere2+tri",
                               "ffd-aabb-sphereN+tri"};

const Origin kHash = {"contactcheck", "bounds=paper", "Jeon et al. 2013, hashing of nodes"};
const Origin kSphere = {"contactcheck", "bounds=paper", "Jeon et al. 2013, \"original radius\""};
const Origin kSmaller = {"contactcheck", "radius below 1", "the option's own words"};
const Origin kBox = {"contactcheck", "any bounds", "Jeon et al. 2013, node against plane"};
const Origin kCell = {"contactcheck", "any bounds", "Jeon et al. 2013, traditional FFD"};

const Origin kFloats = {"contactcheck", "precision=single", "vertices rounded to floats"};

const char* const kNoCommonBucket =
    "a box is hashed into the buckets of its eight nodes, and only nodes are tested: what meets "
    "between the nodes is not found";
const char* const kRadiusOfRest =
    "spheres keep the radius of rest when the nodes between them are pulled away";
const char* const kTooSmall =
    "spheres a fifth smaller than what they hold do not meet where their corners touch";
const char* const kFlatBoxes =
    "the faces at the rim of a box without thickness have no plane, so it has no end there";
const char* const kCellsMeet = "a lattice cell is wider than the surface inside it";

std::vector<KnownDeviation> refused() {
  return {{kFamily + kPaperTriangles + kSafeCells + kOtherSpheres + kSingleFamily,
           "refused",
           {{"rebuilt-structure", 1}},
           {"contactcheck", "any bounds", "FfdDetector::prepare"},
           "the family lives in lattices and refuses bodies without one"},
          {{"bd-tree", "bd-tree:bound=paper", "bd-tree:precision=single"},
           "refused",
           {{"rebuilt-structure", 1}},
           {"contactcheck", "any options", "James and Pai 2004, reduced coordinates"},
           "the lattice nodes are its reduced coordinates: a body without a lattice has none"}};
}

std::vector<KnownDeviation> missed() {
  return {
      {kPaper + kPaperTriangles,
       "body missed",
       {{"touching-vertex-face", 1},
        {"coplanar-overlap", 1},
        {"crossing", 2},
        {"eight-identical-spread", 12},
        {"two-components", 1},
        {"inside-out", 1},
        {"triangles-of-a-centimetre", 1},
        {"a-millimetre-wide", 1},
        {"a-micrometre-wide", 1},
        {"a-thousand-kilometres-wide", 1},
        {"touching-far-from-the-origin", 1}},
       kHash,
       kNoCommonBucket},
      {kPaper,
       "cell missed",
       {{"touching-vertex-face", 4},
        {"coplanar-overlap", 51},
        {"crossing", 88},
        {"eight-identical-spread", 144},
        {"two-components", 10},
        {"inside-out", 22},
        {"triangles-of-a-centimetre", 36},
        {"a-millimetre-wide", 36},
        {"a-micrometre-wide", 36},
        {"a-thousand-kilometres-wide", 36},
        {"touching-far-from-the-origin", 51}},
       kHash,
       kNoCommonBucket},
      {kPaperTriangles,
       "triangle missed",
       {{"moving", 6},
        {"touching-vertex-face", 4},
        {"coplanar-overlap", 51},
        {"crossing", 88},
        {"eight-identical-spread", 144},
        {"two-components", 10},
        {"inside-out", 22},
        {"triangles-of-a-centimetre", 36},
        {"a-millimetre-wide", 36},
        {"a-micrometre-wide", 36},
        {"a-thousand-kilometres-wide", 36},
        {"touching-far-from-the-origin", 51}},
       kHash,
       kNoCommonBucket},
      {kPaper,
       "box missed",
       {{"touching-vertex-face", 40},
        {"coplanar-overlap", 100},
        {"crossing", 68},
        {"containment", 112},
        {"diagonal-neighbours", 67},
        {"eight-identical-spread", 628},
        {"zero-area-triangles", 15},
        {"isolated-vertex", 13},
        {"open-mesh", 78},
        {"two-components", 58},
        {"inside-out", 36},
        {"triangles-of-a-centimetre", 17},
        {"a-millimetre-wide", 17},
        {"a-micrometre-wide", 17},
        {"a-thousand-kilometres-wide", 17},
        {"touching-far-from-the-origin", 100}},
       kHash,
       kNoCommonBucket},
  };
}

// Spheres lose some more than the hash.
std::vector<KnownDeviation> missed_in_motion() {
  return {
      {kGrid, "cell missed", {{"moving", 74}}, kHash, kNoCommonBucket},
      {{"ffd-aabb", "ffd-aabb-sphere"}, "cell missed", {{"moving", 122}}, kHash, kNoCommonBucket},
      {{"ffd-aabb-sphere2"}, "cell missed", {{"moving", 126}}, kHash, kNoCommonBucket},
      {{"ffd-aabb-sphereN"}, "cell missed", {{"moving", 125}}, kHash, kNoCommonBucket},
      {{"ffd-aabb", "ffd-aabb-sphere"}, "box missed", {{"moving", 351}}, kHash, kNoCommonBucket},
      {{"ffd-aabb-sphere2"}, "box missed", {{"moving", 352}}, kHash, kNoCommonBucket},
      {{"ffd-aabb-sphereN"}, "box missed", {{"moving", 353}}, kHash, kNoCommonBucket},
      {kPaperTriangles, "body missed", {{"moving", 1}}, kHash, kNoCommonBucket},
  };
}

std::vector<KnownDeviation> missed_by_spheres() {
  return {
      {kPaperSpheres + kPaperTriangles,
       "body missed",
       {{"long-triangles", 1}},
       kSphere,
       kRadiusOfRest},
      {kPaperSpheres, "cell missed", {{"long-triangles", 6}}, kSphere, kRadiusOfRest},
      {kPaperTriangles, "triangle missed", {{"long-triangles", 6}}, kSphere, kRadiusOfRest},
      {kPaperSpheres, "box missed", {{"long-triangles", 48}}, kSphere, kRadiusOfRest},
      {kSmallerSpheres, "body missed", {{"touching-vertex-vertex", 1}}, kSmaller, kTooSmall},
      {kSmallerSpheres, "triangle missed", {{"touching-vertex-vertex", 16}}, kSmaller, kTooSmall},
  };
}

std::vector<KnownDeviation> spurious_of_paper() {
  return {
      {kPaper,
       "body spurious",
       {{"moving", 1},
        {"containment", 1},
        {"open-mesh", 1},
        {"two-components", 1},
        {"isolated-vertex", 1}},
       kBox,
       kBoxesMeet},
      {kPaper, "body spurious", {{"gap-of-a-billionth", 1}}, kBox, kFlatBoxes},
      {kPaper,
       "cell spurious",
       {{"moving", 119},
        {"coincident", 8},
        {"coincident-balls", 8},
        {"containment", 86},
        {"isolated-vertex", 8},
        {"open-mesh", 88},
        {"two-components", 16}},
       kBox,
       kBoxesMeet},
      {kPaper, "cell spurious", {{"gap-of-a-billionth", 336}}, kBox, kFlatBoxes},
      {kPaper, "self-cell spurious", {{"containment", 184}, {"open-mesh", 32}}, kBox, kFlatBoxes},
      {kPaper,
       "box spurious",
       {{"moving", 1},
        {"containment", 18},
        {"gap-of-a-billionth", 336},
        {"zero-area-triangles", 26},
        {"isolated-vertex", 29},
        {"open-mesh", 62}},
       kBox,
       kFlatBoxes},
  };
}

std::vector<KnownDeviation> spurious_of_safe() {
  return {
      {kSafeCells,
       "self-cell spurious",
       {{"moving", 220},
        {"touching-vertex-vertex", 4},
        {"touching-vertex-face", 8},
        {"touching-edge-edge", 2},
        {"far-apart", 2},
        {"diagonal-neighbours", 4},
        {"zero-area-triangles", 4},
        {"isolated-vertex", 4},
        {"open-mesh", 4},
        {"two-components", 4},
        {"long-triangles", 8}},
       kBox,
       kBoxesMeet},
      {kSafeCells,
       "body spurious",
       {{"moving", 2},
        {"containment", 1},
        {"open-mesh", 1},
        {"two-components", 1},
        {"diagonal-neighbours", 1},
        {"eight-identical-spread", 2}},
       kBox,
       kBoxesMeet},
      {kSafeCells,
       "cell spurious",
       {{"moving", 533},
        {"crossing", 19},
        {"coincident-balls", 8},
        {"containment", 17},
        {"diagonal-neighbours", 14},
        {"eight-identical-spread", 2},
        {"open-mesh", 3},
        {"two-components", 19},
        {"long-triangles", 10},
        {"triangles-of-a-centimetre", 6},
        {"a-millimetre-wide", 6},
        {"a-micrometre-wide", 6},
        {"a-thousand-kilometres-wide", 6}},
       kBox,
       kBoxesMeet},
      {{"ffd-aabb:bounds=safe"}, "body spurious", {{"isolated-vertex", 1}}, kBox, kBoxesMeet},
      {{"ffd-aabb:bounds=safe"}, "cell spurious", {{"isolated-vertex", 2}}, kBox, kBoxesMeet},
  };
}

std::vector<KnownDeviation> spurious_of_grid() {
  return {
      {kGrid,
       "body spurious",
       {{"moving", 2},
        {"containment", 1},
        {"open-mesh", 1},
        {"two-components", 1},
        {"coplanar-apart", 1},
        {"eight-identical-spread", 40},
        {"zero-area-triangles", 1},
        {"triangles-of-a-centimetre", 1},
        {"a-millimetre-wide", 1},
        {"a-micrometre-wide", 1},
        {"a-thousand-kilometres-wide", 1},
        {"touching-far-from-the-origin", 1},
        {"diagonal-neighbours", 1},
        {"gap-of-a-billionth", 1},
        {"isolated-vertex", 1}},
       kCell,
       kCellsMeet},
      {kGrid,
       "cell spurious",
       {{"moving", 468},
        {"touching-vertex-face", 36},
        {"coplanar-overlap", 18},
        {"crossing", 194},
        {"coincident", 8},
        {"coincident-balls", 104},
        {"containment", 106},
        {"coplanar-apart", 300},
        {"diagonal-neighbours", 219},
        {"gap-of-a-billionth", 300},
        {"eight-identical-spread", 4108},
        {"zero-area-triangles", 67},
        {"isolated-vertex", 103},
        {"open-mesh", 80},
        {"two-components", 114},
        {"long-triangles", 24},
        {"inside-out", 35},
        {"triangles-of-a-centimetre", 166},
        {"a-millimetre-wide", 166},
        {"a-micrometre-wide", 166},
        {"a-thousand-kilometres-wide", 166},
        {"touching-far-from-the-origin", 165}},
       kCell,
       kCellsMeet},
  };
}

// Edges that cross within rounding: the truth is that of rounded vertices, the detector rounds
// nodes. (Those that are fed rounded vertices lose nothing.)
std::vector<KnownDeviation> of_single_precision() {
  const char* const kRounding = "triangles meet or part within the rounding of floats";
  return {
      {kSingle, "triangle missed", {{"crossing", 2}}, kFloats, kRounding},
      {kSingle, "triangle spurious", {{"crossing", 2}}, kFloats, kRounding},
  };
}

}  // namespace

std::vector<KnownDeviation> known_deviations_of_core() {
  std::vector<KnownDeviation> all;
  for (const auto& part :
       {refused(), missed(), missed_in_motion(), missed_by_spheres(), spurious_of_paper(),
        spurious_of_safe(), spurious_of_grid(), of_single_precision()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace contactcheck::test
