// The set-up and what was done to the motion as the part of the address behind
// #, to the bit: numbers are the shortest that read back to the same bits.
import { decimal } from './decimal.mjs';

// The scene; one from a file with its text, but for comments.
export function sceneWord(core, scene) {
  if (scene !== core.ownScene) return `scene=${core.scenes[scene]}`;
  const lines = core.file.text.replace(/#.*/g, '').split('\n')
    .map((line) => line.trim()).filter((line) => line !== '');
  return `file=${encodeURIComponent(core.file.name)}:` +
    encodeURIComponent(lines.join('\n'));
}

// What differs from the scene.
export function write(core, scene, log, tick) {
  const words = [sceneWord(core, scene)];
  const now = core.names.map((_, i) => core.c.get(i));
  core.c.load(scene);
  core.names.forEach((name, i) => {
    const value = now[i];
    if (name === 'v is given' || Object.is(core.c.get(i), value)) return;
    const list = core.lists[name];
    words.push(`${name}=` +
      (list ? encodeURIComponent(list[value]) : decimal(value)));
  });
  const isGiven = now[core.at['v is given']];
  if (isGiven !== core.get('v is given')) {
    const name = isGiven ? 'v' : 'h';
    if (!words.some((word) => word.startsWith(`${name}=`)))
      words.push(`${name}=${decimal(now[core.at[name]])}`);
  }
  putBack(core, now);
  for (const entry of log) {
    words.push(entry.mode === undefined
      ? `hand=${entry.tick}:${decimal(entry.force)}:${decimal(entry.torque)}`
      : `take=${entry.tick}:${encodeURIComponent(core.modes[entry.mode])}`);
  }
  if (tick > 0) words.push(`tick=${tick}`);
  return words.join('&');
}

// Numbers of a set-up into the core. h and v each say which of them is given,
// so the one that is comes last.
export function putBack(core, now) {
  const { h, v } = core.at;
  now.forEach((value, i) => { if (i !== h && i !== v) core.c.set(i, value); });
  const order = now[core.at['v is given']] ? [h, v] : [v, h];
  for (const i of order) core.c.set(i, now[i]);
}

// A value as it was before it stood in an address.
function plain(value) {
  try { return decodeURIComponent(value); } catch { return value; }
}

const isTick = (x) => Number.isSafeInteger(x) && x >= 0;

function readEntry(core, name, value) {
  const [tick, a, b] = value.split(':');
  const entry = name === 'hand'
    ? { tick: Number(tick), force: Number(a), torque: Number(b) }
    : { tick: Number(tick), mode: core.modes.indexOf(a) };
  const isGood = isTick(entry.tick) && (name === 'hand'
    ? Number.isFinite(entry.force) && Number.isFinite(entry.torque)
    : entry.mode >= 0);
  return isGood ? entry : null;
}

// Returns: the number of the scene, or why there is none.
function readScene(core, name, value, word) {
  if (name === 'scene') {
    const scene = core.scenes.indexOf(value);
    return scene >= 0 && scene < core.ownScene ? scene : word;
  }
  const [file, text = ''] = word.slice(5).split(':').map(plain);
  return core.takeFile(file, text) ?? core.ownScene;
}

const isScene = (name) => name === 'scene' || name === 'file';

function readNumber(core, name, value) {
  const list = core.lists[name];
  const number = list ? list.indexOf(value) : Number(value);
  if (value === '' || Number.isNaN(number) || name === 'v is given')
    return false;
  return core.set(name, number);
}

// Returns: { scene, log, tick, refused }, the set-up being in the core;
// refused: the words that were not understood.
export function read(core, text) {
  const words = text.split('&').filter((word) => word !== '').map((word) => {
    const [name, ...rest] = word.split('=');
    return [name, plain(rest.join('=')), word];
  });
  const refused = [], log = [];
  let scene = 0, tick = 0;
  for (const [name, value, word] of words) {
    if (!isScene(name)) continue;
    const got = readScene(core, name, value, word);
    if (typeof got === 'number') scene = got;
    else refused.push(got);
  }
  core.c.load(scene);
  for (const [name, value, word] of words) {
    if (isScene(name)) continue;
    if (name === 'hand' || name === 'take') {
      const entry = readEntry(core, name, value);
      if (entry) log.push(entry);
      else refused.push(word);
    } else if (name === 'tick') {
      tick = Number(value);
      if (!isTick(tick)) {
        refused.push(word);
        tick = 0;
      }
    } else if (!readNumber(core, name, value)) refused.push(word);
  }
  return { scene, log, tick, refused };
}
