"""make install, pkg-config, and the CMake package."""
import re
import shlex
import shutil

from harness import (BUILD, DIST, MAKE, ROOT, STRICT, TWOFOLD, check, ends_at,
                     equal, folder, need, run, version)

DEMO = ROOT / "tools/package/dist/cmake/examples/demo"
NAMES = {"double": "f64", "float": "f32"}


def make_in(root, target, prefix="/usr"):
    """`make install` or `make uninstall` below a folder, as a package would be
    put together."""
    run(MAKE, "-C", ROOT, target, f"BUILD={BUILD}", f"DESTDIR={root}",
        f"PREFIX={prefix}")


def judge_pkg_config(root):
    """What pkg-config finds below a folder compiles, links and has the bits of
    the tree."""
    env = {"PKG_CONFIG_PATH": str(root / "lib/pkgconfig"),
           "PKG_CONFIG_ALLOW_SYSTEM_CFLAGS": "1"}
    for real, name in (*NAMES.items(), ("double", None)):
        module = f"twofold_{name}" if name else "twofold"
        equal(f"version of {module}",
              run("pkg-config", "--modversion", module, env=env).strip(),
              version())
        # As a shell reads them.
        flags = shlex.split(run("pkg-config", "--cflags", "--libs", module,
                                env=env))
        demo = root.parent / "demo"
        run("gcc", "-std=c99", *STRICT, DEMO / "demo.c", *flags, "-o", demo)
        equal(module, run(demo), ends_at(real))
        demo.unlink()


def judge_manual(page):
    """A section for each command that `twofold --help` lists."""
    check(f'"twofold {version()}"' in page, "version in twofold.1")
    commands = re.findall(r"^  ([a-z]+) ", run(TWOFOLD, "--help"), re.M)
    equal("commands in twofold.1",
          re.findall(r"^\.SH TWOFOLD (\w+)", page.lower(), re.M | re.I),
          [name for name in commands if name != "help"])


def test_api():
    """Every public function has its place in the pages of `make api`."""
    need("doxygen", "doxygen")
    run(MAKE, "-s", "api", f"BUILD={BUILD}", cwd=ROOT)
    pages = "".join(page.read_text()
                    for page in (BUILD / "api").glob("*_8h.html"))
    for header in (ROOT / "include/twofold").glob("*.h"):
        for name in re.findall(r"^#define (tf_\w+) TF_LINK", header.read_text(),
                               re.M):
            check(re.search(rf"memtitle.*</a></span>{name}(\(|\[|<)", pages),
                  f"{header.name}: {name}")


COMPLETIONS = {
    "bash": "share/bash-completion/completions/twofold",
    "zsh": "share/zsh/site-functions/_twofold",
    "fish": "share/fish/vendor_completions.d/twofold.fish"}


def test_install():
    """What is installed can be used, in both real types; uninstall leaves
    nothing of it, and what is another's. Names of folders may have blanks."""
    need("pkg-config", "pkg-config")
    for name, prefix in (("install", "/usr"), ("two words", "/a prefix"),
                         ("install-empty", "/usr/local")):
        top = folder(name)
        root = top / prefix[1:]
        before = {root / "bin/other", root / "share/man/man1/other.1"}
        for path in before if name != "install-empty" else ():
            path.parent.mkdir(parents=True)
            path.touch()
        make_in(top, "install", prefix)
        judge_pkg_config(root)
        equal("twofold --version", run(root / "bin/twofold", "--version"),
              run(TWOFOLD, "--version"))
        page = root / "share/man/man1/twofold.1"
        judge_manual(page.read_text())
        for shell, file in COMPLETIONS.items():
            equal(f"completions of {shell}", (root / file).read_text(),
                  run(TWOFOLD, "completions", shell))
        if shutil.which("man"):
            equal("warnings of man",
                  run("sh", "-c", "man --warnings -l \"$1\" 2>&1 >/dev/null",
                      "sh", page), "")
        make_in(top, "uninstall", prefix)
        left = {path for path in root.rglob("*")
                if not any(path in other.parents for other in before)}
        equal("what uninstall leaves", left,
              set() if name == "install-empty" else before)
        make_in(top, "uninstall", prefix)  # nothing is there: no failure


def build_demo(place, *options):
    """Builds the demo by CMake and compares what it prints."""
    run("cmake", "-S", DIST / "cmake/twofold/examples/demo", "-B", place,
        "-DCMAKE_BUILD_TYPE=Release", *options)
    run("cmake", "--build", place)
    for real, name in NAMES.items():
        equal(f"demo_{name}", run(place / f"demo_{name}"), ends_at(real))


def test_cmake():
    """FetchContent; find_package after CMake's install and after make's, which
    refuses another minor version. A prefix may have blanks and an apostrophe in
    its name."""
    need("cmake", "cmake")
    place = folder("cmake")
    build_demo(place / "fetched")
    source = DIST / "cmake/twofold"
    run("cmake", "-S", source, "-B", place / "built")
    run("cmake", "--build", place / "built")
    run("cmake", "--install", place / "built", "--prefix", place / "one/usr")
    make_in(place / "two", "install")
    make_in(place / "it's three", "install", "/a prefix")
    for root in ("one/usr", "two/usr", "it's three/a prefix"):
        prefix = f"-DCMAKE_PREFIX_PATH={place / root}"
        root = root.split("/", maxsplit=1)[0].replace("it's ", "")
        build_demo(place / f"found-{root}", prefix, "-DTWOFOLD_INSTALLED=ON")
        other = place / f"other-{root}"
        other.mkdir()
        (other / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.13)\nproject(other C)\n"
            "find_package(twofold 0.1 REQUIRED)\n")
        run("cmake", "-S", other, "-B", other / "build", prefix,
            codes=(1,))


def test_cmake_arm():
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
        check("vmul.f" in code and "vfma" not in code and "vfms" not in code,
              f"twofold_{name}: not the code that was asked for")
