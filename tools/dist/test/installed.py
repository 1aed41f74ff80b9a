"""make install, pkg-config, and the CMake package."""
import shutil

from harness import (BUILD, DIST, MAKE, ROOT, STRICT, TWOFOLD, Wrong, ends_at,
                     equal, folder, need, run, version)

DEMO = ROOT / "tools/dist/cmake/examples/demo"
NAMES = {"double": "f64", "float": "f32"}


def install_into(root):
    """Installs below a folder, as a package would be put together."""
    run(MAKE, "-C", ROOT, "install", f"BUILD={BUILD}", f"DESTDIR={root}",
        "PREFIX=/usr")


def install():
    """What is installed compiles, links, runs and has the bits of the tree, in
    both real types; uninstall leaves no file."""
    need("pkg-config", "pkg-config")
    root = folder("install")
    install_into(root)
    env = {"PKG_CONFIG_PATH": str(root / "usr/lib/pkgconfig"),
           "PKG_CONFIG_ALLOW_SYSTEM_CFLAGS": "1"}
    for real, name in (*NAMES.items(), ("double", None)):
        module = f"twofold_{name}" if name else "twofold"
        equal(f"version of {module}",
              run("pkg-config", "--modversion", module, env=env).strip(),
              version())
        flags = run("pkg-config", "--cflags", "--libs", module,
                    env=env).split()
        run("gcc", "-std=c99", *STRICT, DEMO / "demo.c", *flags, "-o",
            root / "demo")
        equal(module, run(root / "demo"), ends_at(real))
    equal("twofold --version",
          run(root / "usr/bin/twofold", "--version"),
          run(TWOFOLD, "--version"))
    page = (root / "usr/share/man/man1/twofold.1").read_text()
    for line in ("TH TWOFOLD 1", version(), "SH TWOFOLD RUN", "exit codes"):
        if line not in page:
            raise Wrong(f"twofold.1 does not say {line}")
    if shutil.which("man"):
        equal("warnings of man",
              run("sh", "-c", "man --warnings -l \"$1\" 2>&1 >/dev/null", "sh",
                  root / "usr/share/man/man1/twofold.1"), "")
    (root / "demo").unlink()
    run(MAKE, "-C", ROOT, "uninstall", f"BUILD={BUILD}", f"DESTDIR={root}",
        "PREFIX=/usr")
    left = [path for path in root.rglob("*") if path.is_file()]
    equal("files that uninstall leaves", left, [])


def build_demo(place, *options):
    """Builds the demo by CMake and compares what it prints."""
    run("cmake", "-S", DIST / "cmake/twofold/examples/demo", "-B", place,
        "-DCMAKE_BUILD_TYPE=Release", *options)
    run("cmake", "--build", place)
    for real, name in NAMES.items():
        equal(f"demo_{name}", run(place / f"demo_{name}"), ends_at(real))


def cmake():
    """FetchContent; find_package after CMake's install and after make's, which
    refuses another minor version; an Arm toolchain file."""
    need("cmake", "cmake")
    place = folder("cmake")
    build_demo(place / "fetched")
    source = DIST / "cmake/twofold"
    run("cmake", "-S", source, "-B", place / "built")
    run("cmake", "--build", place / "built")
    run("cmake", "--install", place / "built", "--prefix", place / "one/usr")
    install_into(place / "two")
    for root in ("one", "two"):
        prefix = f"-DCMAKE_PREFIX_PATH={place / root / 'usr'}"
        build_demo(place / f"found-{root}", prefix, "-DTWOFOLD_INSTALLED=ON")
        other = place / f"other-{root}"
        other.mkdir()
        (other / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.13)\nproject(other C)\n"
            "find_package(twofold 0.1 REQUIRED)\n")
        run("cmake", "-S", other, "-B", other / "build", prefix, fails=True)


def cmake_arm():
    """The CMake package under a toolchain file for a Cortex-M7."""
    need("cmake", "cmake")
    need("arm-none-eabi-gcc", "gcc-arm-none-eabi")
    place = folder("cmake-arm")
    toolchain = place / "cortex-m7.cmake"
    toolchain.write_text(
        "set(CMAKE_SYSTEM_NAME Generic)\n"
        "set(CMAKE_SYSTEM_PROCESSOR arm)\n"
        "set(CMAKE_C_COMPILER arm-none-eabi-gcc)\n"
        "set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)\n"
        "set(CMAKE_C_FLAGS_INIT \"-mcpu=cortex-m7 -mthumb "
        "-mfloat-abi=hard -mfpu=fpv5-d16\")\n")
    run("cmake", "-S", DIST / "cmake/twofold", "-B", place / "built",
        f"-DCMAKE_TOOLCHAIN_FILE={toolchain}", "-DCMAKE_BUILD_TYPE=Release")
    run("cmake", "--build", place / "built")
    for name in NAMES.values():
        code = run("arm-none-eabi-objdump", "-d",
                   place / f"built/libtwofold_{name}.a")
        if "vmul.f" not in code or "vfma" in code or "vfms" in code:
            raise Wrong(f"twofold_{name}: not the code that was asked for")


TESTS = {"install": install, "cmake": cmake, "cmake-arm": cmake_arm}
