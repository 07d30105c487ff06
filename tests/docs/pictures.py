"""pictures.py ROOT PROGRAM WORK: scripts/pictures makes every picture of docs/images again, and none is without it.

Texts are the same, coordinates within TOLERANCE: the last digit is that of this machine's mathematics.
"""

import os
import re
import shutil
import subprocess
import sys

TOLERANCE = 0.03  # pixels: of coordinates that are printed with two decimals
NUMBER = re.compile(r"-?\d+\.\d+")


def read(folder, name):
    with open(os.path.join(folder, name), encoding="utf-8") as file:
        return file.read()


def difference(made, kept):
    """What tells the two apart, or None."""
    if NUMBER.sub("#", made) != NUMBER.sub("#", kept):
        return "texts or shapes differ"
    pairs = zip(map(float, NUMBER.findall(made)), map(float, NUMBER.findall(kept)))
    worst = max((abs(a - b) for a, b in pairs), default=0)
    return f"coordinates differ by {worst:.2f}" if worst > TOLERANCE else None


def main(root, program, work):
    shutil.rmtree(work, ignore_errors=True)
    subprocess.run([os.path.join(root, "scripts", "pictures"), work, program], check=True, timeout=240)
    kept_folder = os.path.join(root, "docs", "images")
    kept, made = sorted(os.listdir(kept_folder)), sorted(os.listdir(work))
    if kept != made:
        sys.exit(f"docs/images has {kept}, scripts/pictures makes {made}")
    failed = 0
    for name in made:
        found = difference(read(work, name), read(kept_folder, name))
        if found:
            failed += 1
            print(f"docs/images/{name}: {found}; scripts/pictures makes it anew")
    print(f"{len(made)} pictures")
    return 1 if failed or len(made) < 11 else 0


sys.exit(main(*sys.argv[1:]))
