"""links.py ROOT: every relative link of the pages leads to a file and, where it names one, to a heading of it."""

import glob
import os
import sys

from page import anchors, links


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def main(root):
    checked = failed = 0
    for page in sorted(glob.glob(root + "/*.md") + glob.glob(root + "/docs/*.md")):
        for link in links(read(page)):
            if "://" in link:
                continue
            path, _, anchor = link.partition("#")
            target = os.path.join(os.path.dirname(page), path) if path else page
            checked += 1
            if not os.path.exists(target):
                failed += 1
                print(f"{page}: {link} leads nowhere")
            elif anchor and anchor not in anchors(read(target)):
                failed += 1
                print(f"{page}: {target} has no heading #{anchor}")
    print(f"{checked} links")
    return 1 if failed or checked < 30 else 0


sys.exit(main(sys.argv[1]))
