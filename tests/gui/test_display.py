"""The window on a display, worked by mouse and keys as a person would: it needs Xvfb and xdotool."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAMS = pathlib.Path(os.environ["SPACETIME_BIN_DIR"])
EXAMPLES = pathlib.Path(os.environ["SPACETIME_SOURCE_DIR"]) / "examples"


class Display(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.environment = dict(os.environ, XDG_STATE_HOME=self.folder.name)

    def serve(self, *options):
        read, write = os.pipe()
        server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x800x24", "-nolisten", "tcp", *options],
            pass_fds=[write], stderr=subprocess.DEVNULL)
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
        while not holds():
            self.assertLess(time.monotonic(), end, "waited in vain for " + what)
            time.sleep(0.1)

    def test_a_throw_is_opened_solved_and_saved(self):
        self.serve()
        scene = pathlib.Path(self.folder.name) / "throw.scene"
        text = (EXAMPLES / "throw.scene").read_text()
        scene.write_text(text[: text.rindex("solve")])
        window = subprocess.Popen([PROGRAMS / "spacetime-gui", scene], env=self.environment)
        self.addCleanup(self.end, window)
        self.xdotool("search", "--sync", "--name", "Spacetime")
        self.xdotool("search", "--name", "Spacetime", "windowfocus", "--sync")

        def saved():
            self.xdotool("key", "ctrl+s")
            time.sleep(0.5)
            return scene.read_text().rstrip().endswith("solve")

        time.sleep(2)  # the window is starting
        self.xdotool("mousemove", 40, 41, "click", 1)  # Run

        self.until(saved, "the solve in the file")
        problem = subprocess.run([PROGRAMS / "spacetime-symbolic", "compile", scene], stdout=subprocess.PIPE, check=True)
        solved = subprocess.run([PROGRAMS / "spacetime-optimizer", "solve", "-q", "-o", os.devnull], input=problem.stdout)
        self.assertEqual(solved.returncode, 0)
        self.xdotool("key", "ctrl+q")
        self.assertEqual(window.wait(30), 0)

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
