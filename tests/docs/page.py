"""What a page of the documentation holds: fenced blocks, links, headings."""

import re
from dataclasses import dataclass


@dataclass
class Block:
    """A fenced block; `info` is what stands behind the opening fence, e.g. "sh not run: needs root"."""

    info: str
    text: str
    line: int


def blocks(text):
    found = []
    opened = None
    for number, line in enumerate(text.split("\n"), 1):
        if line.startswith("```"):
            if opened is None:
                opened = Block(line[3:].strip(), "", number)
            else:
                found.append(opened)
                opened = None
        elif opened is not None:
            opened.text += line + "\n"
    if opened is not None:
        raise ValueError(f"the block of line {opened.line} has no end")
    return found


def without_blocks(text):
    """The prose, with as many lines."""
    inside = False
    lines = []
    for line in text.split("\n"):
        fence = line.startswith("```")
        lines.append("" if inside or fence else line)
        inside ^= fence
    return "\n".join(lines)


def anchors(text):
    """The anchors of the headings, as GitHub makes them."""
    found = set()
    for heading in re.findall(r"^#+ +(.*)$", without_blocks(text), re.M):
        slug = re.sub(r"[^\w\- ]", "", heading.strip().lower().replace("`", "")).replace(" ", "-")
        number = 0
        while slug + (f"-{number}" if number else "") in found:
            number += 1
        found.add(slug + (f"-{number}" if number else ""))
    return found


def links(text):
    return re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", without_blocks(text)))
