"""What the tests share that run the programs from outside."""

import os
import shutil


def environment_of(test):
    """This environment without settings of a user, on a DDS network of the test's own."""
    kept = {k: v for k, v in os.environ.items() if not k.startswith(("RIDGELINE_", "CYCLONEDDS_"))}
    return {**kept, "RIDGELINE_DOMAIN": str(1 + os.getpid() % 99), "DDS_TAG": f"ridgeline-{test}-{os.getpid()}"}


def empty_folder(path):
    shutil.rmtree(path, ignore_errors=True)
    os.makedirs(path)


def check(is_so, message):
    if not is_so:
        raise AssertionError(message)
