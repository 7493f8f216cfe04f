"""Which packages are missing, and where backports come from."""

import os
import re
import tempfile
import unittest
from pathlib import Path
from unittest import mock

from hipr import packages, paths
from hipr.errors import HiprError

DEB822 = """\
# a comment
Types: deb
URIs: http://mirror.example/debian
Suites: bookworm bookworm-updates
Components: main
Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg

Types: deb-src
URIs: http://sources.example/debian
Suites: bookworm

Enabled: no
Types: deb
URIs: http://off.example/debian
Suites: bookworm
"""

ONE_LINE = """\
# deb http://commented.example/debian bookworm main
deb [arch=amd64 signed-by=/k.gpg] http://mirror.example/debian bookworm main contrib
deb http://mirror.example/security bookworm-security main
"""


class Sources(unittest.TestCase):
    def read(self, name, text):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, name)
            path.parent.mkdir(exist_ok=True)
            path.write_text(text)
            return packages.read_sources(Path(folder))

    def test_deb822_skips_comments_sources_and_what_is_off(self):
        self.assertEqual(self.read("sources.list.d/debian.sources", DEB822), [packages.Source(
            "http://mirror.example/debian", ("bookworm", "bookworm-updates"),
            "/usr/share/keyrings/debian-archive-keyring.gpg")])

    def test_one_line_format(self):
        self.assertEqual(self.read("sources.list", ONE_LINE), [
            packages.Source("http://mirror.example/debian", ("bookworm",), "/k.gpg"),
            packages.Source("http://mirror.example/security", ("bookworm-security",))])

    def test_backports_come_from_the_machine_s_own_mirror(self):
        text = packages.backports_source(self.read("sources.list", ONE_LINE), "bookworm")
        self.assertIn("URIs: http://mirror.example/debian\n", text)
        self.assertIn("Suites: bookworm-backports\n", text)
        self.assertIn("Signed-By: /k.gpg\n", text)

    def test_backports_are_not_added_twice(self):
        sources = [packages.Source("http://a", ("bookworm",)), packages.Source("http://b", ("bookworm-backports",))]
        self.assertIsNone(packages.backports_source(sources, "bookworm"))

    def test_no_mirror_is_one_clear_message(self):
        with self.assertRaisesRegex(HiprError, "bookworm"):
            packages.backports_source([], "bookworm")


class Missing(unittest.TestCase):
    def missing(self, installed, group=packages.FULL):
        with mock.patch.object(packages, "installed_versions", return_value=installed):
            return [package.name for package in packages.missing(group)]

    def test_old_lavapipe_counts_as_missing(self):
        everything = {package.name: "999" for package in packages.PACKAGES}
        self.assertEqual(self.missing(everything), [])
        self.assertEqual(self.missing(dict(everything, **{"mesa-vulkan-drivers": "22.3.6-1+deb12u1"})),
                         ["mesa-vulkan-drivers"])

    def test_rendering_needs_no_package_of_the_tests(self):
        names = self.missing({}, packages.RENDER)
        self.assertIn("libembree-dev", names)
        self.assertNotIn("libgtest-dev", names)
        self.assertIn("libgtest-dev", self.missing({}, packages.FULL))

    def test_a_cargo_of_one_s_own_will_do(self):
        with mock.patch.object(packages.shutil, "which", return_value="/home/me/.cargo/bin/cargo"):
            self.assertNotIn("cargo-web", self.missing({}))
        with mock.patch.object(packages.shutil, "which", return_value=None):
            self.assertIn("cargo-web", self.missing({}))

    def test_every_package_has_a_reason_and_comes_once(self):
        names = [package.name for package in packages.PACKAGES]
        self.assertEqual(len(names), len(set(names)))
        for package in packages.PACKAGES:
            self.assertGreater(len(package.reason), 10, package.name)

    def test_the_manual_lists_what_set_up_installs(self):
        manual = (paths.CHECKOUT / "docs" / "setup.md").read_text(encoding="utf-8")
        for package in packages.PACKAGES:
            self.assertRegex(manual, rf"\| `{re.escape(package.name)}`.*\| {re.escape(package.reason)} \|")

    def test_without_root_the_command_is_printed(self):
        with mock.patch.object(packages, "missing", return_value=[packages.Package("libfoo-dev", "for foo")]), \
                mock.patch.object(packages.shutil, "which", side_effect=lambda name: name != "sudo" or None), \
                mock.patch.object(os, "geteuid", return_value=1000):
            with self.assertRaisesRegex(HiprError, "sudo apt-get install .*libfoo-dev"):
                packages.ensure(packages.RENDER, Path("/nonexistent/log"))


class OsRelease(unittest.TestCase):
    def test_codename(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "os-release")
            self.assertEqual(packages.os_codename(path), "")
            path.write_text('ID=debian\nVERSION_CODENAME=bookworm\n')
            self.assertEqual(packages.os_codename(path), "bookworm")


if __name__ == "__main__":
    unittest.main()
