"""The command of a detector that lives in another interpreter: see _serve.py."""

import os
import signal
import socket
import sys

name = os.environ.get("CONTACTCHECK_PYTHON_SOCKET")
if name is None:
    sys.exit("it lives in the interpreter that called contactcheck.run(), and is asked during that alone")
connection = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
connection.connect(b"\0" + name.encode())
socket.send_fds(connection, [sys.argv[1].encode()], [0, 1, 2])
nothing = os.open(os.devnull, os.O_RDWR)
for file in range(3):
    os.dup2(nothing, file)  # the pipes end with the child
code = int(connection.recv(16) or b"1")
if code < 0:
    signal.signal(-code, signal.SIG_DFL) if -code not in (signal.SIGKILL, signal.SIGSTOP) else None
    os.kill(os.getpid(), -code)
os._exit(code)
