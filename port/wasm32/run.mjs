// Runs a firmware in node: node run.mjs MODULE.
import { readFileSync, writeSync } from 'node:fs';

class Halt {
  constructor(code) { this.code = code; }
}

const line = [];
const flush = () => writeSync(1, Uint8Array.from(line.splice(0)));
const port = {
  put: (byte) => { if (line.push(byte) >= 4096) flush(); },
  get: () => -1,
  now: () => performance.now(),
  halt: (code) => { throw new Halt(code); },
};

const bytes = readFileSync(process.argv[2]);
const { instance } = await WebAssembly.instantiate(bytes, { port });
try {
  instance.exports.main();
} catch (end) {
  flush();
  if (!(end instanceof Halt)) throw end;
  process.exitCode = end.code;
}
