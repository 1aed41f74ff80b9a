// Steps the module beside a table that `twofold run --every 1` wrote:
//   node check.mjs MODULE SCENE float|double <TABLE
// Every number of every row is the same, bit for bit.
import { readFileSync } from 'node:fs';

const [path, scene, real] = process.argv.slice(2);
const { instance } = await WebAssembly.instantiate(readFileSync(path), {});
const twofold = instance.exports;
const memory = () => twofold.memory.buffer;

const text = (at) => {
  const bytes = new Uint8Array(memory(), at);
  return Buffer.from(bytes.subarray(0, bytes.indexOf(0))).toString();
};
const names = [];
for (let i = 0; i < twofold.twofold_scenes(); i++) {
  names.push(text(twofold.twofold_name(i)));
}
const modes = ['slip+', 'slip-', 'stick+', 'stick-', 'pinned'];
const round = real === 'float' ? Math.fround : (x) => x;

const rows = readFileSync(0, 'utf8').trim().split('\n').slice(1);
let status = twofold.twofold_begin(names.indexOf(scene), 0, 0, 0);
let differ = 0;
for (const row of rows) {
  const [t, r, v, w, , h, g, F, M, , , mode, set, choices] =
    new Float64Array(memory(), twofold.twofold_state(), 14);
  const want = row.split(',');
  const got = [t, r, v, w, h, g, F, M];
  const same = got.every((x, i) => Object.is(x + 0, round(Number(want[i])) + 0));
  const words = modes.filter((_, i) => set >> i & 1).join('|');
  if (!same || modes[mode] !== want[8] || choices !== Number(want[9]) ||
    words !== want[10]) differ++;
  status = twofold.twofold_step(1);
}
const refused = [twofold.twofold_begin(names.length, 0, 0, 0),
  twofold.twofold_begin(0, -1, 0, 0), twofold.twofold_step(1)];
console.log(`module ${scene} ${real}: ${rows.length} rows, ${differ} differ`);
process.exitCode =
  rows.length > 1 && differ === 0 && status >= 0 && refused.every((x) => x < 0)
    ? 0 : 1;
