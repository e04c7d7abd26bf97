"""A detector of steps at the end of a pipe, of the same two triangles as step_plugin.c. Its argument
says what it does."""

import json
import struct
import sys

SAYS, TOLERANCES = sys.argv[1], [float(word) for word in sys.argv[2:]]
LEVELS = ["impact-vf", "impact-ee", "impact-triangle", "impact"]


def write(line, data=b""):
    line["bytes"] = len(data)
    sys.stdout.buffer.write(json.dumps(line).encode() + b"\n" + data)
    sys.stdout.flush()


def contacts():
    if SAYS == "nothing":
        return {}, b""
    time = {"early": 0.25, "timeless": -1.0, "nan": float("nan"), "start": 0.0}.get(SAYS, 0.5)
    edges = {"edges": (0, 1, 1, 0, 2, 1), "no-edge": (0, 1, 1, 7, 2, 1)}.get(SAYS)
    line = {"impacts": 1, "impact_triangles": 1, "impact_vertices": 3}
    data = struct.pack("<2Id", 1, 0, time) + struct.pack("<4I", 0, 1, 0, 0)
    data += b"".join(struct.pack("<4I", 1, 0, vertex, 0) for vertex in range(3))
    if edges:
        line["impact_edges"] = 1
        data += struct.pack("<6I", *edges)
    return line, data


for text in iter(sys.stdin.buffer.readline, b""):
    asked = json.loads(text)
    data = sys.stdin.buffer.read(asked.get("bytes", 0))
    if asked["message"] == "hello":
        questions = ["triangles"] if SAYS == "no-question" else ["impacts"]
        write({"message": "hello", "protocol": "contactcheck-pipe/1", "id": "steps", "needs": ["vertices"],
               "semantics": {"levels": LEVELS, "questions": questions,
                             **dict(zip(("tolerance", "tolerance_of_start"), TOLERANCES))}})
    elif asked["message"] == "prepare":
        write({"message": "ready"})
    elif asked["message"] == "step":
        ends = struct.unpack("<36d", data)
        assert (asked["index"], asked["start_time"], asked["end_time"]) == (0, 0.0, 1.0)
        assert ends[11] == 1 and ends[29] in (-1, 0.125), ends
        write({"message": "done"})
    elif asked["message"] == "query":
        assert asked["question"] == "impacts"
        line, data = contacts()
        write({"message": "contacts", **line}, data)
