"""What is unpacked of Open Image Denoise, and who finds it."""

import os
import zipfile
from unittest import mock

from hipr import environment, oidn
from hipr.errors import HiprError

from .test_openusd import TemporaryFolder


class Denoiser(TemporaryFolder):
    def setUp(self):
        super().setUp()
        os.environ.pop(oidn.VARIABLE, None)
        none = mock.patch.object(oidn, "system_has_it", return_value=False)
        none.start()
        self.addCleanup(none.stop)

    def test_a_wheel_gives_what_the_processor_needs(self):
        wheel = self.folder / "oidn.whl"
        names = {"libOpenImageDenoise.so.2", "libOpenImageDenoise_core.so.2.5.1",
                 "libOpenImageDenoise_device_cpu.so.2.5.1", "libtbb.so.12"}
        others = {"libOpenImageDenoise.so", "libOpenImageDenoise_device_cuda.so.2.5.1", "libtbb.so.12.19", "libsycl.so.9"}
        with zipfile.ZipFile(wheel, "w") as archive:
            for name in names | others:
                archive.writestr(f"pyoidn/oidn/lib/{name}", "x")
            archive.writestr("pyoidn/oidn/bin/oidnTest", "x")
        oidn.unpack(wheel, self.folder / "lib")
        self.assertEqual({path.name for path in (self.folder / "lib").iterdir()}, names)

    def test_the_environment_names_it_once_it_is_there(self):
        self.assertEqual(environment.settings(), {})
        self.assertFalse(oidn.present())
        oidn.folder().mkdir(parents=True)
        (oidn.folder() / oidn.LIBRARY).write_text("x")
        self.assertTrue(oidn.present())
        self.assertEqual(environment.settings(), {oidn.VARIABLE: oidn.folder() / oidn.LIBRARY})

    def test_without_the_network_everything_else_goes_on(self):
        with mock.patch.object(oidn, "run", side_effect=HiprError("no network")) as run:
            oidn.ensure()
        run.assert_called_once()
        self.assertFalse(oidn.present())

    def test_what_the_user_names_is_not_fetched(self):
        os.environ[oidn.VARIABLE] = "/own/library"
        with mock.patch.object(oidn, "run") as run:
            oidn.ensure()
        run.assert_not_called()
