"""commands.py ROOT PROGRAMS WORK PAGE: runs the commands of a page, in its order, in one shell.

The page says what each block is by what stands behind its opening fence:
  sh                  commands; the exit status of each must be 0
  sh not run: WHY     commands that the tests cannot run
  json FILE           a file that the reader writes, or, where the repository has it, the same document
  text from COMMAND   lines that the command prints, in this order; ... stands for any number of lines
  text, json, ...     anything else
A command that stands elsewhere is an error, so that none is left out. PROGRAMS: folders of ridgeline and ridgelined.
"""

import json
import os
import re
import subprocess
import sys

from page import blocks, without_blocks
from programs import empty_folder, environment_of

COMMAND = re.compile(r"^(    )?(\$ )?(ridgelined?|cmake|ctest|cpack|docker|podman|buildah|systemctl|apt-get|scripts/[a-z-]+) ")


def fail(page, line, message):
    sys.exit(f"{page}:{line}: {message}")


def check_prose(page, text):
    for number, line in enumerate(without_blocks(text).split("\n"), 1):
        if line.startswith("    ") and COMMAND.match(line):
            fail(page, number, "a command outside of a ```sh block is not run: " + line.strip())


def take_file(root, page, block):
    name = block.info.split()[1]
    document = json.loads(block.text)
    source = os.path.join(root, name)
    if os.path.exists(source):
        with open(source, encoding="utf-8") as file:
            if json.load(file) != document:
                fail(page, block.line, "is not " + name)
        return
    with open(name, "w", encoding="utf-8") as file:
        file.write(block.text)


def holds(printed, shown):
    """Are the lines shown among those printed, in their order, without gaps but where ... stands?"""
    pattern = "".join(r"(?:.*\n)*?" if line == "..." else re.escape(line) + r"\n" for line in shown)
    return re.search("^" + pattern, printed, re.M) is not None


def script_of(root, page, text):
    script = ["set -euo pipefail", "trap 'kill $(jobs -p) 2>/dev/null || true; wait || true' EXIT"]
    commands = "".join(block.text for block in blocks(text) if block.info == "sh")
    if "ridgelined" not in commands:
        script.append("ridgelined --library page.db --instance page 2>service.log &")
    expected, last = [], []
    for block in blocks(text):
        if block.info == "sh":
            script.append(f"echo '== {os.path.basename(page)}:{block.line}' >&2\n{block.text}")
        elif re.match(r"json \S", block.info):
            take_file(root, page, block)
        elif block.info.startswith("text from "):
            out = f"expected-{len(expected)}"
            last.append(f"{block.info[len('text from '):]} >{out}")
            expected.append((block, out))
        elif COMMAND.match(block.text) and not re.match(r"(sh not run: \S|text)", block.info):
            fail(page, block.line, "commands in a block that is not ```sh")
    return "\n".join(script + last) + "\n", expected


def main(root, programs, work, page):
    with open(page, encoding="utf-8") as file:
        text = file.read()
    empty_folder(work)
    os.chdir(work)
    for name in ("clients", "docs", "scripts", "service", "docker", "tests"):
        os.symlink(os.path.join(root, name), name)
    check_prose(page, text)
    script, expected = script_of(root, page, text)
    if "== " not in script and not expected:
        return
    environment = {**environment_of("docs"), "PATH": programs + ":" + os.environ["PATH"], "HOME": work, "XDG_DATA_HOME": work}
    ran = subprocess.run(["bash", "-c", script], env=environment, stdin=subprocess.DEVNULL,
                         stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=240, check=False)
    if ran.returncode != 0:
        sys.exit(f"{page}: exit status {ran.returncode}\n{ran.stdout[-2000:]}{ran.stderr[-4000:]}")
    for block, out in expected:
        with open(out, encoding="utf-8") as file:
            if not holds(file.read(), block.text.rstrip("\n").split("\n")):
                fail(page, block.line, "does not print this: " + block.info)


main(*sys.argv[1:])
