"""A detector at the end of a pipe that does what its argument says; in frame 2, if it is a fault of
answers. Otherwise it reports no contacts."""

import json
import os
import struct
import subprocess
import sys
import threading
import time

FAULT = sys.argv[1]
if sys.argv[2:3] == ["--starts"]:  # a file that gets a line for each start
    with open(sys.argv[3], "a", encoding="utf-8") as starts:
        starts.write("started\n")
OUT = sys.stdout.buffer
LEAKED = []
WARM = {"frames": 0, "triangles": 0}  # between the first prepare and the second
HELLO = {
    "message": "hello",
    "protocol": "contactcheck-pipe/1",
    "id": "misbehaving",
    "semantics": {"levels": ["body", "triangle"], "questions": ["triangles"]},
}
PAIR = struct.pack("<4I", 0, 1, 0, 0)
DEPTHS = {"levels": ["triangle"], "questions": ["triangles", "contacts"], "depth_kind": "convex-pair"}


def write(line, payload=b""):
    if payload and "bytes" not in line:
        line["bytes"] = len(payload)
    OUT.write(json.dumps(line).encode() + b"\n" + payload)
    OUT.flush()


def hang():
    while True:
        time.sleep(1)


def flood():
    while True:
        OUT.write(b"x" * 65536)
        OUT.flush()


def eat_memory():
    kept = []
    while True:
        kept.append(b"x" * (1 << 24))


def eat_memory_in_a_child():
    subprocess.run([sys.executable, __file__, "only-eat"])


def work_behind_the_answer():
    end = time.perf_counter() + 0.03
    while time.perf_counter() < end:
        pass


def work_in_a_child():
    child = os.fork()
    if child == 0:
        while time.process_time() < 0.04:
            pass
        os._exit(0)
    os.waitpid(child, 0)


def hello():
    line = dict(HELLO)
    if FAULT == "no-answer":
        hang()
    if FAULT == "ends-at-once":
        sys.exit(3)
    if FAULT == "raises-at-once":
        raise ValueError("no such model")
    if FAULT == "garbage":
        OUT.write(b"Loading model...\n")
        OUT.flush()
    if FAULT == "not-utf8":
        OUT.write(b'{"message": "\xff"}\n')
        OUT.flush()
    if FAULT == "version-2":
        line["protocol"] = "contactcheck-pipe/2"
    if FAULT in ("scale-later", "scale-of-the-warm-up"):
        line["semantics"] = dict(HELLO["semantics"], precision="single")
    if FAULT == "bad-id":
        line["id"] = "a:b"
    if FAULT == "built-in-id":
        line["id"] = "fcl-aabb"
    if FAULT == "unknown-level":
        line["semantics"] = {"levels": ["voxel"], "questions": ["triangles"]}
    if FAULT == "no-semantics":
        del line["semantics"]
    if FAULT == "endless-line":
        flood()
    if FAULT == "eats-memory-at-once":
        eat_memory()
    if FAULT == "nan-depth":
        line["semantics"] = DEPTHS
    if FAULT in ("always-lies-again", "warms-up", "lies-when-kept", "fails-while-warm", "scale-of-the-warm-up"):
        line["prepares_again"] = True
    if FAULT in ("warms-up", "fails-while-warm", "scale-of-the-warm-up"):
        line["warm_up"] = 40
    if FAULT == "warms-up-once":
        line["warm_up"] = 40
    if FAULT == "renamed":  # another name every time it is started
        line["id"] = "renamed-" + str(os.getpid())
    write(line)


def frame():
    if FAULT == "exits-in-frame":
        sys.exit(0)
    if FAULT == "raises-in-frame":
        raise ZeroDivisionError("division by zero in a frame")
    if FAULT == "kills-itself":
        os.kill(os.getpid(), 9)
    if FAULT == "hangs-in-frame":
        hang()
    if FAULT == "floods":
        flood()
    if FAULT == "floods-errors":
        while True:
            sys.stderr.write("x" * 65536)
    if FAULT == "eats-memory":
        eat_memory()
    if FAULT == "eats-memory-in-a-child":
        eat_memory_in_a_child()
    if FAULT == "closes-its-output":
        os.close(1)
        hang()
    if FAULT == "half-a-line":
        OUT.write(b'{"message": "do')
        OUT.flush()
        os._exit(0)
    if FAULT == "wrong-message":
        write({"message": "ready"})
    if FAULT == "reports-an-error":
        write({"message": "error", "text": "the solver did not converge"})
    if FAULT == "refuses":
        write({"message": "refused", "text": "only convex bodies, please"})
    if FAULT == "negative-time":
        write({"message": "done", "ms": -1})
    write({"message": "done"})
    if FAULT == "talks-too-much":
        write({"message": "done"})


def ready(bodies):
    line = {"message": "ready"}
    if FAULT == "leaves-its-group" and not LEAKED:
        LEAKED.append(subprocess.Popen(["sleep", "300"], start_new_session=True))
    if FAULT == "warms-up" and WARM["triangles"] > 0:
        sys.stderr.write("%d frames of %d triangles\n" % (WARM["frames"], WARM["triangles"]))
        sys.stderr.flush()
    if FAULT == "exact-later":
        line["semantics"] = dict(HELLO["semantics"], exact=True)
    if FAULT == "scale-later" or (FAULT == "scale-of-the-warm-up" and WARM["triangles"] == 0):
        line["semantics"] = dict(HELLO["semantics"], precision="single", scale=2)
    WARM["triangles"] = sum(body["triangles"] for body in bodies)
    write(line)


def query(question):
    pair = PAIR
    if FAULT == "no-such-body":
        return write({"message": "contacts", "triangles": 1}, struct.pack("<4I", 0, 9, 0, 0))
    if FAULT == "no-such-triangle":
        return write({"message": "contacts", "triangles": 1}, struct.pack("<4I", 0, 1, 0, 10**6))
    if FAULT == "with-itself":
        return write({"message": "contacts", "triangles": 1}, struct.pack("<4I", 1, 1, 0, 1))
    if FAULT == "lies":
        return write({"message": "contacts", "triangles": 1}, pair)
    if FAULT == "counts-disagree":
        return write({"message": "contacts", "triangles": 2}, pair)
    if FAULT == "too-many":
        return write({"message": "contacts", "triangles": 10**12, "bytes": 16 * 10**12})
    if FAULT == "half-a-message":
        write({"message": "contacts", "triangles": 2, "bytes": 32}, pair)
        os._exit(0)
    if FAULT == "nan-depth" and question == "contacts":
        numbers = struct.pack("<4I4d", 0, 1, 0, 0, float("nan"), 1.0, 0.0, 0.0)
        return write({"message": "contacts", "piece_contacts": 1}, numbers)
    if FAULT == "leaves-a-child":
        child = subprocess.Popen(["sleep", "300"])
        sys.stderr.write("child %d\n" % child.pid)
        sys.stderr.flush()
    return write({"message": "contacts"})


def main():
    if FAULT == "only-eat":
        eat_memory()
    index = prepared = 0
    while True:
        text = sys.stdin.buffer.readline()
        if not text:
            if FAULT == "stays":
                hang()
            return
        line = json.loads(text)
        sys.stdin.buffer.read(line.get("bytes", 0))
        if line["message"] == "hello":
            hello()
        elif line["message"] == "prepare":
            prepared += 1
            ready(line["bodies"])
        elif line["message"] == "frame":
            index = line["index"]
            WARM["frames"] += 1
            if FAULT == "fails-while-warm" and WARM["frames"] == 8:
                raise ValueError("seven were enough")
            if FAULT == "leaks":
                LEAKED.append(b"x" * (1 << 24))
            if FAULT == "works-in-a-child":
                work_in_a_child()
            frame() if index == 2 else write({"message": "done"})
        elif (FAULT in ("always-lies", "always-lies-again")
              or FAULT == "lies-when-kept" and (prepared > 1 or WARM["triangles"] > 4)):
            write({"message": "contacts", "triangles": 1}, PAIR)
        elif FAULT == "works-behind-its-answer":
            write({"message": "contacts"})
            threading.Thread(target=work_behind_the_answer).start()
        elif index == 2:
            query(line["question"])
        else:
            write({"message": "contacts"})


main()
