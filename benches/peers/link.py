"""A worker process and the talk with it."""

import json
import os
import queue
import subprocess
import threading

ONE_THREAD = {
    name: "1"
    for name in (
        "OMP_NUM_THREADS",
        "OPENBLAS_NUM_THREADS",
        "MKL_NUM_THREADS",
        "RAYON_NUM_THREADS",
    )
}


class PeerError(Exception):
    """A peer has no answer."""


class PeerTimeoutError(PeerError):
    """A peer takes too long."""


class Worker:
    """A process that solves what it is asked, one line of JSON each way. Started at the first question,
    ended when a question takes too long, and started again at the next."""

    def __init__(self, command):
        self.command = command
        self.process = None
        self.answers = None

    def ask(self, line, patience):
        """Seconds and ends of the motions asked for; PeerError if there are none within `patience` s."""
        if self.process is None:
            self._start()
        try:
            self.process.stdin.write(line + "\n")
            self.process.stdin.flush()
            answer = self.answers.get(timeout=patience)
        except queue.Empty:
            self.close()
            raise PeerTimeoutError(f"no answer within {patience:.0f} s") from None
        except BrokenPipeError:
            answer = None
        if answer is None:
            code = self.process.wait()
            self.close()
            raise PeerError(f"the worker ended with code {code}")
        if "error" in answer:
            raise PeerError(answer["error"])
        return answer["seconds"], [tuple(end) for end in answer["ends"]]

    def close(self):
        """Ends the process, if there is one."""
        if self.process is not None:
            self.process.kill()
            self.process.wait()
            self.process = None

    def _start(self):
        self.process = subprocess.Popen(
            self.command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
            env={**os.environ, **ONE_THREAD},
        )
        self.answers = queue.Queue()
        listener = threading.Thread(target=_listen, args=(self.process.stdout, self.answers), daemon=True)
        listener.start()


def _listen(stream, answers):
    for line in stream:
        answers.put(json.loads(line))
    answers.put(None)
