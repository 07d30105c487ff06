"""watch.py RIDGELINE RIDGELINED WORK: what `ridgeline watch` writes to a pipe and draws on a terminal."""

import os
import pty
import re
import signal
import subprocess
import sys

from programs import check, empty_folder, environment_of

ridgeline, ridgelined, work = sys.argv[1:]
empty_folder(work)
environment = environment_of("watch")


def drawn_on_a_terminal():
    """All that is drawn until something was drawn over, and the exit status after SIGINT."""
    ours, theirs = pty.openpty()
    with subprocess.Popen([ridgeline, "watch", "--interval", "0.1"], env=environment, stdout=theirs,
                          stderr=subprocess.STDOUT, stdin=theirs) as watching:
        os.close(theirs)
        text = ""
        while not re.search("\x1b\\[2A\x1b\\[J[^\n]*\n[^\n]*\n", text):
            text += os.read(ours, 4096).decode()
        watching.send_signal(signal.SIGINT)
        return text, watching.wait()


absent = subprocess.run([ridgeline, "watch", "--once", "--timeout", "0.2"], env=environment, capture_output=True, check=False)
check(absent.returncode == 3, f"without a service: exit status {absent.returncode}")

service = subprocess.Popen([ridgelined, "--library", work + "/library.db", "--instance", "watched"], env=environment,
                           stderr=subprocess.DEVNULL)
try:
    once = subprocess.run([ridgeline, "watch", "--once", "--timeout", "30"], env=environment, capture_output=True, text=True,
                          check=True).stdout
    check(re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ instance=watched running=0/\d+ queued=0/256 clients=\d+ requests=0 "
                       r"per_second=- refused=0 p50_ms=0\.00 p99_ms=0\.00 memory_mb=\d+ library=0\n", once), once)
    text, status = drawn_on_a_terminal()
    check(status == 130, f"interrupted: exit status {status}")
    check(re.search(r"instance +running +queued +requests", text), text)
    check(re.search(r"watched +0 of \d+ +0 of 256 +0 +[0-9.-]+ +0 ", text), text)
finally:
    service.terminate()
    service.wait()
