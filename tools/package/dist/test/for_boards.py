"""The packages for boards: each example is compiled; Arduino's are linked by
Debian's arduino-mk. What ESP-IDF and Zephyr would do with a package is done by
a stand-in of the few commands that it calls, with a compiler of their chips."""
import json
import re
import shutil
import struct
from pathlib import Path

from harness import (DIST, STRICT, check, equal, folder, lacks, need, rows_of,
                     run, version)

MODES = ("slip+", "slip-", "stick+", "stick-", "pinned")
# Board and chip as arduino-mk names them, the processor as simavr does, flash
# without the boot loader, RAM.
MEGA = ("mega", "atmega2560", "atmega2560", 253952, 8192)
UNO = ("uno", "", "atmega328p", 32256, 2048)
ARDUINO = Path("/usr/share/arduino/Arduino.mk")
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


def sketch(place, example, board, chip):
    """An example, linked by arduino-mk as for a board; the program."""
    if not ARDUINO.is_file():
        lacks("arduino-mk")
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
    """Prints what a sketch takes; not more than there is, with 512 B for the
    stack."""
    sizes = run("avr-size", program).splitlines()[1].split()[:3]
    code, data, bss = map(int, sizes)
    says = (f"{example}: flash {code + data} of {flash} B, RAM {data + bss} of "
            f"{ram} B")
    check(code + data <= flash and data + bss + 512 <= ram, says)
    print(f"# {says}")


def test_arduino():
    """All scenes fit a Mega."""
    given = (DIST / "arduino/twofold/library.properties").read_text()
    check(f"\nversion={version()}\n" in given, "version of the library")
    fits("AllScenes", sketch(folder("arduino"), "AllScenes", *MEGA[:2]),
         *MEGA[3:])


def run_sketch(scene, board, chip, processor, flash, ram):
    """The sketch of a prepared scene fits the board. Run by simavr it prints
    states of the float trajectory that the command line computes, in their
    order."""
    example = scene.capitalize()
    program = sketch(folder(f"arduino-{board}"), example, board, chip)
    fits(example, program, flash, ram)
    need("simavr", "simavr")
    said = run("sh", "-c", "timeout 600 simavr -m \"$2\" -f 16000000 \"$1\" "
               "2>&1 | grep -am 20 mode:", "sh", program, processor)
    got = [tuple(map(int, row)) for row in re.findall(
        r"r:(-?\d+) omega:(-?\d+) mode:(\d)", said)]
    check(len(got) == 20, f"simavr printed {len(got)} rows")
    there = iter([(micro(row[1]), micro(row[3]), MODES.index(row[8]))
                  for row in rows_of("float", scene, "--t-end", 20)])
    for row in got:
        check(row in there, f"no step of the trajectory is {row}, or not after "
              "the row before")
    print(f"# {len(got)} rows of {scene} on {board} are those of the "
          "trajectory")


def test_arduino_mega():
    run_sketch("chaos", *MEGA)


def test_arduino_uno():
    run_sketch("smooth", *UNO)


def micro(text):
    """A float in units of 1e-6, as the sketch prints it."""
    return int(single(single(float(text)) * single(1e6)))


def single(value):
    """A number rounded to float."""
    return struct.unpack("f", struct.pack("f", value))[0]


def test_platformio():
    """The files that library.json names are there, and the example compiles and
    runs by its flags."""
    library = DIST / "platformio/twofold"
    given = json.loads((library / "library.json").read_text())
    equal("version of library.json", given["version"], version())
    include = library / given["build"]["includeDir"]
    for header in given["headers"]:
        check((include / header).is_file(), f"there is no {header}")
    place = folder("platformio")
    for example in given["examples"]:
        base = library / example["base"]
        for file in example["files"]:
            check((base / file).is_file(), f"there is no {base / file}")
        run("gcc", "-O2", "-DTF_REAL_FLOAT", *given["build"]["flags"], *STRICT,
            "-I", include, base / "src/main.c",
            library / given["build"]["srcDir"] / "twofold.c", "-lm", "-o",
            place / "example")
        check(run(place / "example").startswith("chaos r = "), "something else")


def stand_in(name, texts, source, compiler, flags, *defines):
    """A project that is compiled by CMake, in gnu17 and in float, with a
    stand-in of files by their paths below the folder that it gives. source: of
    the project, below that folder. Returns: what CMake prints."""
    need("cmake", "cmake")
    place = folder(name)
    for path, text in texts.items():
        (place / path).parent.mkdir(parents=True, exist_ok=True)
        (place / path).write_text(text)
    said = run("cmake", "-S", place / source, "-B", place / "built", "-G",
               "Unix Makefiles", f"-DCMAKE_C_COMPILER={compiler}",
               "-DCMAKE_SYSTEM_NAME=Generic",
               "-DCMAKE_TRY_COMPILE_TARGET_TYPE=STATIC_LIBRARY", *defines,
               f"-DCMAKE_C_FLAGS={flags} -std=gnu17 -Os -Wall -Wextra -Werror",
               env={"IDF_PATH": str(place)})
    check("TF_REAL_FLOAT" in run("cmake", "--build", place / "built",
                                 "--verbose"), "it is not compiled in float")
    return said


def test_esp_idf():
    """The project of the example, as it is, compiles for the chip of an
    ESP32-C3 against a stand-in of ESP-IDF: scanned and added as that does."""
    compiler = need("riscv64-unknown-elf-gcc", "gcc-riscv64-unknown-elf")
    component = (DIST / "esp-idf/twofold").resolve()
    manifest = (component / "idf_component.yml").read_text()
    check(f'version: "{version()}"' in manifest, "another version")
    if "/" not in run(compiler, "-print-file-name=picolibc.specs"):
        lacks("picolibc-riscv64-unknown-elf")
    example = component / "examples/chaos"
    override = re.search(r'override_path: "(.+)"',
                         (example / "main/idf_component.yml").read_text())
    equal("the component that the example names",
          (example / "main" / override[1]).resolve(), component)
    said = stand_in("esp-idf", IDF, example, compiler,
                    "-march=rv32imc -mabi=ilp32 -specs=picolibc.specs",
                    f"-DCOMPONENT={component}")
    check("requires twofold" in said,
          f"the scan of the example does not find twofold: {said}")


# A project that defines what of Zephyr a module calls, adds one and compiles
# its sample against headers that declare what that calls.
ZEPHYR = {
    "headers/zephyr/kernel.h": "#pragma once\nint k_msleep(int ms);\n",
    "headers/zephyr/sys/printk.h":
        "#pragma once\nvoid printk(const char *format, ...);\n",
    "CMakeLists.txt": """\
cmake_minimum_required(VERSION 3.16)
project(stand_in C)
set(CONFIG_TWOFOLD y)
set(CONFIG_TWOFOLD_REAL_FLOAT y)
add_library(twofold STATIC)
macro(zephyr_library)
endmacro()
macro(zephyr_include_directories)
  get_filename_component(there ${ARGN} ABSOLUTE)
  target_include_directories(twofold PUBLIC ${there})
endmacro()
macro(zephyr_compile_definitions)
  target_compile_definitions(twofold PUBLIC ${ARGN})
endmacro()
macro(zephyr_library_sources)
  get_filename_component(there ${ARGN} ABSOLUTE)
  target_sources(twofold PRIVATE ${there})
endmacro()
macro(zephyr_library_compile_options)
  target_compile_options(twofold PRIVATE ${ARGN})
endmacro()
add_subdirectory(${MODULE} package)
add_library(app OBJECT ${MODULE}/../samples/chaos/src/main.c)
target_include_directories(app PRIVATE headers)
target_link_libraries(app PRIVATE twofold)
"""}


def test_zephyr():
    """The module and its sample compile for a Cortex-M4F."""
    compiler = need("arm-none-eabi-gcc", "gcc-arm-none-eabi")
    module = DIST / "zephyr/twofold"
    named = dict(line.strip().split(": ") for line in
                 (module / "zephyr/module.yml").read_text().splitlines()
                 if ": " in line)
    check((module / named["kconfig"]).is_file(), "no Kconfig")
    stand_in("zephyr", ZEPHYR, ".", compiler,
             "-mcpu=cortex-m4 -mthumb -mfloat-abi=hard",
             f"-DMODULE={module / named['cmake']}")
