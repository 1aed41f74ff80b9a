// The help page of `monitor`.

#include "monitor_help.h"

#include <stdio.h>

static const char page[] =
    "usage: twofold monitor FILE|DEVICE|- [OPTION]...\n"
    "\n"
    "  --as FORM            rows, with the digits of the sender's number "
    "type;\n"
    "                       without this option a terminal shows the state\n"
    "                       live. Forms:\n"
    "       csv             as `run` writes them; for files\n"
    "       plotter         label:value pairs, for the Arduino IDE's plotter\n"
    "       teleplot        name:ms:value, for Teleplot's UDP port\n"
    "       json            an object a line, for PlotJuggler's UDP server\n"
    "  --csv                --as csv\n"
    "  --live               draws the planes (g, h) and (r, omega) and the "
    "last\n"
    "                       ten seconds of modes; rows only with --as --out\n"
    "  --out FILE           with --as: FILE instead of standard output\n"
    "  --record FILE        the commands that took effect, each with its "
    "step,\n"
    "                       for 'twofold run SCENE --replay FILE'\n"
    "  --baud N             speed of a serial device; default: unchanged\n"
    "  --send COMMAND       sends a command to the board and prints the "
    "answer;\n"
    "                       may be repeated. Commands: start, stop, reset,\n"
    "                       snapshot, restore, describe, clear,\n"
    "                       set:NAME=VALUE, select:RULE[:SEED], input (the\n"
    "                       scene's own), input:OMEGA0,R0,FORCE,TORQUE,\n"
    "                       deadman:STEPS that inputs hold (0: without end).\n"
    "                       Ends after the last answer unless there is --as\n"
    "                       or a live view\n"
    "  --key FILE           32 hexadecimal digits: the key of a board that\n"
    "                       wants its commands tagged\n"
    "  --follow             wait for a device that was unplugged, or for a\n"
    "                       file to grow\n"
    "\n"
    "FILE is FILE.part until the end, see 'twofold help run'. Lost and broken\n"
    "frames, and rows with a value that is not finite, are counted on "
    "standard\n"
    "error at the end; of a device from its first schema on.\n"
    "exit codes: 0 done, 2 usage, 3 a command was refused, 4 no frame, no\n"
    "answer, interrupted within a file, or the device was unplugged, 6 done,\n"
    "but frames were lost or broken, or a value is not finite\n";

void cli_monitor_help(void) { (void)fputs(page, stdout); }
