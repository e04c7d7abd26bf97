/* The C interface of collision detectors that contactcheck loads from a shared library:
 *
 *     contactcheck run --detector ./libmine.so
 *     contactcheck run --detector ./libmine.so:leaf=8
 *     contactcheck queries vf.csv --detector ./libmine.so
 *
 * This header is all that a plug-in needs; it is plain C11 and C++. A plug-in is a shared library
 * that exports contactcheck_plugin_entry(), which gives a table of functions. README.md beside this
 * header begins with an example of a dozen lines; tests/examples/c-plugin is a whole detector.
 *
 * Rules
 * - Lengths are metres, times seconds; coordinates are x, y, z, one after the other.
 * - Every pointer that the host passes is the host's. Bodies (and all they point to) live until
 *   destroy(); a frame and its arrays until the next update().
 * - Calls of one detector come one at a time, in the order create, declare, prepare, declare, then
 *   per frame update and one or several query; frames come in any order and repeat. An answer may
 *   not depend on frames before it. A detector that is asked about moving elements gets create,
 *   declare_impacts, then impact as often as wanted; nothing else.
 * - The plug-in runs in a worker process: a crash, a hang or a memory limit ends its own row, no
 *   other.
 */
#ifndef CONTACTCHECK_PLUGIN_H
#define CONTACTCHECK_PLUGIN_H

#include <stddef.h>
#include <stdint.h>

/* The names of C and of the interface: no style of C++ may rename them.
 * NOLINTBEGIN(readability-identifier-naming) */
#ifdef __cplusplus
extern "C" {
#endif

/* Grows with every change of this header. What an earlier version has stays where it is, and the
 * table grows at its end: a library that was built with an earlier version, without what is said to
 * be there since a later one, is loaded as before; one of a version yet to come is refused. */
#define CONTACTCHECK_PLUGIN_ABI 4u

/* What a function gives back. With anything but OK it should have put a sentence (UTF-8, ended by
 * a zero byte) into `message`, which has room for CONTACTCHECK_MESSAGE_SIZE bytes. */
enum {
  CONTACTCHECK_OK = 0,
  CONTACTCHECK_ERROR = 1,  /* the row becomes `error` */
  CONTACTCHECK_REFUSED = 2 /* the row becomes `refused`: input that it must not answer */
};
#define CONTACTCHECK_MESSAGE_SIZE 512u

/* ---- what a detector claims -------------------------------------------------------------- */

/* Levels of contact, as bits. */
enum {
  CONTACTCHECK_LEVEL_BODY = 1 << 0,        /* pairs of bodies whose surfaces share a point */
  CONTACTCHECK_LEVEL_CONTAINMENT = 1 << 1, /* a part inside a solid, surfaces apart */
  CONTACTCHECK_LEVEL_CELL = 1 << 2,        /* pairs of lattice cells, by the triangles in them */
  CONTACTCHECK_LEVEL_BOX = 1 << 3,         /* pairs of mapped FFD-AABBs; reported as cells */
  CONTACTCHECK_LEVEL_TRIANGLE = 1 << 4,    /* pairs of triangles that share a point */
  CONTACTCHECK_LEVEL_VERTEX = 1 << 5,      /* vertices strictly inside another solid */
  CONTACTCHECK_LEVEL_NEAR = 1 << 6,        /* vertices nearer to triangles than the margin */
  /* Since version 3, of a body with itself: pairs of its triangles by the vertices they share. */
  CONTACTCHECK_LEVEL_SELF = 1 << 7,        /* none: they share a point */
  CONTACTCHECK_LEVEL_SELF_VERTEX = 1 << 8, /* one: they share more than that corner */
  CONTACTCHECK_LEVEL_SELF_EDGE = 1 << 9,   /* two: they share more than the edge between */
  CONTACTCHECK_LEVEL_SELF_BODY = 1 << 10,  /* bodies with any of the three */
  CONTACTCHECK_LEVEL_SELF_CELL = 1 << 11,  /* cells that share no node, by the triangles in them */
  CONTACTCHECK_LEVEL_SELF_NEAR = 1 << 12   /* a vertex nearer than the margin to a triangle that
                                              uses neither it nor one that is welded to it */
};

/* What query() is asked. */
enum {
  CONTACTCHECK_ASK_TRIANGLES = 0, /* all pairs of intersecting triangles */
  CONTACTCHECK_ASK_BODY = 1,      /* pairs of bodies in contact; early-out allowed */
  CONTACTCHECK_ASK_CELLS = 2,     /* all pairs of colliding cells */
  CONTACTCHECK_ASK_CONTACTS = 3,  /* all contacts, with depth and normal */
  CONTACTCHECK_ASK_SELF = 4       /* all contacts of bodies with themselves; since version 3 */
};

enum { CONTACTCHECK_DOUBLE = 0, CONTACTCHECK_SINGLE = 1 };
enum {
  CONTACTCHECK_DEPTH_NONE = 0,
  CONTACTCHECK_DEPTH_VERTEX_SURFACE = 1, /* of a vertex: how far it has to go */
  CONTACTCHECK_DEPTH_CONVEX_PAIR = 2     /* of two triangles or boxes: how to part them */
};

/* Claim what is true: what is claimed is judged, what is not is not. The host hands it over zeroed,
 * but for touching_counts = 1, scale = 1 and needs_vertices = 1. */
typedef struct contactcheck_semantics {
  uint32_t levels;         /* bits; claimed, judged and gated */
  uint32_t informative;    /* bits; shown, no claim */
  uint32_t question_count; /* 1 to 4 */
  uint32_t questions[4];   /* all different; the first one is the detector's own */
  uint32_t solid;          /* 1: a part inside another body is in contact */
  uint32_t touching_counts;
  uint32_t exact;     /* 1: no miss and nothing spurious at the levels claimed, ever */
  uint32_t precision; /* CONTACTCHECK_DOUBLE or _SINGLE */
  uint32_t depth_kind;
  uint32_t whole_cells;    /* its cells are the whole deformed cells, not their FFD-AABBs */
  uint32_t needs_vertices; /* 0: frames come without vertices, nodes are all it reads */
  double margin;           /* metres; with LEVEL_NEAR: strictly nearer than this; else 0 */
  double scale;            /* with _SINGLE it computes with (float)(scale * x); else 1 */
  const char* means;       /* what it calls contact, where that is something else; or NULL */
} contactcheck_semantics;

/* An option: a word out of `choices`, or, without choices, a number from `min` to `max`. */
typedef struct contactcheck_option {
  const char* name; /* letters, digits, '-', '_', '.' */
  const char* default_value;
  const char* help;
  const char* const* choices; /* ended by NULL; NULL: a number */
  double min, max;
  uint32_t integer; /* 1: a whole number */
  uint32_t reserved;
} contactcheck_option;

/* An option's value for this detector, checked: whole numbers as digits, others in their shortest
 * form (1e+06), which strtod reads. */
typedef struct contactcheck_setting {
  const char* name;
  const char* value;
} contactcheck_setting;

/* ---- what a detector is given ------------------------------------------------------------ */

/* A free-form-deformation lattice. A vertex lies in its home cell at local coordinates (s, t, u);
 * it is mapped by blending the cell's eight nodes, first along s, then t, then u, each time as
 * a * (1 - w) + b * w without fused operations: then the bits are those of `vertices`. */
typedef struct contactcheck_lattice {
  uint32_t node_count, cell_count;
  const double* rest_nodes;    /* 3 per node */
  const uint32_t* cell_nodes;  /* 8 per cell; bit k of the corner: the high end of axis k */
  const uint32_t* home_cell;   /* 1 per vertex */
  const double* local;         /* 3 per vertex, in [0, 1] */
  const uint32_t* label_begin; /* triangle_count + 1 */
  const uint32_t* label_cells; /* cells that triangle t met at rest: label_begin[t] to [t + 1] */
} contactcheck_lattice;

typedef struct contactcheck_body {
  const char* name;
  uint32_t vertex_count, triangle_count;
  const double* vertices;              /* at rest, 3 per vertex */
  const uint32_t* triangles;           /* 3 per triangle, counter-clockwise from outside; of a
                                          welded mesh, one number for all vertices at one place */
  const contactcheck_lattice* lattice; /* NULL: nodes are vertices */
} contactcheck_body;

typedef struct contactcheck_body_state {
  const double* nodes;    /* 3 per lattice node; without a lattice 3 per vertex */
  const double* vertices; /* deformed, 3 per vertex; NULL when needs_vertices is 0 */
} contactcheck_body_state;

/* All numbers are finite. */
typedef struct contactcheck_frame {
  uint64_t index;
  double time;
  uint32_t body_count;
  uint32_t reserved;
  const contactcheck_body_state* bodies;
} contactcheck_frame;

/* ---- what a detector answers ------------------------------------------------------------- */

typedef struct contactcheck_body_pair {
  uint32_t a, b;
} contactcheck_body_pair;

/* Triangle (or cell) a of body_a with b of body_b, in either order. */
typedef struct contactcheck_element_pair {
  uint32_t body_a, body_b, a, b;
} contactcheck_element_pair;

typedef struct contactcheck_vertex_in_body {
  uint32_t body, in, vertex;
  uint32_t reserved;
} contactcheck_vertex_in_body;

typedef struct contactcheck_near_pair {
  uint32_t body, other, vertex, triangle; /* a vertex of body, a triangle of other */
} contactcheck_near_pair;

typedef struct contactcheck_piece_contact {
  contactcheck_element_pair pieces;
  double depth;     /* metres, at least 0 */
  double normal[3]; /* unit; moving piece b by depth * normal parts them */
} contactcheck_piece_contact;

typedef struct contactcheck_vertex_contact {
  contactcheck_vertex_in_body where;
  double depth;
  double normal[3]; /* unit; moving the vertex by depth * normal takes it out */
} contactcheck_vertex_contact;

/* Where query() puts its answer: each function appends `count` items, as often as wanted, in any
 * order; repeats are allowed. Pass `host` on. A pair of elements implies its pair of bodies.
 * Questions: TRIANGLES wants triangles; BODY bodies; CELLS cells; CONTACTS piece_contacts or
 * vertex_contacts, by the kind of depth; SELF triangles whose two bodies are the same (or cells,
 * near pairs, or bodies, a body with itself), those of all classes that are claimed, two triangles
 * with the same three vertices left out. Vertices and near pairs of two bodies go with the
 * detector's first question that is not BODY or SELF (with BODY where it answers nothing else). */
typedef struct contactcheck_answer {
  void* host;
  void (*bodies)(void* host, const contactcheck_body_pair* items, size_t count);
  void (*triangles)(void* host, const contactcheck_element_pair* items, size_t count);
  void (*cells)(void* host, const contactcheck_element_pair* items, size_t count);
  void (*vertices)(void* host, const contactcheck_vertex_in_body* items, size_t count);
  void (*near_pairs)(void* host, const contactcheck_near_pair* items, size_t count);
  void (*piece_contacts)(void* host, const contactcheck_piece_contact* items, size_t count);
  void (*vertex_contacts)(void* host, const contactcheck_vertex_contact* items, size_t count);
} contactcheck_answer;

/* ---- what a detector tells of its work (since version 2) --------------------------------- */

/* What a stage still covers. The host finds out which true pairs of triangles a stage lost: those
 * that everything before it covers and it does not. */
enum {
  CONTACTCHECK_COVERS_BODIES = 0,      /* all pairs of triangles of these pairs of bodies */
  CONTACTCHECK_COVERS_LABEL_CELLS = 1, /* those that met these pairs of cells at rest (labels) */
  CONTACTCHECK_COVERS_OWNER_CELLS = 2, /* those whose owner cells are these pairs; see owners() */
  CONTACTCHECK_COVERS_TRIANGLES = 3    /* these pairs of triangles */
};

/* A stage of the last updated frame: "sphere tree", "boxes", "triangles". */
typedef struct contactcheck_stage {
  const char* name;         /* one line, 64 bytes at most */
  const char* unit;         /* what `in` and `out` count: "node pairs"; likewise */
  uint64_t in, out;         /* how many came in and how many are left; up to 1e10 each */
  uint64_t visited;         /* how many it looked at on the way, where it counts them; likewise */
  const char* visited_unit; /* what it looked at; NULL: not counted */
  uint32_t covers;          /* CONTACTCHECK_COVERS_... */
  uint32_t reserved;
  uint64_t count;                         /* of the list below */
  const contactcheck_body_pair* bodies;   /* with COVERS_BODIES */
  const contactcheck_element_pair* pairs; /* with the others */
} contactcheck_stage;

/* Where trace() puts its stages: stage() once for each, in the order in which they work, the same
 * stages in every frame. owners() before or after, for each body, where a stage covers owner cells:
 * the one cell that each triangle belongs to. Lists are copied. */
typedef struct contactcheck_trace {
  void* host;
  void (*stage)(void* host, const contactcheck_stage* stage);
  void (*owners)(void* host, uint32_t body, const uint32_t* cell_of_triangle, size_t count);
} contactcheck_trace;

/* Where counts() puts its numbers: add() once for each name (letters, digits, '-', '_', '.', 64 at
 * most: "leaves_mapped"), the same names in every frame; values up to 1e10. */
typedef struct contactcheck_counts {
  void* host;
  void (*add)(void* host, const char* name, uint64_t value);
} contactcheck_counts;

/* ---- contact between frames (since version 4) -------------------------------------------- */

/* Every point moves straight, at constant speed, from its place at t = 0 to that at t = 1: t is a
 * fraction of the step. Elements are closed, so touching counts; a degenerate triangle or edge is
 * the segment or the point that it is at that time. */

/* Kinds of elements that may meet, as bits. */
enum { CONTACTCHECK_VERTEX_FACE = 1 << 0, CONTACTCHECK_EDGE_EDGE = 1 << 1 };

/* Levels of contact within a step, as bits. */
enum {
  CONTACTCHECK_IMPACT_VERTEX_FACE = 1 << 0,      /* a vertex and a triangle of two bodies */
  CONTACTCHECK_IMPACT_EDGE_EDGE = 1 << 1,        /* an edge of each of two bodies */
  CONTACTCHECK_IMPACT_TRIANGLE = 1 << 2,         /* triangles of two bodies */
  CONTACTCHECK_IMPACT_BODY = 1 << 3,             /* bodies whose surfaces meet */
  CONTACTCHECK_IMPACT_SELF_VERTEX_FACE = 1 << 4, /* of one body, without a common vertex */
  CONTACTCHECK_IMPACT_SELF_EDGE_EDGE = 1 << 5
};

/* What is claimed about moving elements. The host hands it over zeroed. The tolerance is what the
 * detector calls contact although nothing meets: elements that come as near as the larger of
 * `tolerance` and `tolerance_of_start` times their distance at t = 0. A report within it is counted
 * apart from spurious ones. */
typedef struct contactcheck_impact_semantics {
  uint32_t kinds;     /* bits of the kinds that impact() answers; 0: none */
  uint32_t levels;    /* bits of the levels that step() reports; 0: none */
  uint32_t precision; /* CONTACTCHECK_DOUBLE or _SINGLE: floats of the coordinates */
  uint32_t reserved;
  double tolerance;          /* metres */
  double tolerance_of_start; /* a factor */
} contactcheck_impact_semantics;

/* One vertex and one triangle (vertex first), or two edges (one after the other): four points. */
typedef struct contactcheck_impact_query {
  uint32_t kind; /* one of the bits */
  uint32_t reserved;
  double start[12]; /* at t = 0; x, y, z of the four points */
  double end[12];   /* at t = 1 */
} contactcheck_impact_query;

/* What a report has beside the contact, as bits. */
enum { CONTACTCHECK_HAS_TIME = 1 << 0, CONTACTCHECK_HAS_TOLERANCE = 1 << 1 };

/* The host hands it over zeroed: no contact. */
typedef struct contactcheck_impact {
  uint32_t contact; /* 1: they meet at some t in [0, 1] */
  uint32_t has;     /* bits */
  double time;      /* with HAS_TIME: of the first contact, in [0, 1] */
  double tolerance; /* with HAS_TOLERANCE: that of this report in metres, instead of the declared
                     * ones; of a query alone: in a step the declared ones count */
} contactcheck_impact;

/* All bodies over a step. The arrays live until step() returns. */
typedef struct contactcheck_step {
  uint64_t index; /* of the frame at t = 0 */
  double start_time, end_time;
  uint32_t body_count;
  uint32_t reserved;
  const contactcheck_body_state* start;
  const contactcheck_body_state* end;
} contactcheck_step;

typedef struct contactcheck_body_impact {
  contactcheck_body_pair bodies;
  contactcheck_impact impact;
} contactcheck_body_impact;

typedef struct contactcheck_triangle_impact {
  contactcheck_element_pair triangles;
  contactcheck_impact impact;
} contactcheck_triangle_impact;

typedef struct contactcheck_vertex_face_impact {
  contactcheck_near_pair where;
  contactcheck_impact impact;
} contactcheck_vertex_face_impact;

typedef struct contactcheck_edge_edge_impact {
  uint32_t body_a, body_b;
  uint32_t a[2], b[2]; /* vertices of the edges, in either order */
  contactcheck_impact impact;
} contactcheck_edge_edge_impact;

/* Where step() puts its reports; as contactcheck_answer. */
typedef struct contactcheck_step_answer {
  void* host;
  void (*bodies)(void* host, const contactcheck_body_impact* items, size_t count);
  void (*triangles)(void* host, const contactcheck_triangle_impact* items, size_t count);
  void (*vertex_faces)(void* host, const contactcheck_vertex_face_impact* items, size_t count);
  void (*edge_edges)(void* host, const contactcheck_edge_edge_impact* items, size_t count);
} contactcheck_step_answer;

/* ---- the table --------------------------------------------------------------------------- */

/* Sizes of all structures of version 1 and of the table, in this order; CONTACTCHECK_STRUCT_SIZES
 * fills them in, and the host refuses a library whose compiler laid them out otherwise. */
#define CONTACTCHECK_STRUCT_COUNT 15
#define CONTACTCHECK_STRUCT_SIZES                                                                \
  {                                                                                              \
    (uint32_t)sizeof(contactcheck_plugin), (uint32_t)sizeof(contactcheck_semantics),             \
        (uint32_t)sizeof(contactcheck_option), (uint32_t)sizeof(contactcheck_setting),           \
        (uint32_t)sizeof(contactcheck_lattice), (uint32_t)sizeof(contactcheck_body),             \
        (uint32_t)sizeof(contactcheck_body_state), (uint32_t)sizeof(contactcheck_frame),         \
        (uint32_t)sizeof(contactcheck_body_pair), (uint32_t)sizeof(contactcheck_element_pair),   \
        (uint32_t)sizeof(contactcheck_vertex_in_body), (uint32_t)sizeof(contactcheck_near_pair), \
        (uint32_t)sizeof(contactcheck_piece_contact),                                            \
        (uint32_t)sizeof(contactcheck_vertex_contact), (uint32_t)sizeof(contactcheck_answer)     \
  }

/* The same of the structures since version 2, for a library that has trace() or counts(). */
#define CONTACTCHECK_TOLD_COUNT 3
#define CONTACTCHECK_TOLD_SIZES                                                 \
  {                                                                             \
    (uint32_t)sizeof(contactcheck_stage), (uint32_t)sizeof(contactcheck_trace), \
        (uint32_t)sizeof(contactcheck_counts)                                   \
  }

/* The same of the structures since version 4, for a library that has declare_impacts(). */
#define CONTACTCHECK_IMPACT_COUNT 9
#define CONTACTCHECK_IMPACT_SIZES                                                                 \
  {                                                                                               \
    (uint32_t)sizeof(contactcheck_impact_semantics), (uint32_t)sizeof(contactcheck_impact_query), \
        (uint32_t)sizeof(contactcheck_impact), (uint32_t)sizeof(contactcheck_step),               \
        (uint32_t)sizeof(contactcheck_body_impact),                                               \
        (uint32_t)sizeof(contactcheck_triangle_impact),                                           \
        (uint32_t)sizeof(contactcheck_vertex_face_impact),                                        \
        (uint32_t)sizeof(contactcheck_edge_edge_impact),                                          \
        (uint32_t)sizeof(contactcheck_step_answer)                                                \
  }

typedef struct contactcheck_plugin {
  uint32_t abi_version; /* CONTACTCHECK_PLUGIN_ABI */
  uint32_t struct_sizes[CONTACTCHECK_STRUCT_COUNT];
  const char* id;      /* letters, digits, '-', '_', '.', 64 at most; no name of a built-in one */
  const char* summary; /* one line; or NULL */
  const char* version; /* one line, for results.json; or NULL */
  const contactcheck_option* options; /* NULL with option_count 0 */
  uint32_t option_count;
  uint32_t reserved;

  /* Makes a detector with a value for every option, in the order of `options`. *detector is passed
   * to all other functions; several detectors may be alive at once. */
  int32_t (*create)(const contactcheck_setting* settings, uint32_t count, void** detector,
                    char* message);
  /* Of what create() made, exactly once; not called where that failed or gave NULL. */
  void (*destroy)(void* detector);
  /* These four are about frames; all are NULL in a detector of moving elements alone (version 4),
   * but for prepare, where it has step(). declare() says what is claimed; asked after create(), and
   * again after prepare(): a scale, and a margin with it, may be taken from the bodies. Anything
   * else that has changed is an error. */
  int32_t (*declare)(void* detector, contactcheck_semantics* semantics, char* message);
  int32_t (*prepare)(void* detector, const contactcheck_body* bodies, uint32_t count,
                     char* message);
  int32_t (*update)(void* detector, const contactcheck_frame* frame, char* message);
  /* Answers a question that was declared, about the frame of the last update. */
  int32_t (*query)(void* detector, uint32_t question, const contactcheck_answer* answer,
                   char* message);

  /* Since version 2. All are optional (NULL), and none is timed. */
  uint32_t told_sizes[CONTACTCHECK_TOLD_COUNT]; /* CONTACTCHECK_TOLD_SIZES; with trace or counts */
  uint32_t reserved_2;
  /* The stages of the frame of the last update, after its queries. */
  int32_t (*trace)(void* detector, const contactcheck_trace* trace, char* message);
  /* What the last update and the query after it took, in units of its own. */
  int32_t (*counts)(void* detector, const contactcheck_counts* counts, char* message);
  /* Its own clock: how many milliseconds (up to 1e9) the last update() or query() took; below 0: it
   * has not measured that one. Shown beside the host's times; speed-ups are made of the host's. */
  double (*own_ms)(void* detector);

  /* Since version 4; optional. declare_impacts() says what is claimed about moving elements. */
  uint32_t impact_sizes[CONTACTCHECK_IMPACT_COUNT]; /* CONTACTCHECK_IMPACT_SIZES */
  uint32_t reserved_4;
  int32_t (*declare_impacts)(void* detector, contactcheck_impact_semantics* semantics,
                             char* message);
  /* Answers one query, of a kind that was declared. REFUSED: this query alone. */
  int32_t (*impact)(void* detector, const contactcheck_impact_query* query,
                    contactcheck_impact* impact, char* message);
  /* Reports the contacts of prepared bodies within a step, at the levels that were declared; steps
   * come in any order. A pair within a body names it twice. Items whose impact says no contact are
   * passed over; the earliest time of a pair of bodies, or of their elements, counts. */
  int32_t (*step)(void* detector, const contactcheck_step* step,
                  const contactcheck_step_answer* answer, char* message);
} contactcheck_plugin;

#if defined(_WIN32)
#define CONTACTCHECK_PLUGIN_EXPORT __declspec(dllexport)
#else
#define CONTACTCHECK_PLUGIN_EXPORT __attribute__((visibility("default")))
#endif

/* The one symbol of a plug-in. The table must stay as it is as long as the library is loaded. */
CONTACTCHECK_PLUGIN_EXPORT const contactcheck_plugin* contactcheck_plugin_entry(void);

#ifdef __cplusplus
}
#endif
/* NOLINTEND(readability-identifier-naming) */

#endif
