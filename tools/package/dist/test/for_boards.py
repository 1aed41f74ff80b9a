"""The packages for boards: each example is compiled; Arduino's are linked by
Debian's arduino-mk. What ESP-IDF and Zephyr would do with a package is done by
a stand-in of the few commands that it calls, with a compiler of their chips."""
import json
import re
import shutil
import struct
from functools import partial
from pathlib import Path

from harness import (DIST, STRICT, Missing, Wrong, equal, folder, need,
                     rows_of, run, version)

MODES = ("slip+", "slip-", "stick+", "stick-", "pinned")
# Board and chip as arduino-mk names them, the processor as simavr does, flash
# without the boot loader, RAM.
MEGA = ("mega", "atmega2560", "atmega2560", 253952, 8192)
UNO = ("uno", "", "atmega328p", 32256, 2048)
ARDUINO = Path("/usr/share/arduino/Arduino.mk")
# What the specification of library.properties asks for, and arduino-lint.
PROPERTIES = {
    "name": r"[A-Za-z0-9][A-Za-z0-9_. -]{0,62}",
    "version": r"\d+\.\d+\.\d+",
    "author": r".+",
    "maintainer": r".+ <.+@.+>",
    "sentence": r"[A-Z].{1,80}\.",
    "paragraph": r".+",
    "category": "Display|Communication|Signal Input/Output|Sensors|"
                "Device Control|Timing|Data Storage|Data Processing|Other",
    "url": r"https?://.+",
    "architectures": r"\*|[a-z0-9_]+(,[a-z0-9_]+)*",
    "includes": r".+\.h",
}
MAKEFILE = """\
ARDUINO_DIR = /usr/share/arduino
BOARD_TAG = @BOARD@
BOARD_SUB = @CHIP@
USER_LIB_PATH = @LIBRARIES@
ARDUINO_LIBS = twofold
OBJDIR = built
# The float.h of avr-gcc 5.4 has no DECIMAL_DIG for C++11, which the core asks.
CPPFLAGS += -DDECIMAL_DIG=__DECIMAL_DIG__
include /usr/share/arduino/Arduino.mk
"""


# Of ESP-IDF what a project calls, as docs of its build system tell: first every
# component is read as a script, which ends where it is registered, to find what
# it requires; then it is added, in a scope of its own.
IDF = {
    "tools/cmake/project.cmake": """\
macro(project name)
  foreach(part ${COMPONENT} ${CMAKE_SOURCE_DIR}/main)
    execute_process(COMMAND ${CMAKE_COMMAND} -DPART=${part}
      -P $ENV{IDF_PATH}/scan.cmake RESULT_VARIABLE code)
    if(code)
      message(FATAL_ERROR "${part} is no script")
    endif()
  endforeach()
  _project(${name} C)
  include($ENV{IDF_PATH}/component.cmake)
  add_subdirectory(${COMPONENT} twofold)
  add_subdirectory(main)
endmacro()
""",
    "scan.cmake": """\
macro(idf_component_register)
  cmake_parse_arguments(IDF "" "" "SRCS;INCLUDE_DIRS;REQUIRES" ${ARGN})
  message("requires ${IDF_REQUIRES}")
  return()
endmacro()
include(${PART}/CMakeLists.txt)
""",
    "component.cmake": """\
macro(idf_component_register)
  cmake_parse_arguments(IDF "" "" "SRCS;INCLUDE_DIRS;REQUIRES" ${ARGN})
  get_filename_component(name ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  set(COMPONENT_LIB __idf_${name})
  add_library(${COMPONENT_LIB} STATIC ${IDF_SRCS})
  target_include_directories(${COMPONENT_LIB} PUBLIC ${IDF_INCLUDE_DIRS}
    PRIVATE $ENV{IDF_PATH}/headers)
  foreach(other ${IDF_REQUIRES})
    target_link_libraries(${COMPONENT_LIB} PUBLIC __idf_${other})
  endforeach()
endmacro()
""",
    "headers/freertos/FreeRTOS.h":
        "#pragma once\n#define pdMS_TO_TICKS(ms) (ms)\n",
    "headers/freertos/task.h":
        "#pragma once\nvoid vTaskDelay(unsigned ticks);\n",
}


def properties():
    """library.properties by the rules of the specification."""
    library = DIST / "arduino/twofold"
    given = dict(line.split("=", 1) for line in
                 (library / "library.properties").read_text().splitlines())
    equal("names of library.properties", set(given), set(PROPERTIES))
    for name, pattern in PROPERTIES.items():
        if not re.fullmatch(pattern, given[name]):
            raise Wrong(f"library.properties: {name}={given[name]}")
    equal("version of the library", given["version"], version())
    if not (library / "src" / given["includes"]).is_file():
        raise Wrong(f"there is no src/{given['includes']}")
    for line in (library / "keywords.txt").read_text().splitlines():
        if not re.fullmatch(r"\w+\t(KEYWORD|LITERAL)[12]", line):
            raise Wrong(f"keywords.txt: {line!r}")
    for example in (library / "examples").iterdir():
        if not (example / f"{example.name}.ino").is_file():
            raise Wrong(f"{example} has no sketch of its name")


def sketch(place, example, board, chip):
    """An example, linked by arduino-mk as for a board; the program."""
    if not ARDUINO.is_file():
        raise Missing("arduino-mk is missing (Debian: apt-get install "
                      "arduino-mk arduino-core-avr)")
    need("avr-g++", "gcc-avr")
    libraries, home = place / "libraries", place / example
    shutil.copytree(DIST / "arduino", libraries, dirs_exist_ok=True)
    shutil.copytree(libraries / "twofold/examples" / example, home)
    text = MAKEFILE
    for name, value in (("BOARD", board), ("CHIP", chip),
                        ("LIBRARIES", libraries)):
        text = text.replace(f"@{name}@", str(value))
    (home / "Makefile").write_text(text)
    said = run("make", "-C", home)
    equal(f"warnings of {example}",
          re.findall(r"^.*twofold.*(?:warning|error):.*$", said, re.M), [])
    return next((home / "built").glob("*.elf"))


def fits(example, program, flash, ram):
    """Prints what a sketch takes; Wrong where that is more than there is, with
    512 B for the stack."""
    sizes = run("avr-size", program).splitlines()[1].split()[:3]
    code, data, bss = map(int, sizes)
    if code + data > flash or data + bss + 512 > ram:
        raise Wrong(f"{example}: {code + data} B of {flash} B of flash, "
                    f"{data + bss} B of {ram} B of RAM")
    print(f"#        {example}: flash {code + data} of {flash} B, RAM "
          f"{data + bss} of {ram} B")


def arduino():
    """The library has the strict form; all scenes fit a Mega."""
    properties()
    fits("AllScenes", sketch(folder("arduino"), "AllScenes", *MEGA[:2]),
         *MEGA[3:])


def arduino_run(scene, board, chip, processor, flash, ram):
    """The sketch of a prepared scene fits the board. Run by simavr it prints
    states of the float trajectory that the command line computes, in their
    order."""
    example = scene.capitalize()
    program = sketch(folder(f"arduino-{board}"), example, board, chip)
    fits(example, program, flash, ram)
    need("simavr", "simavr")
    said = run("sh", "-c", "timeout 10 simavr -m \"$2\" -f 16000000 "
               "\"$1\" 2>&1; true", "sh", program, processor)
    got = [tuple(map(int, row)) for row in re.findall(
        r"r:(-?\d+) omega:(-?\d+) mode:(\d)", said)]
    if len(got) < 20:
        raise Wrong(f"simavr printed {len(got)} rows")
    there = iter([(micro(row[1]), micro(row[3]), MODES.index(row[8]))
                  for row in rows_of("float", scene, "--t-end", 20)])
    for row in got:
        if row not in there:
            raise Wrong(f"no step of the trajectory is {row}, or not after "
                        "the row before")
    print(f"#        {len(got)} rows of {scene} on {board} are those of the "
          "trajectory")


def micro(text):
    """A float in units of 1e-6, as the sketch prints it."""
    return int(single(single(float(text)) * single(1e6)))


def single(value):
    """A number rounded to float."""
    return struct.unpack("f", struct.pack("f", value))[0]


def platformio():
    """library.json has what the schema of PlatformIO demands, the files that it
    names are there, and the example compiles and runs by its flags."""
    library = DIST / "platformio/twofold"
    given = json.loads((library / "library.json").read_text())
    equal("version of library.json", given["version"], version())
    known = {"$schema", "name", "version", "description", "keywords", "license",
             "authors", "frameworks", "platforms", "headers", "build",
             "examples"}
    equal("names of library.json", set(given) - known, set())
    if not re.fullmatch(r"[^;:@,]{1,100}", given["name"]):
        raise Wrong(f"library.json: name {given['name']}")
    source = library / given["build"]["srcDir"]
    include = library / given["build"]["includeDir"]
    for header in given["headers"]:
        if not (include / header).is_file():
            raise Wrong(f"there is no {header}")
    place = folder("platformio")
    for example in given["examples"]:
        base = library / example["base"]
        for file in example["files"]:
            if not (base / file).is_file():
                raise Wrong(f"there is no {base / file}")
        run("gcc", "-O2", "-DTF_REAL_FLOAT", *given["build"]["flags"], *STRICT,
            "-I", include, base / "src/main.c", source / "twofold.c", "-lm",
            "-o", place / "example")
        if not run(place / "example").startswith("chaos r = "):
            raise Wrong("the example prints something else")


def stand_in(name, commands, package, headers, compiler):
    """A CMake project that defines commands of a build system, adds a package
    and compiles its example against headers that declare what it calls."""
    need("cmake", "cmake")
    place = folder(name)
    for header, text in headers.items():
        path = place / "headers" / header
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("#pragma once\n" + text)
    main = next((DIST / name / "twofold").rglob("main.c"))
    (place / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.16)\n"
        "set(CMAKE_SYSTEM_NAME Generic)\n"
        "set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)\n"
        f"set(CMAKE_C_COMPILER {compiler[0]})\n"
        f"set(CMAKE_C_FLAGS_INIT \"{' '.join(compiler[1:])} -std=gnu17 -Os "
        "-Wall -Wextra -Werror\")\n"
        f"project(stand_in C)\n{commands}\n"
        f"add_subdirectory({DIST / name / 'twofold' / package} package)\n"
        f"add_library(app OBJECT {main})\n"
        "target_include_directories(app PRIVATE headers)\n"
        "target_link_libraries(app PRIVATE twofold)\n")
    run("cmake", "-S", place, "-B", place / "built")
    said = run("cmake", "--build", place / "built", "--verbose")
    if "TF_REAL_FLOAT" not in said:
        raise Wrong("the package is not compiled in float")
    return place / "built"


def esp_idf():
    """The project of the example, as it is, compiles for the chip of an
    ESP32-C3 against a stand-in of ESP-IDF: scanned and added as that does, in
    gnu17."""
    need("cmake", "cmake")
    compiler = need("riscv64-unknown-elf-gcc", "gcc-riscv64-unknown-elf")
    component = DIST / "esp-idf/twofold"
    manifest = (component / "idf_component.yml").read_text()
    if f'version: "{version()}"' not in manifest:
        raise Wrong("idf_component.yml has another version")
    picolibc = ("picolibc.specs", "picolibc-riscv64-unknown-elf")
    if "/" not in run(compiler, f"-print-file-name={picolibc[0]}"):
        raise Missing(f"picolibc is missing (Debian: apt-get install "
                      f"{picolibc[1]})")
    place, example = folder("esp-idf"), component / "examples/chaos"
    override = re.search(r'override_path: "(.+)"',
                         (example / "main/idf_component.yml").read_text())
    equal("the component that the example names",
          (example / "main" / override[1]).resolve(), component.resolve())
    for path, text in IDF.items():
        (place / path).parent.mkdir(parents=True, exist_ok=True)
        (place / path).write_text(text)
    said = run(
        "cmake", "-S", example, "-B", place / "built", "-G", "Unix Makefiles",
        f"-DCMAKE_C_COMPILER={compiler}", "-DCMAKE_SYSTEM_NAME=Generic",
        "-DCMAKE_TRY_COMPILE_TARGET_TYPE=STATIC_LIBRARY",
        f"-DCOMPONENT={component.resolve()}",
        "-DCMAKE_C_FLAGS=-march=rv32imc -mabi=ilp32 -specs=picolibc.specs "
        "-std=gnu17 -Os -Wall -Wextra -Werror",
        env={"IDF_PATH": str(place)})
    if "requires twofold" not in said:
        raise Wrong(f"the scan of the example does not find twofold: {said}")
    said = run("cmake", "--build", place / "built", "--verbose")
    if "TF_REAL_FLOAT" not in said:
        raise Wrong("the package is not compiled in float")


def zephyr():
    """The module and its sample compile for a Cortex-M4F, in gnu17."""
    compiler = need("arm-none-eabi-gcc", "gcc-arm-none-eabi")
    module = DIST / "zephyr/twofold"
    named = dict(line.strip().split(": ") for line in
                 (module / "zephyr/module.yml").read_text().splitlines()
                 if ": " in line)
    equal("name of the module", named["name"], "twofold")
    for path in (Path(named["cmake"]) / "CMakeLists.txt", named["kconfig"],
                 "samples/chaos/prj.conf", "samples/chaos/sample.yaml"):
        if not (module / path).is_file():
            raise Wrong(f"there is no {path}")
    chosen = set(re.findall(r"^config (\w+)",
                            (module / named["kconfig"]).read_text(), re.M))
    used = set(re.findall(r"CONFIG_(TWOFOLD\w*)", "".join(
        path.read_text() for path in module.rglob("*")
        if path.suffix in (".txt", ".conf"))))
    equal("options that Kconfig does not have", used - chosen, set())
    stand_in(
        "zephyr",
        "set(CONFIG_TWOFOLD y)\nset(CONFIG_TWOFOLD_REAL_FLOAT y)\n"
        "add_library(twofold STATIC)\n"
        "macro(zephyr_library)\nendmacro()\n"
        "macro(zephyr_include_directories)\n"
        "  get_filename_component(there ${ARGN} ABSOLUTE)\n"
        "  target_include_directories(twofold PUBLIC ${there})\nendmacro()\n"
        "macro(zephyr_compile_definitions)\n"
        "  target_compile_definitions(twofold PUBLIC ${ARGN})\nendmacro()\n"
        "macro(zephyr_library_sources)\n"
        "  get_filename_component(there ${ARGN} ABSOLUTE)\n"
        "  target_sources(twofold PRIVATE ${there})\nendmacro()\n"
        "macro(zephyr_library_compile_options)\n"
        "  target_compile_options(twofold PRIVATE ${ARGN})\nendmacro()",
        named["cmake"],
        {"zephyr/kernel.h": "int k_msleep(int ms);\n",
         "zephyr/sys/printk.h": "void printk(const char *format, ...);\n"},
        [compiler, "-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=hard"])


TESTS = {"arduino": arduino,
         "arduino-mega": partial(arduino_run, "chaos", *MEGA),
         "arduino-uno": partial(arduino_run, "smooth", *UNO),
         "platformio": platformio, "esp-idf": esp_idf,
         "zephyr": zephyr}
