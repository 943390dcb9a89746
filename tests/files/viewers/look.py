"""Opens recordings in the viewer of the installed rerun-sdk, without a screen, and says of each whether its views show data
and its pictures fill them.

    python look.py [--pictures FOLDER] RECORDING...

Every recording gets a viewer of its own, and a line: `ok` or what is wrong. The exit code is 1 if anything is wrong, and 3 if no viewer can
draw on this machine.
"""

import argparse
import os
import re
import socket
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import numpy as np
import rerun_cli
from PIL import Image
from rerun.experimental import ViewerClient

try:
    from rerun.chunk import RrdReader
except ImportError:
    from rerun.experimental import RrdReader

PATIENCE, COMPLAINED = 90.0, 10.0
"""Seconds after which a viewer that shows nothing, or changes all the time, is given up, and one that has complained as well."""
ANSWER = 20.0
"""Seconds after which a picture is asked for again: the viewer of 0.36 never answers for a view that it does not show yet."""
INK = 40
"""Difference of a pixel from the ground of its view from which on something is drawn there."""
LEAST_INK = 0.01
"""Share of a view that is drawn on where it shows data: words that say there are none cover less."""
LEAST_COLOUR = 0.0003
"""The same of pixels that are coloured, which words and frames of the viewer are not; of views other than texts."""
GREY = 0.1
"""The same of pictures without colours, of which the ground is not the half."""
LEAST_WINDOW = 0.003
"""The share of coloured pixels in a window that shows anything; that of a window whose views are empty is 0.0006."""
FILLED = 0.75
"""The share of its view that a picture in the plane covers at least, with its axes."""
TABS = 1
"""The kind of a container whose first child alone can be seen."""
COMPLAINT = re.compile(r"\b(WARN|ERROR)\b|Fail to merge|panicked", re.IGNORECASE)
HARMLESS = re.compile(r"Software rasterizer detected|XDG_RUNTIME_DIR|not found for screenshot|Failed to render screenshot")
"""What a viewer says on a machine without graphics or a desktop, whatever it shows, and of pictures that are asked for too early."""
NO_GRAPHICS = re.compile(r"No graphics adapter|Failed to get render context", re.IGNORECASE)
"""What it dies of where there is no driver that it can draw with."""


class Viewer:
    """A viewer without a window that has opened a recording."""

    def __init__(self, recording, folder):
        self.folder, self.count, self.start = folder, 0, time.monotonic()
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        program = Path(rerun_cli.__file__).with_name("rerun")
        command = [program, recording, "--headless", "--bind", "127.0.0.1", "--port", str(port), "--window-size", "1280x800"]
        self.words = folder / "words"
        with self.words.open("w") as words:
            self.process = subprocess.Popen(command, stdout=words, stderr=words, env={**os.environ, "NO_COLOR": "1"})
        self.url = f"rerun+http://127.0.0.1:{port}/proxy"
        self.client = None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()

    def is_waited_for(self):
        patience = COMPLAINED if self.complaints() else PATIENCE
        return time.monotonic() < self.start + patience and self.process.poll() is None

    def shoot(self, view=None):
        """The picture of the window or of a view, or None where it cannot be had yet."""
        self.count += 1
        path = self.folder / f"{self.count}.png"
        asked = threading.Thread(target=self.ask, args=(path, view), daemon=True)
        asked.start()
        asked.join(ANSWER)
        return read(path)

    def ask(self, path, view):
        try:
            self.client = self.client or ViewerClient(self.url)
            self.client.save_screenshot(str(path), view_id=view)
        except OSError:
            pass  # the viewer is not there yet, has not laid out the view, or is too slow to answer

    def settled(self):
        """The window once two pictures in a row show the same data, or the last picture, and whether that is so."""
        last, seen = None, None
        while self.is_waited_for():
            picture = self.shoot()
            now = picture and shares(picture)
            if now and now == last and now[1] > LEAST_WINDOW:
                return picture, True
            last, seen = now, picture or seen
        return seen, False

    def shows(self, view, is_wanted):
        """The picture of a view once it is as wanted, or None."""
        while True:
            picture = self.shoot(view)
            if picture and is_wanted(picture):
                return picture
            if not self.is_waited_for():
                return None

    def complaints(self):
        """What the viewer said that it should not say."""
        words = re.sub(r"\x1b\[[0-9;]*m", "", self.words.read_text(errors="replace"))
        return [line for line in words.splitlines() if COMPLAINT.search(line) and not HARMLESS.search(line)]


def read(path):
    """A picture that a viewer writes, which may answer before the file is whole, or None."""
    end = time.monotonic() + 2.0
    while time.monotonic() < end:
        try:
            with Image.open(path) as picture:
                return picture.convert("RGB")
        except (OSError, SyntaxError):
            time.sleep(0.05)
    return None


def shares(picture):
    """The shares of pixels that are not the ground, and of those that are coloured."""
    pixels = np.asarray(picture).astype(int)
    colours, counts = np.unique(pixels[::4, ::4].reshape(-1, 3), axis=0, return_counts=True)
    ink = np.abs(pixels - colours[counts.argmax()]).max(axis=2) > INK
    colour = pixels.max(axis=2) - pixels.min(axis=2) > INK
    return float(ink.mean()), float(colour.mean())


def filled(picture):
    """The share of a picture between the outermost things that are drawn in it. The ground is the colour that is most common at its rim."""
    pixels = np.asarray(picture).astype(int)
    rim = np.concatenate([pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1]])
    colours, counts = np.unique(rim, axis=0, return_counts=True)
    ink = np.abs(pixels - colours[counts.argmax()]).max(axis=2) > INK
    return np.prod([np.ptp(np.flatnonzero(ink.any(axis=axis))) / ink.shape[1 - axis] for axis in (0, 1)])


def has_data(picture, kind):
    ink, colour = shares(picture)
    return ink > LEAST_INK if kind == "TextDocument" else colour > LEAST_COLOUR or ink > GREY


def layout(recording):
    """Components of the entities of the layout inside a recording: {path: {component: value}}."""
    found = {}
    reader = RrdReader(recording)
    chunks = (chunk for store in reader.blueprints() for chunk in reader.stream(store=store))
    for chunk in chunks:
        batch = chunk.to_record_batch()
        names = [name for name in batch.schema.names if name.startswith(("ViewBlueprint:", "ContainerBlueprint:", "ViewportBlueprint:"))]
        values = {name.split(":")[1]: batch.column(name).to_pylist()[-1] for name in names}
        found.setdefault(str(chunk.entity_path).strip("/"), {}).update(values)
    return found


def views(recording):
    """The views that can be seen when a recording opens: (id, title, kind)."""
    parts = layout(recording)
    root = bytes(parts["viewport"]["root_container"][0]).hex()
    waiting, seen = [next(path for path in parts if path.replace("-", "") == f"container/{root}")], []
    while waiting:
        path = waiting.pop()
        part = parts[path]
        if path.startswith("view/"):
            seen.append((path.removeprefix("view/"), part["display_name"][0], part["class_identifier"][0]))
        elif part["container_kind"][0] == TABS:
            waiting.append((part.get("active_tab") or part["contents"])[0])
        else:
            waiting += part["contents"]
    return seen


def faults_of_views(viewer, recording):
    for view, title, kind in views(recording):
        picture = viewer.shows(view, lambda picture: has_data(picture, kind))
        if not picture:
            yield f"the view {title!r} shows no data"
        elif kind == "2D" and not viewer.shows(view, lambda picture: filled(picture) >= FILLED):
            yield f"the picture {title!r} covers {filled(picture):.0%} of its view"


def look(recording, pictures):
    """What is wrong with a recording as the viewer shows it."""
    with tempfile.TemporaryDirectory() as folder, Viewer(recording, Path(folder)) as viewer:
        picture, has_settled = viewer.settled()
        if picture and pictures:
            picture.save(pictures / f"{Path(recording).stem}.png")
        empty = list(faults_of_views(viewer, recording))
        unsettled = [] if has_settled else ["the window does not settle on data"]
        ended = [] if viewer.process.poll() is None else ["the viewer has ended by itself"]
        words = viewer.complaints()
    if any(NO_GRAPHICS.search(line) for line in words):
        sys.exit(3)
    return unsettled + empty + ended + words


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--pictures", type=Path)
    parser.add_argument("recordings", nargs="+")
    given = parser.parse_args()
    is_wrong = False
    for recording in given.recordings:
        wrong = look(recording, given.pictures)
        is_wrong |= bool(wrong)
        print(f"{recording}: {'; '.join(wrong) or 'ok'}", flush=True)
    sys.exit(int(is_wrong))


if __name__ == "__main__":
    main()
