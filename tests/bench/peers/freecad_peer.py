"""FreeCAD headless on what Ridgeline is for: freecadcmd freecad_peer.py (prints tables; called by scripts/bench).

Its Deburr operation on the edges of a cross hole, chosen as edges and as the hole's face, and the time that it takes to read
the STEP files of the tests: it plans no turning, so that reading is all there is to compare."""

import contextlib
import glob
import io
import os
import time

import FreeCAD
import Part
import PathScripts.PathDeburr as PathDeburr
import PathScripts.PathJob as PathJob
from FreeCAD import Vector

PARTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../parts")
INNER, OUTER, HOLE, LENGTH = 20, 30, 5, 60  # radii and length [mm]


def tube():
    shape = Part.makeCylinder(OUTER, LENGTH, Vector(0, -LENGTH / 2, 0), Vector(0, 1, 0))
    shape = shape.cut(Part.makeCylinder(INNER, 2 * LENGTH, Vector(0, -LENGTH, 0), Vector(0, 1, 0)))
    return shape.cut(Part.makeCylinder(HOLE, 2 * OUTER, Vector(0, 0, 0), Vector(0, 0, 1)))


def radius(face):
    return getattr(face.Surface, "Radius", 0)


def ridge(shape, body):
    """Names of the edges where the hole meets the cylinder of radius `body`."""
    found = []
    for i, edge in enumerate(shape.Edges):
        radii = sorted(radius(face) for face in shape.ancestorsOfType(edge, Part.Face))
        if len(radii) == 2 and abs(radii[0] - HOLE) < 1e-6 and abs(radii[1] - body) < 1e-6:
            found.append("Edge%d" % (i + 1))
    return found


def hole_faces(shape):
    return ["Face%d" % (i + 1) for i, face in enumerate(shape.Faces) if abs(radius(face) - HOLE) < 1e-6]


def deburr(document, job, name, elements):
    """What comes of it: the message of its failure, or the moves that it makes."""
    operation = PathDeburr.Create(name)
    operation.Base = [(job.Model.Group[0], tuple(elements))]
    try:
        operation.Proxy.execute(operation)
    except Exception as failure:  # its message is what is asked for
        details = failure.args[0]
        return "%s: %s" % (type(failure).__name__, details["swhat"] if isinstance(details, dict) else details)
    moves = [c for c in operation.Path.Commands if c.Name.startswith("G")]
    heights = {round(c.Parameters["Z"], 3) for c in moves if c.Name == "G1" and "Z" in c.Parameters}
    return "%d moves, cutting at Z %s" % (len(moves), sorted(heights) or "nowhere")


def main():
    document = FreeCAD.newDocument("peer")
    part = document.addObject("Part::Feature", "tube")
    part.Shape = tube()
    document.recompute()
    job = PathJob.Create("Job", [part], None)
    rows = ["| what is chosen | FreeCAD's Deburr |", "|---|---|"]
    with contextlib.redirect_stdout(io.StringIO()):
        for where, body in (("inner", INNER), ("outer", OUTER)):
            rows.append("| both %s edges | %s |" % (where, deburr(document, job, where, ridge(part.Shape, body))))
        rows.append("| the face of the hole | %s |" % deburr(document, job, "face", hole_faces(part.Shape)))
    rows += ["", "| STEP file | FreeCAD reads it [ms] |", "|---|---|"]
    for path in sorted(glob.glob(os.path.join(PARTS, "*.st*p"))):
        begin = time.process_time()
        Part.Shape().read(path)
        rows.append("| %s | %.0f |" % (os.path.basename(path), 1e3 * (time.process_time() - begin)))
    with open(os.environ["RIDGELINE_PEER_OUT"], "w") as out:  # its own messages go to standard output
        out.write("\n".join(rows) + "\n")


main()
