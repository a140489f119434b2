"""The window on a display, worked by mouse and keys as a person would: it needs Xvfb and xdotool.

What it shows is read from the display's memory; what it has done from the journal it keeps of the session.
"""

import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAMS = pathlib.Path(os.environ["SPACETIME_BIN_DIR"])
EXAMPLES = pathlib.Path(os.environ["SPACETIME_SOURCE_DIR"]) / "examples"

# Where things are in a window of 1280 by 800 pixels.
RUN = (40, 41)
SCENE = (340, 66, 930, 450)  # left, top, right, bottom of the scene's view
RULER_Y, RULER_START, RULER_END = 508, 182, 1246  # of the time 0 s and 2 s


def handle(pixel):
    return pixel == (0xE0, 0xA9, 0x4A)


def of_the_arm(pixel):
    red, green, blue = pixel
    return blue > red + 60 and blue > green + 30


class Display(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        # What graphics drivers leave allocated when they are unloaded is not ours.
        self.environment = dict(os.environ, XDG_STATE_HOME=folder.name, ASAN_OPTIONS="detect_leaks=0")

    def serve(self, *options):
        read, write = os.pipe()
        server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x800x24", "-nolisten", "tcp",
             "-fbdir", self.folder, *options], pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        self.addCleanup(self.end, server)
        with os.fdopen(read) as told:
            self.environment["DISPLAY"] = ":" + told.readline().strip()

    @staticmethod
    def end(process):
        process.terminate()
        process.wait(20)

    def xdotool(self, *words):
        return subprocess.run(["xdotool", *map(str, words)], env=self.environment, check=True, timeout=60,
                              stdout=subprocess.PIPE, text=True).stdout

    def until(self, holds, what):
        end = time.monotonic() + 60
        while not (found := holds()):
            self.assertLess(time.monotonic(), end, "waited in vain for " + what)
            time.sleep(0.1)
        return found

    def pixels(self, wanted):
        """Where in the scene's view pixels are as wanted (X Window Dump: a header of 32-bit numbers, colours, rows)."""
        dump = (self.folder / "Xvfb_screen0").read_bytes()
        header = struct.unpack(">25I", dump[:100])
        begin, stride = header[0] + 12 * header[19], header[12]
        left, top, right, bottom = SCENE
        places = []
        for y in range(top, bottom):
            row = dump[begin + y * stride + 4 * left : begin + y * stride + 4 * right]
            places += [(left + i // 4, y) for i in range(0, len(row), 4) if wanted((row[i + 2], row[i + 1], row[i]))]
        return places

    def journal(self):
        """The log's lines, which of them is shown, and the motions by entries' numbers."""
        entries, shown, motions, numbers = [], 0, {}, []
        for file in self.folder.glob("spacetime/*.journal"):
            for line in file.read_text().splitlines():
                try:
                    line = json.loads(line)
                except ValueError:
                    break  # it is being written
                if "journal" in line:
                    entries, numbers = [""], [line["number"]]
                elif "entry" in line:
                    del entries[line["entry"] :], numbers[line["entry"] :]
                    entries.append(line["text"])
                    numbers.append(line["number"])
                    shown = line["entry"]
                elif "checkpoint" in line:
                    motions[line["checkpoint"]] = line["motion"]
                elif "present" in line:
                    shown = line["present"]
        return entries, shown, motions.get(numbers[shown]) if numbers else None

    def motion_behind(self, text, status="converged"):
        """Of the act that is shown and has this text: what is drawn while it is still dragged has not converged."""
        def there():
            entries, shown, motion = self.journal()
            return motion if entries and text in entries[shown] and motion and motion["status"] == status else None

        return self.until(there, "an act with '" + text + "' and a motion that is " + status)

    def press(self, places, dx, dy):
        """Drags from the middle one of these places."""
        self.assertTrue(places)
        x, y = places[len(places) // 2]
        self.xdotool("mousemove", x, y, "sleep", 0.3, "mousedown", 1, "sleep", 0.2)
        for k in range(1, 6):
            self.xdotool("mousemove", x + dx * k // 5, y + dy * k // 5, "sleep", 0.1)
        self.xdotool("mouseup", 1, "mousemove", 1270, 795, "sleep", 0.5)

    def open(self, scene):
        window = subprocess.Popen([PROGRAMS / "spacetime-gui", scene], env=self.environment)
        self.addCleanup(self.end, window)
        self.xdotool("search", "--sync", "--name", "Spacetime")
        self.xdotool("search", "--name", "Spacetime", "windowfocus", "--sync")
        self.until(lambda: self.pixels(handle), "the basket")
        return window

    def leave(self, window):
        self.xdotool("key", "ctrl+q")
        self.assertEqual(window.wait(30), 0)

    def to(self, index, key):
        while self.journal()[1] != index:
            before = self.journal()[1]
            self.xdotool("key", key)
            self.until(lambda: self.journal()[1] != before, key)

    def batch(self, scene):
        problem = subprocess.run([PROGRAMS / "spacetime-symbolic", "compile", scene], stdout=subprocess.PIPE, check=True)
        return json.loads(subprocess.run([PROGRAMS / "spacetime-optimizer", "solve", "-q"], input=problem.stdout,
                                         stdout=subprocess.PIPE, check=True).stdout)

    def test_a_throw_is_made_changed_undone_saved_and_the_same_in_a_batch(self):
        self.serve()
        scene = self.folder / "throw.scene"
        text = (EXAMPLES / "throw.scene").read_text()
        scene.write_text(text[: text.rindex("solve")])
        window = self.open(scene)
        self.xdotool("mousemove", *RUN, "click", 1)
        self.motion_behind("solve")

        self.xdotool("mousemove", RULER_START + (RULER_END - RULER_START) // 4, RULER_Y, "click", 1, "sleep", 0.5)
        self.press([place for place in self.pixels(handle) if place[0] < min(self.pixels(handle))[0] + 20], -30, 15)
        self.motion_behind("BasketX")
        self.press(self.pixels(of_the_arm), 10, -50)
        self.xdotool("key", "k")
        self.motion_behind("key 0.", "stopped")
        self.xdotool("mousemove", *RUN, "click", 1)
        last = self.motion_behind("solve")
        entries, shown, _ = self.journal()
        self.assertEqual(shown, len(entries) - 1)

        self.to(0, "ctrl+z")
        self.to(shown, "ctrl+shift+z")
        self.assertEqual(self.journal()[2]["dofs"], last["dofs"])
        self.xdotool("key", "ctrl+s")
        self.until(lambda: "key 0." in scene.read_text(), "the acts in the file")
        self.assertEqual(self.batch(scene)["dofs"], last["dofs"])
        self.leave(window)

        window = self.open(scene)
        self.xdotool("mousemove", *RUN, "click", 1)  # all that the file asks for
        self.until(lambda: (self.journal()[2] or {}).get("dofs") == last["dofs"], "the same motion")
        self.leave(window)

    def test_without_a_display_it_says_what_to_do(self):
        self.environment = {name: value for name, value in self.environment.items() if "DISPLAY" not in name}
        self.expect_refusal("no window can be opened", "spacetime-gui render")

    def test_without_opengl_it_says_what_to_install(self):
        self.serve("-extension", "GLX")
        self.expect_refusal("no OpenGL 3.3", "libgl1-mesa-dri")

    def expect_refusal(self, *words):
        ended = subprocess.run([PROGRAMS / "spacetime-gui"], env=self.environment, stderr=subprocess.PIPE, text=True,
                               timeout=60)
        self.assertEqual(ended.returncode, 1)
        for word in words:
            self.assertIn(word, ended.stderr)


if __name__ == "__main__":
    missing = [program for program in ("Xvfb", "xdotool") if not shutil.which(program)]
    if missing:
        sys.exit("install what is missing: " + ", ".join(missing))
    unittest.main()
