# SPDX-License-Identifier: GPL-3.0-or-later
"""What both mutation suites need: a copy of the tree to break, and programs that may hang."""

import os
import pathlib
import shutil
import signal
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
MARK = ".mutation-copy"  # in the folder of a copy: what was copied there
PRESET = "release"


class SuiteError(Exception):
    """The suite is wrong, or the product before anything was broken."""


def copy_tree(folder, changed=None):
    """Makes the folder a copy of the tree as git sees it, uncommitted changes included; same files are not touched.
    Files named in `changed` (name -> bytes) get that text, in the place of their own or in addition."""
    changed = changed or {}
    if folder == ROOT or (folder.exists() and any(folder.iterdir()) and not (folder / MARK).is_file()):
        raise SuiteError(f"{folder} is not a folder of this suite: name an empty one or one that does not exist")
    folder.mkdir(parents=True, exist_ok=True)
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT,
                            check=True, capture_output=True).stdout.decode()
    names = sorted({name for name in listed.split("\0") if name and (ROOT / name).is_file()} | set(changed))
    mark = folder / MARK
    before = mark.read_text().splitlines() if mark.is_file() else []
    mark.write_text("\n".join(names) + "\n")
    for name in set(before) - set(names):
        (folder / name).unlink(missing_ok=True)
    for name in names:
        source, copy = ROOT / name, folder / name
        text = changed[name] if name in changed else source.read_bytes()
        if not copy.is_file() or copy.read_bytes() != text:
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(text)
        if source.is_file():
            shutil.copymode(source, copy)


def run_within(seconds, command, environment, folder):
    """Exit status (None if the time was up) and output; what the command has started ends with it."""
    process = subprocess.Popen(command, env=environment, cwd=folder, stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, text=True, errors="replace", start_new_session=True)
    try:
        output, _ = process.communicate(timeout=max(seconds, 1.0))
        return process.returncode, output
    except subprocess.TimeoutExpired:
        return None, ""
    finally:
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        process.wait()
