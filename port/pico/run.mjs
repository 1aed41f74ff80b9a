// Runs a firmware for the Pico in an emulator, npm's rp2040js: node run.mjs ELF
// loads the UF2 file beside it as the chip's boot ROM does, with UART0 on
// standard input and output, and ends with the code of the firmware.
//   node run.mjs --here     whether the emulator is here; says how to get it
// The time is the emulator's own, of instructions at the clock that the
// firmware has set.
import { createRequire } from 'node:module';
import { readFileSync, writeSync } from 'node:fs';
import { dirname, join } from 'node:path';

const FLASH = 0x10000000, BOOT = 256, BOOT_RAM = 0x20041F00;
const BYTE_NS = 1e10 / 115200;  // on the line, ten bits

function emulator() {
  const places = [...(process.env.NODE_PATH ?? '').split(':').filter(Boolean),
    join(dirname(process.execPath), '../lib/node_modules'),
    '/usr/local/lib/node_modules'];
  for (const place of places) {
    try {
      return createRequire(join(place, 'x'))(join(place, 'rp2040js'));
    } catch (error) {
      if (error.code !== 'MODULE_NOT_FOUND') throw error;
    }
  }
  console.log('rp2040js is missing (npm install -g rp2040js@1.4.1)');
  process.exit(1);
}

// The contents of flash by a UF2 file.
function flashOf(file) {
  const pieces = [];
  for (let at = 0; at < file.length; at += 512) {
    const word = (offset) => file.readUInt32LE(at + offset);
    if (word(0) !== 0x0A324655 || word(4) !== 0x9E5D5157 ||
        word(508) !== 0x0AB16F30 || word(28) !== 0xE48BFF56 ||
        word(20) * 512 !== at || word(24) * 512 !== file.length)
      throw new Error(`no block of an RP2040's UF2 file at ${at}`);
    pieces.push([word(12) - FLASH, file.subarray(at + 32, at + 32 + word(16))]);
  }
  return pieces;
}

// The check of the boot ROM.
function crc32(bytes) {
  let crc = -1;
  for (const byte of bytes) {
    crc ^= byte << 24;
    for (let i = 0; i < 8; i++) crc = crc << 1 ^ (crc < 0 ? 0x04C11DB7 : 0);
  }
  return crc >>> 0;
}

const { RP2040 } = emulator();
if (process.argv[2] === '--here') process.exit(0);


const chip = new RP2040();
const { clock } = chip;
const complain = (part, text) => console.error(`${part}: ${text}`);
chip.logger = { debug() {}, info() {}, warn: complain, error: complain };
for (const [at, bytes] of
  flashOf(readFileSync(process.argv[2].replace(/\.elf$/, '.uf2'))))
  chip.flash.set(bytes, at);
const boot = chip.flash.subarray(0, BOOT);
if (crc32(boot.subarray(0, 252)) !== chip.flashView.getUint32(252, true))
  throw new Error('the boot ROM refuses the boot code: its CRC is wrong');
chip.sram.set(boot, BOOT_RAM - 0x20000000);
chip.core.SP = BOOT_RAM;
chip.core.PC = BOOT_RAM;

const line = [];
const flush = () => { writeSync(1, Uint8Array.from(line.splice(0))); };
chip.uart[0].onByte = (byte) => { if (line.push(byte) >= 4096) flush(); };
let code = null;  // of the end, by semihosting
chip.onBreak = () => {
  const { registers } = chip.core;
  code = registers[0] === 0x20 ? chip.readUint32(registers[1] + 4) : 99;
};

// Bytes come in as fast as the line is, and no faster.
const coming = [];
const arrival = clock.createAlarm(() => {
  if (coming.length === 0) return;
  chip.uart[0].feedByte(coming.shift());
  arrival.schedule(BYTE_NS);
});
process.stdin.on('data', (bytes) => {
  if (coming.length === 0) arrival.schedule(BYTE_NS);
  coming.push(...bytes);
});

// Until the next alarm; the emulator forgets that an interrupt which is masked
// ends the wait too.
function wait() {
  const time = clock.nanosToNextAlarm;
  if (time === 0) throw new Error('the program waits, and nothing is to come');
  clock.tick(time);
  if (chip.core.interruptsUpdated) chip.core.waiting = false;
}

function run() {
  for (let i = 0; i < 200000 && code === null; i++) {
    if (chip.core.waiting) wait();
    else clock.tick(chip.core.executeInstruction() * 1e9 / chip.clkSys);
  }
  if (line.length > 0) flush();
  if (code === null) setImmediate(run);
  else process.exit(code);
}
run();
