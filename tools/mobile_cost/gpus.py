"""The GPUs, and where their compilers are."""

import dataclasses
import pathlib
import re


@dataclasses.dataclass(frozen=True)
class Gpu:
    name: str  # on the command line and in the rows
    label: str
    renderer: str
    family: str  # adreno or mali
    model: int | str  # as Mesa's no-op kernel takes it
    phones: str


GPUS = {
    gpu.name: gpu
    for gpu in (
        Gpu("adreno320", "Adreno 320", "gl_compatibility", "adreno", 320, "2012; Galaxy S4"),
        Gpu("adreno630", "Adreno 630", "mobile", "adreno", 630, "2018; Snapdragon 845"),
        Gpu("adreno740", "Adreno 740", "mobile", "adreno", 740, "2022; Snapdragon 8 Gen 2"),
        # The product ids of src/panfrost/model/pan_model.c.
        Gpu("mali-g52", "Mali-G52", "gl_compatibility", "mali", "7212", "2018; Bifrost"),
        Gpu("mali-g610", "Mali-G610", "gl_compatibility", "mali", "a867", "2021; Valhall"),
    )
}


class Paths:
    """Of the engine unpacked in the cache, the compilers beside it, and the folder for what is in between."""

    def __init__(self, engine, compilers, work, arm64=None):
        self.engine, self.compilers, self.work = pathlib.Path(engine), pathlib.Path(compilers), pathlib.Path(work)
        self.arm64 = pathlib.Path(arm64) if arm64 else None

    def libraries(self, root):
        return next(path for path in (root / "usr/lib").glob("*-linux-gnu*") if path.is_dir())

    def shim(self, driver):
        return str(self.libraries(self.compilers) / f"lib{driver}_noop_drm_shim.so")

    def interpreter(self, gpu):
        """Python under the C library that the drivers need; for Mali, an emulated one."""
        if gpu.family == "mali":
            return [str(self.arm64 / "qemu"), "-L", str(self.arm64), str(self.arm64 / "usr/bin/python3")]
        libraries = self.libraries(self.engine / "root")
        loader = next(libraries.glob("ld-linux*.so.*"))
        return ["env", f"LD_PRELOAD={self.shim('freedreno')}", str(loader), "--library-path", str(libraries), "/usr/bin/python3"]

    def gl_environment(self, gpu):
        if gpu.family == "mali":
            libraries = self.libraries(self.arm64)
            return {
                "QEMU_SET_ENV": f"LD_LIBRARY_PATH={libraries},LD_PRELOAD={libraries}/libpanfrost_noop_drm_shim.so",
                "__EGL_VENDOR_LIBRARY_DIRS": str(self.arm64 / "usr/share/glvnd/egl_vendor.d"),
                "LIBGL_DRIVERS_PATH": str(libraries / "dri"),
                "PAN_GPU_ID": gpu.model,
            }
        return {"FD_GPU_ID": str(gpu.model), "IR3_SHADER_DEBUG": "vs,fs", "FD_MESA_DEBUG": "serialc"}

    def mesa(self, family):
        """The version of the compilers, as the package has it."""
        root = self.arm64 if family == "mali" else self.engine / "root"
        name = next(self.libraries(root).glob("libgallium-*.so")).name
        return re.fullmatch(r"libgallium-(.+)\.so", name)[1]
