"""The command line, the environment, and what is shown."""

import io
import os
import tempfile
import unittest
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path
from unittest import mock

from hipr import cli, console, ctest, environment, errors, openusd, progress, project, sdk
from hipr.errors import HiprError


class CommandLine(unittest.TestCase):
    def parse(self, *argv):
        options = cli.parser().parse_args(cli.split(list(argv)))
        if options.arguments[:1] == ["--"]:
            del options.arguments[0]
        return options

    def test_the_recorder_s_options_pass_through(self):
        options = self.parse("render", "a.usda", "-o", "out.png", "--samples", "16", "--help")
        self.assertEqual(options.arguments, ["a.usda", "-o", "out.png", "--samples", "16", "--help"])

    def test_set_up_s_options_may_stand_anywhere(self):
        options = self.parse("render", "a.usda", "--usd", "/opt/usd", "-o", "out.png", "--jobs=3", "--no-packages")
        self.assertEqual((options.usd, options.jobs, options.no_packages), ("/opt/usd", 3, True))
        self.assertEqual(options.arguments, ["a.usda", "-o", "out.png"])

    def test_all_behind_a_double_dash_is_the_recorder_s(self):
        self.assertEqual(self.parse("render", "--", "--help", "--jobs", "3").arguments, ["--help", "--jobs", "3"])

    def test_bad_jobs_are_refused(self):
        for bad in ("0", "-1", "many"):
            with self.assertRaises(SystemExit), redirect_stderr(io.StringIO()):
                self.parse("build", "--jobs", bad)

    def test_an_error_is_one_message_and_a_status(self):
        err = io.StringIO()
        with mock.patch.dict(os.environ, {"pxr_ROOT": "/nonexistent"}), redirect_stderr(err):
            self.assertEqual(cli.main(["env"]), 1)
        self.assertIn("/nonexistent is not an OpenUSD installation", err.getvalue())
        self.assertNotIn("Traceback", err.getvalue())


class Environment(unittest.TestCase):
    SDK = sdk.Sdk(Path("/usd"), "20.08", ours=True)

    def test_folders_come_first_and_once(self):
        once = environment.extended(self.SDK, {"PATH": "/usr/bin", "HOME": "/me"}, Path("/build"))
        self.assertEqual(once["PATH"], "/build/bin:/usd/bin:/usr/bin")
        self.assertEqual(once["PXR_PLUGINPATH_NAME"], "/build/plugin/usd")
        self.assertEqual(once["HOME"], "/me")
        self.assertEqual(environment.extended(self.SDK, once, Path("/build")), once)


class InstalledVersion(unittest.TestCase):
    def version(self, minor, patch):
        with tempfile.TemporaryDirectory() as folder:
            header = Path(folder, "include/pxr/pxr.h")
            header.parent.mkdir(parents=True)
            header.write_text(f"#define PXR_MAJOR_VERSION 0\n#define PXR_MINOR_VERSION {minor}\n"
                              f"#define PXR_PATCH_VERSION {patch}\n")
            return sdk.installed_version(Path(folder))

    def test_reads_old_and_new(self):
        self.assertEqual(self.version(20, 8), "20.08")
        self.assertEqual(self.version(24, 11), "24.11")

    def test_too_old_is_refused(self):
        with self.assertRaisesRegex(HiprError, "20.05"):
            self.version(20, 5)

    def test_the_command_line_wins_over_the_environment(self):
        with mock.patch.dict(os.environ, {"pxr_ROOT": "/from/environment"}):
            self.assertEqual(sdk.named_by_user("/from/argument"), Path("/from/argument"))
            self.assertEqual(sdk.named_by_user(None), Path("/from/environment"))
            self.assertIsNone(sdk.named_by_user("default"))


class Progress(unittest.TestCase):
    def test_counts_by_weight(self):
        pending = ["Copying a.h ..."] * 100 + ["Building CXX object a.o"] * 9
        read = progress.NinjaProgress(pending)
        for step in range(100):
            read.read(f"[{step + 1}/109] Copying a.h ...")
        self.assertAlmostEqual(read.remaining, 9.0)

    def test_time_left_follows_the_speed(self):
        read = progress.NinjaProgress(["Building CXX object a.o"] * 100)
        clock = iter(range(0, 1000, 2))
        with mock.patch.object(progress.time, "monotonic", side_effect=lambda: float(next(clock))):
            for step in range(50):
                text = read.read(f"[{step + 1}/100] Building CXX object a.o")
        self.assertAlmostEqual(read.seconds_left(), 100.0)
        self.assertIn("50 %", text)
        self.assertIn("about 1 min 40 s left", text)

    def test_a_plan_that_grew_is_followed(self):
        read = progress.NinjaProgress(["Re-running CMake..."])
        read.read("[0/1] Re-running CMake...")
        read.read("[10/100] Building CXX object a.o")
        self.assertAlmostEqual(read.remaining, 90.0)

    def test_other_lines_are_not_steps(self):
        self.assertIsNone(progress.NinjaProgress([]).read("warning: something"))

    def test_durations(self):
        self.assertEqual([console.duration(s) for s in (0.4, 59, 61, 3700)],
                         ["0 s", "59 s", "1 min 01 s", "1 h 01 min"])


class Running(unittest.TestCase):
    def run_shell(self, script):
        with tempfile.TemporaryDirectory() as folder:
            log = Path(folder, "logs", "a.log")
            try:
                console.run("Trying", ["sh", "-c", script], log)
            finally:
                self.recorded = log.read_text()

    def test_output_goes_to_the_log(self):
        self.run_shell("echo hello")
        self.assertIn("hello\n", self.recorded)
        self.assertIn("sh -c", self.recorded)

    def test_a_failure_shows_why_and_what_to_do(self):
        with self.assertRaisesRegex(HiprError, "Trying failed .exit code 3") as caught:
            self.run_shell("echo 'cp: error writing: No space left on device'; exit 3")
        self.assertIn("disk is full", caught.exception.hint)

    def test_the_first_failed_step_is_shown_not_the_last_lines(self):
        with self.assertRaises(HiprError) as caught:
            self.run_shell("echo 'FAILED: a.o'; echo why; for i in $(seq 100); do echo noise$i; done; exit 1")
        self.assertIn("why", str(caught.exception))
        self.assertNotIn("noise100", str(caught.exception))

    def test_a_missing_tool_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(HiprError, "`no-such-tool` is not installed"):
                console.run("Trying", ["no-such-tool"], Path(folder, "log"))

    def test_hints(self):
        self.assertIn("network", errors.hint_for("Could not resolve host: example").lower())
        self.assertIn("--jobs", errors.hint_for("c++: fatal error: Killed signal terminated program cc1plus"))
        self.assertEqual(errors.hint_for("all is well"), "")


class TestResults(unittest.TestCase):
    def read(self, text):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "results.xml")
            path.write_text(text)
            return ctest.read_results(path)

    def test_summary(self):
        results = self.read('<testsuite><testcase name="a" status="run"/>'
                            '<testcase name="b" status="fail"><failure message=""/></testcase>'
                            '<testcase name="c" status="notrun"><skipped message=""/></testcase></testsuite>')
        self.assertEqual((results.passed, results.failed, results.skipped), (["a"], ["b"], ["c"]))
        self.assertEqual(ctest.summary(results, 61), [
            "1 passed, 1 failed, 1 skipped in 1 min 01 s", "  skipped: c", "  FAILED:  b"])

    def test_no_file_means_no_tests(self):
        self.assertEqual(ctest.read_results(Path("/nonexistent")), ctest.Results())


class UpToDate(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        (self.root / "renderer").mkdir()
        (self.root / "renderer" / "a.cpp").write_text("a")
        build = self.root / "build"
        self.project = project.Project(sdk.Sdk(self.root / "usd", "20.08", ours=True), 1, self.root, build)
        for output in (build / "bin/hiprrecord", build / "plugin/usd/hdHipr.so"):
            output.parent.mkdir(parents=True, exist_ok=True)
            output.write_text("")
        (build / "build.ninja").write_text("")

    def steps(self, tests=False):
        """The commands that ensure() runs."""
        ran = []
        with mock.patch.object(project, "run", side_effect=lambda what, command, *_, **__: ran.append(command[0])), \
                mock.patch.object(project.NinjaProgress, "of", return_value=project.NinjaProgress([])), \
                redirect_stdout(io.StringIO()):
            self.project.ensure(tests=tests)
        return ran

    def test_nothing_runs_when_nothing_changed(self):
        self.assertEqual(self.steps(), ["cmake", "ninja"])
        self.assertEqual(self.steps(), [])

    def test_a_changed_or_new_or_deleted_source_builds(self):
        self.steps()
        (self.root / "renderer" / "a.cpp").write_text("ab")
        self.assertEqual(self.steps(), ["ninja"])
        (self.root / "renderer" / "b.cpp").write_text("b")
        self.assertEqual(self.steps(), ["ninja"])
        (self.root / "renderer" / "b.cpp").unlink()
        self.assertEqual(self.steps(), ["ninja"])
        self.assertEqual(self.steps(), [])

    def test_an_output_that_is_gone_builds(self):
        self.steps()
        (self.project.build / "bin/hiprrecord").unlink()
        self.assertEqual(self.steps(), ["ninja"])

    def test_another_openusd_configures(self):
        self.steps()
        self.project.sdk = sdk.Sdk(self.root / "other", "24.11", ours=False)
        self.assertEqual(self.steps(), ["cmake", "ninja"])

    def test_tests_configure_once_and_stay(self):
        self.steps()
        self.assertEqual(self.steps(tests=True), ["cmake", "ninja"])
        self.assertEqual(self.steps(tests=True), [])
        self.assertEqual(self.steps(), [])

    def test_the_second_stage_of_openusd_configures(self):
        self.steps()
        (self.root / "usd").mkdir()
        (self.root / "usd" / "pxrConfig.cmake").write_text("")
        (self.root / "renderer" / "a.cpp").write_text("abc")
        self.assertEqual(self.steps(), ["cmake", "ninja"])


if __name__ == "__main__":
    unittest.main()
