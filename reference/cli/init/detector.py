# A beginning that is wrong: it says that two bodies touch where their boxes do. To answer with pairs
# of triangles, declare "levels": ["body", "triangle"] and "questions": ["triangles", "body"]. A query
# then has line["question"]; the answer to "triangles" is {"message": "contacts", "triangles": N},
# followed by N times four numbers: body a, body b (a below b), triangle of a, triangle of b.
import array, io, json, sys

def write(line, numbers=array.array("I")):
    line["bytes"] = 4 * len(numbers)
    sys.stdout.buffer.write(json.dumps(line).encode() + b"\n" + numbers.tobytes())
    sys.stdout.buffer.flush()              # or contactcheck waits until its limit of time

def take(kind, count):                     # the next numbers after the line: "d" doubles, "I" integers
    return array.array(kind, data.read((8 if kind == "d" else 4) * count))

def box(x):                                # lowest and highest x, y and z
    return [(min(x[k::3]), max(x[k::3])) for k in range(3)]

for text in iter(sys.stdin.buffer.readline, b""):
    line = json.loads(text)
    data = io.BytesIO(sys.stdin.buffer.read(line.get("bytes", 0)))
    if line["message"] == "hello":
        write({"message": "hello", "protocol": "contactcheck-pipe/1", "id": "mine", "needs": ["vertices"],
               "prepares_again": True, "semantics": {"levels": ["body"], "questions": ["body"]}})
    elif line["message"] == "prepare":
        bodies = line["bodies"]
        for body in bodies:
            v, t, grid = body["vertices"], body["triangles"], body["lattice"]
            rest, triangles = take("d", 3 * v), take("I", 3 * t)
            if grid:
                nodes, corners = take("d", 3 * grid["nodes"]), take("I", 8 * grid["cells"])
                home_cells, coordinates = take("I", v), take("d", 3 * v)
                starts, cells_of_triangles = take("I", t + 1), take("I", grid["labels"])
        write({"message": "ready"})
    elif line["message"] == "frame":
        now = [box(take("d", 3 * body["vertices"])) for body in bodies]
        write({"message": "done"})
    else:                                  # query
        found = [(a, b) for b in range(len(now)) for a in range(b)
                 if all(p[0] <= q[1] and q[0] <= p[1] for p, q in zip(now[a], now[b]))]
        write({"message": "contacts", "bodies": len(found)}, array.array("I", sum(found, ())))
