# A beginning: two bodies touch where their boxes do. To answer with pairs of triangles, declare
# "levels": ["body", "triangle"] and "questions": ["triangles", "body"]. A query then has
# line["question"]; the answer to "triangles" is {"message": "contacts", "triangles": N}, followed
# by N times four numbers: body a, body b (a below b), triangle of a, triangle of b. What follows
# "prepare", body after body: "The protocol" of reference/plugin/README.md.
import array, json, sys

def write(line, numbers=array.array("I")):
    line["bytes"] = 4 * len(numbers)
    sys.stdout.buffer.write(json.dumps(line).encode() + b"\n" + numbers.tobytes())
    sys.stdout.buffer.flush()              # or contactcheck waits until its limit of time

def boxes(data):                           # of every body: lowest and highest x, y and z
    out, at = [], 0
    for count in vertices:
        x = array.array("d", data[at:at + 24 * count])
        at += 24 * count
        out.append([(min(x[k::3]), max(x[k::3])) for k in range(3)])
    return out

for text in iter(sys.stdin.buffer.readline, b""):
    line = json.loads(text)
    data = sys.stdin.buffer.read(line.get("bytes", 0))
    if line["message"] == "hello":
        write({"message": "hello", "protocol": "contactcheck-pipe/1", "id": "mine", "needs": ["vertices"],
               "semantics": {"levels": ["body"], "questions": ["body"]}})
    elif line["message"] == "prepare":     # data has vertices at rest, triangles and lattices
        vertices = [body["vertices"] for body in line["bodies"]]
        write({"message": "ready"})
    elif line["message"] == "frame":
        now = boxes(data)
        write({"message": "done"})
    else:                                  # query
        found = [(a, b) for b in range(len(now)) for a in range(b)
                 if all(p[0] <= q[1] and q[0] <= p[1] for p, q in zip(now[a], now[b]))]
        write({"message": "contacts", "bodies": len(found)}, array.array("I", sum(found, ())))
