"""A detector of queries of moving elements at the end of a pipe: contact at half the step, always. It
does what its argument says, in the third query if that is a fault of answers."""

import json
import os
import signal
import sys
import time

FAULT = sys.argv[1]
CLAIMS = {"kinds": ["vertex-face"], "tolerance": 0.25}
if FAULT == "single":
    CLAIMS["precision"] = "single"
if FAULT == "of-start":
    CLAIMS["tolerance"] = 0


def write(line):
    sys.stdout.write(json.dumps(line) + "\n")
    sys.stdout.flush()


def misbehave():
    if FAULT == "crash":
        signal.signal(signal.SIGSEGV, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGSEGV)
    elif FAULT == "exit":
        os._exit(0)
    elif FAULT == "hang":
        time.sleep(1000)


ANSWERS = {
    "fails": {"message": "error", "text": "not today"},
    "refuses": {"message": "refused", "text": "not this one"},
    "late-time": {"message": "impact", "contact": True, "time": 1.5},
    "bad-tolerance": {"message": "impact", "contact": True, "tolerance": -1},
    "own-tolerance": {"message": "impact", "contact": True, "time": 0.5, "tolerance": 4},
    "no-contact": {"message": "impact", "time": 0.5},
}

if FAULT == "warm":
    CLAIMS["kinds"] = ["vertex-face", "edge-edge"]

asked = 0
for text in iter(sys.stdin.buffer.readline, b""):
    line = json.loads(text)
    sys.stdin.buffer.read(line.get("bytes", 0))
    if line["message"] == "hello":
        hello = {"message": "hello", "protocol": "contactcheck-pipe/1", "id": "impacts"}
        if FAULT.endswith("named-exact"):
            hello["id"] = "exact"
        if FAULT == "frames-named-exact":
            write({**hello, "semantics": {"levels": ["body"], "questions": ["body"]}})
        elif FAULT == "warm":
            write({**hello, "impacts": CLAIMS, "prepares_again": True, "warm_up": 5})
        else:
            write({**hello, "impacts": CLAIMS})
    elif line["message"] == "prepare":
        assert line["bodies"] == []
        ready = {"message": "ready"}
        # What depends on options is said when they are known.
        if FAULT == "of-start":
            ready["impacts"] = {**CLAIMS, "tolerance_of_start": 0.5}
        if FAULT == "other-kinds":
            ready["impacts"] = {**CLAIMS, "kinds": ["edge-edge"]}
        write(ready)
    elif FAULT == "warm":  # five of each kind come first
        asked += 1
        write({"message": "impact", "contact": asked > 10})
    else:
        assert line["message"] == "impact" and line["kind"] == "vertex-face" and line["bytes"] == 192
        asked += 1
        usual = {"message": "impact", "contact": True, "time": 0.5}
        if asked == 3:
            misbehave()
            if FAULT == "prints":
                print("hello")
            write(ANSWERS.get(FAULT, usual))
        else:
            write(usual)
