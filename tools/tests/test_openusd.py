"""The recipe, the patches, and what set-up unpacks, stamps, exports and imports."""

import io
import json
import os
import shutil
import subprocess
import tarfile
import tempfile
import unittest
import zipfile
from contextlib import redirect_stdout
from pathlib import Path
from unittest import mock

from hipr import openusd, openusd_finish, openusd_patches, openusd_recipe
from hipr.errors import HiprError


class TemporaryFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        environment = mock.patch.dict(os.environ, {"HIPR_HOME": str(self.folder / "home")})
        environment.start()
        self.addCleanup(environment.stop)
        quiet = redirect_stdout(io.StringIO())
        quiet.__enter__()
        self.addCleanup(quiet.__exit__, None, None, None)


class Patches(TemporaryFolder):
    PATCH = openusd_patches.Patch("a/file.txt", "because", "old line\n", "new line\n")

    def write(self, text):
        path = self.folder / self.PATCH.file
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
        return path

    def test_replaces_once_and_only_once(self):
        path = self.write("before\nold line\nafter\n")
        self.assertTrue(openusd_patches.apply(self.PATCH, self.folder))
        self.assertEqual(path.read_text(), "before\nnew line\nafter\n")
        self.assertFalse(openusd_patches.apply(self.PATCH, self.folder))
        self.assertEqual(path.read_text(), "before\nnew line\nafter\n")

    def test_an_addition_that_contains_the_old_text_is_not_repeated(self):
        patch = openusd_patches.Patch("a/file.txt", "because", "x\n", "x\ny\n")
        path = self.write("x\n")
        openusd_patches.apply(patch, self.folder)
        openusd_patches.apply(patch, self.folder)
        self.assertEqual(path.read_text(), "x\ny\n")

    def test_a_removal_may_be_done_already(self):
        patch = openusd_patches.Patch("a/file.txt", "because", "gone\n", "")
        path = self.write("gone\nstays\n")
        self.assertTrue(openusd_patches.apply(patch, self.folder))
        self.assertFalse(openusd_patches.apply(patch, self.folder))
        self.assertEqual(path.read_text(), "stays\n")

    def test_another_source_is_an_error_that_names_the_file(self):
        self.write("something else\n")
        with self.assertRaisesRegex(openusd_patches.PatchError, "file.txt.*because"):
            openusd_patches.apply(self.PATCH, self.folder)

    def test_an_absent_file_is_an_error(self):
        with self.assertRaises(openusd_patches.PatchError):
            openusd_patches.apply(self.PATCH, self.folder)

    def test_every_patch_has_a_reason(self):
        for patch in openusd_patches.PATCHES:
            self.assertGreater(len(patch.reason), 20, patch.file)


class Recipe(TemporaryFolder):
    def test_comments_do_not_change_what_is_built(self):
        path = self.folder / "a.cmake"
        path.write_text("# one\nset(x 1)\n")
        before = openusd_recipe._code_lines(path)
        path.write_text("# another\n\n  set(x 1)\n")
        self.assertEqual(openusd_recipe._code_lines(path), before)
        path.write_text("set(x 2)\n")
        self.assertNotEqual(openusd_recipe._code_lines(path), before)

    def test_a_preprocessor_line_is_no_comment(self):
        path = self.folder / "a.h"
        path.write_text("// comment\n#include <a>\n")
        self.assertEqual(openusd_recipe._code_lines(path), "#include <a>")

    def test_an_option_changes_the_digest(self):
        before = openusd_recipe.digest()
        with mock.patch.dict(openusd_recipe.CMAKE_OPTIONS, {"CMAKE_CXX_FLAGS_RELEASE": "-O1"}):
            self.assertNotEqual(openusd_recipe.digest(), before)
        self.assertEqual(openusd_recipe.digest(), before)


class Unpacking(TemporaryFolder):
    def test_the_crate_gives_openusd_alone(self):
        crate = self.folder / "a.crate"
        with tarfile.open(crate, "w:gz") as archive:
            for name in ("usd-cpp-0.1.1/build.rs", "usd-cpp-0.1.1/thirdparty/USD/pxr/a.h"):
                member = tarfile.TarInfo(name)
                member.size = 4
                archive.addfile(member, io.BytesIO(b"text"))
        openusd.unpack_crate(crate, self.folder / "out")
        files = [path for path in (self.folder / "out").rglob("*") if path.is_file()]
        self.assertEqual(files, [self.folder / "out/pxr/a.h"])

    def test_updating_a_tree_touches_only_what_differs(self):
        source, target = self.folder / "new", self.folder / "old"
        for root, name, text in ((source, "a/same", "x"), (target, "a/same", "x"), (source, "a/changed", "new"),
                                 (target, "a/changed", "old"), (source, "added", "y"), (target, "removed", "z")):
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        os.utime(target / "a/same", (5, 5))
        openusd.update_tree(source, target)
        self.assertEqual({str(path.relative_to(target)): path.read_text() for path in target.rglob("*")
                          if path.is_file()}, {"a/same": "x", "a/changed": "new", "added": "y"})
        self.assertEqual((target / "a/same").stat().st_mtime, 5)

    def test_tbb_gives_release_libraries_and_headers(self):
        wheel = self.folder / "tbb.whl"
        with zipfile.ZipFile(wheel, "w") as archive:
            for name in ("lib/libtbb.so.2", "lib/libtbb_debug.so.2", "lib/libtbb_preview.so.2",
                         "include/tbb/task.h", "include/pstl/a.h", "share/doc/license.txt"):
                archive.writestr(f"tbb-1.data/data/{name}", "x")
        openusd.unpack_tbb(wheel, self.folder / "tbb")
        names = {str(path.relative_to(self.folder / "tbb")) for path in (self.folder / "tbb").rglob("*")
                 if path.is_file()}
        self.assertEqual(names, {"lib/libtbb.so.2", "include/tbb/task.h"})

    def test_a_changed_download_is_refused(self):
        path = self.folder / "file"
        path.write_bytes(b"something")
        with self.assertRaisesRegex(HiprError, "SHA-256"):
            openusd.check_sha256(path, "0" * 64)

    def test_an_equal_file_keeps_its_time(self):
        source, target = self.folder / "a", self.folder / "b"
        source.write_text("x")
        target.write_text("x")
        os.utime(target, (5, 5))
        openusd.copy_if_different(source, target)
        self.assertEqual(target.stat().st_mtime, 5)
        source.write_text("y")
        openusd.copy_if_different(source, target)
        self.assertEqual(target.read_text(), "y")


class Finishing(TemporaryFolder):
    def test_cmake_targets_name_their_own_prefix(self):
        path = self.folder / "cmake/pxrTargets.cmake"
        path.parent.mkdir()
        path.write_text(f'"{self.folder}/include;/work/tbb/include"')
        openusd_finish.make_relocatable(self.folder, Path("/work/tbb"))
        self.assertEqual(path.read_text(), '"${_IMPORT_PREFIX}/include;${_IMPORT_PREFIX}/include"')

    def test_the_cmake_package_finds_boost_once(self):
        path = self.folder / "pxrConfig.cmake"
        path.write_text("include(targets)\n")
        openusd_finish.find_boost(path)
        openusd_finish.find_boost(path)
        self.assertEqual(path.read_text(), openusd_finish.BOOST + "include(targets)\n")

    def test_the_sky_is_a_valid_white_picture(self):
        path = self.folder / "textures/sky.exr"
        openusd_finish.write_sky(path)
        if not shutil.which("oiiotool"):
            self.skipTest("oiiotool is not installed")
        report = subprocess.run(["oiiotool", "--info", "--stats", str(path)], capture_output=True, text=True)
        self.assertRegex(report.stdout, r"16 x +8, 3 channel, half openexr")
        self.assertRegex(report.stdout, r"Stats Min: 1\.0+ 1\.0+ 1\.0+")
        self.assertRegex(report.stdout, r"Stats Max: 1\.0+ 1\.0+ 1\.0+")


class Archives(TemporaryFolder):
    def built(self):
        root = openusd.prefix()
        (root / "lib").mkdir(parents=True)
        (root / "lib" / "libusd.so").write_text("library")
        openusd.write_json(openusd.stamp(openusd.CORE, root), {})
        openusd.write_json(openusd.stamp(openusd.FULL, root), {})
        return root

    def test_what_is_exported_can_be_imported(self):
        root = self.built()
        archive = self.folder / "usd.tar.xz"
        openusd.export_archive(archive)
        for path in sorted(root.rglob("*"), reverse=True):
            path.unlink() if path.is_file() else path.rmdir()
        root.rmdir()
        openusd.import_archive(archive)
        self.assertEqual((root / "lib" / "libusd.so").read_text(), "library")
        self.assertTrue(openusd.has(openusd.FULL, root))

    def test_there_must_be_something_to_export(self):
        with self.assertRaisesRegex(HiprError, "no built OpenUSD"):
            openusd.export_archive(self.folder / "usd.tar.xz")

    def test_an_archive_of_another_recipe_is_refused(self):
        archive = self.folder / "other.tar.xz"
        with tarfile.open(archive, "w:xz") as out:
            out.addfile(tarfile.TarInfo("openusd-20.08-000000000000/lib/a.so"))
        with self.assertRaisesRegex(HiprError, "openusd-20.08-000000000000"):
            openusd.import_archive(archive)

    def test_a_broken_archive_is_one_clear_message(self):
        archive = self.folder / "broken.tar.xz"
        archive.write_bytes(b"not an archive")
        with self.assertRaisesRegex(HiprError, "not an archive made by"):
            openusd.import_archive(archive)
        self.assertFalse(openusd.prefix().exists())

    def test_an_unwritable_target_is_one_clear_message(self):
        self.built()
        with self.assertRaisesRegex(HiprError, "could not be written"):
            openusd.export_archive(self.folder / "no such folder" / "usd.tar.xz")


class Stamps(TemporaryFolder):
    def test_a_broken_stamp_reads_as_none(self):
        path = self.folder / "stamp.json"
        self.assertIsNone(openusd.read_json(path))
        path.write_text("{")
        self.assertIsNone(openusd.read_json(path))
        openusd.write_json(path, {"a": 1})
        self.assertEqual(openusd.read_json(path), {"a": 1})
        self.assertEqual(json.loads(path.read_text()), {"a": 1})

    def test_too_little_disk_is_said_at_the_start(self):
        with mock.patch.object(openusd.shutil, "disk_usage", return_value=mock.Mock(free=1 << 20)):
            with self.assertRaisesRegex(HiprError, "GB are free"):
                openusd.check_disk(self.folder)

    def test_a_complete_stage_builds_nothing(self):
        root = openusd.prefix()
        openusd.write_json(openusd.stamp(openusd.CORE, root), {})
        with mock.patch.object(openusd.Builder, "_stage") as stage:
            openusd.Builder(1).ensure(openusd.CORE)
            stage.assert_not_called()
            openusd.Builder(1).ensure(openusd.FULL)
            stage.assert_called_once_with(openusd.FULL)


if __name__ == "__main__":
    unittest.main()
