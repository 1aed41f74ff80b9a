// The set-up and what was done to the motion as the part of the address behind
// #, to the bit: numbers are the shortest that read back to the same bits, by
// the command line's own reader. The last word is `end`, so that an
// address that was cut off on its way is known.
import { exact } from './decimal.mjs';
import { isStep } from './tour.mjs';

const END = 'end';
const SHOWN = 48; // characters of a word that is not understood
const TOLD = 8;   // such words

// The scene; one from a file with its text, but for comments.
export function sceneWord(core, scene) {
  if (scene !== core.ownScene) return `scene=${core.scenes[scene]}`;
  const lines = core.file.text.replace(/#.*/g, '').split('\n')
    .map((line) => line.trim()).filter((line) => line !== '');
  return `file=${encodeURIComponent(core.file.name)}:` +
    encodeURIComponent(lines.join('\n'));
}

export const whole = (words) => `${words.join('&')}&${END}`;

export const numbers = (core) => core.names.map((_, i) => core.c.get(i));

// What of the set-up differs from the scene: [name, value as text] each. Of h
// and v, the one that is given.
export function differences(core, scene) {
  const words = [], now = numbers(core);
  const isGiven = now[core.at['v is given']];
  const [given, other] = isGiven ? ['v', 'h'] : ['h', 'v'];
  core.c.load(scene);
  const isOther = isGiven !== core.get('v is given');
  core.names.forEach((name, i) => {
    const value = now[i], list = core.lists[name];
    if (name === 'v is given' || name === other ||
      Object.is(core.c.get(i), value) && !(name === given && isOther)) return;
    words.push([name, list ? list[value] : exact(value)]);
  });
  putBack(core, now);
  return words;
}

// tour: its step, or null.
export function write(core, scene, log, tick, tour = null) {
  const words = [sceneWord(core, scene)];
  for (const [name, value] of differences(core, scene))
    words.push(`${name}=${encodeURIComponent(value)}`);
  for (const entry of log) {
    words.push(entry.mode === undefined
      ? `hand=${entry.tick}:${exact(entry.force)}:${exact(entry.torque)}`
      : `take=${entry.tick}:${encodeURIComponent(core.modes[entry.mode])}`);
  }
  if (tick > 0) words.push(`tick=${tick}`);
  if (tour !== null) words.push(`tour=${tour}`);
  return whole(words);
}

// Numbers of a set-up into the core. h and v each say which of them is given,
// so the one that is comes last.
export function putBack(core, now) {
  const { h, v } = core.at;
  now.forEach((value, i) => { if (i !== h && i !== v) core.c.set(i, value); });
  const order = now[core.at['v is given']] ? [h, v] : [v, h];
  for (const i of order) core.c.set(i, now[i]);
}

const clipped = (text) => (text.length > SHOWN ? `${text.slice(0, SHOWN)}…`
  : text);
const TICK = `a whole number in [0, ${Number.MAX_SAFE_INTEGER}]`;

// Reads an address word by word. What is wrong with a word is told by name, and
// the word is left out.
class Reader {
  constructor(core) {
    this.core = core;
    this.told = [];
    this.log = [];
    this.tick = 0;
    this.tour = null;
    this.given = new Map(); // words by what they say
    this.names = [];        // of the numbers that were set
  }

  // Returns: { name, value, word }, or null.
  split(word) {
    const at = word.indexOf('=');
    const name = at < 0 ? word : word.slice(0, at), coded = word.slice(at + 1);
    if (at < 0) return this.refuse(word, 'expected name=value');
    if (coded === '') return this.refuse(word, 'expected a value');
    try {
      // Of a file, name and text are decoded behind the colon between them.
      const value = name === 'file' ? coded.split(':').map(decodeURIComponent)
        : decodeURIComponent(coded);
      return { name, value, word };
    } catch {
      return this.refuse(word, '% is not followed by a code');
    }
  }

  refuse(word, why) {
    this.told.push(`${clipped(word)}: ${why}`);
    return null;
  }

  // Returns: whether nothing has said this before.
  isFirst(key, word) {
    const before = this.given.get(key);
    if (before !== undefined)
      this.refuse(word, `already given by ${clipped(before)}`);
    else this.given.set(key, word);
    return before === undefined;
  }

  // Returns: the number of a scene, or null.
  scene({ name, value, word }) {
    const { core } = this;
    if (!this.isFirst('scene', word)) return null;
    if (name === 'file') {
      if (value.length !== 2) return this.refuse(word, 'expected NAME:TEXT');
      const why = core.takeFile(...value);
      return why === null ? core.ownScene : this.refuse(word, why);
    }
    const scene = core.scenes.indexOf(value);
    return scene >= 0 && scene < core.ownScene ? scene
      : this.refuse(word, 'unknown scene; there are ' +
        core.scenes.slice(0, core.ownScene).join(', '));
  }

  // Returns: a number of steps, or null.
  steps(text, word) {
    const tick = /^\d+$/.test(text) ? Number(text) : NaN;
    return Number.isSafeInteger(tick) ? tick
      : this.refuse(word, `'${clipped(text)}' must be ${TICK}`);
  }

  // A number by its text, or null.
  number(text, word) {
    const value = this.core.number(text);
    return typeof value === 'number' ? value
      : this.refuse(word, `'${clipped(text)}' ${value}`);
  }

  hand({ value, word }) {
    const parts = value.split(':');
    if (parts.length !== 3)
      return this.refuse(word, 'expected TICK:FORCE:TORQUE');
    const tick = this.steps(parts[0], word);
    const force = tick === null ? null : this.number(parts[1], word);
    const torque = force === null ? null : this.number(parts[2], word);
    const limit = this.core.c.state_limit();
    if (torque === null) return null;
    if (!(Math.abs(force) <= limit && Math.abs(torque) <= limit))
      return this.refuse(word, `force and torque must lie in ` +
        `[${-limit}, ${limit}]`);
    return { tick, force, torque };
  }

  take({ value, word }) {
    const [text, name, ...more] = value.split(':');
    const mode = this.core.modes.indexOf(name);
    if (mode < 0 || more.length)
      return this.refuse(word, 'expected TICK:MODE, MODE one of ' +
        this.core.modes.join(', '));
    const tick = this.steps(text, word);
    return tick === null ? null : { tick, mode };
  }

  // A number of the set-up.
  set({ name, value, word }) {
    const { core } = this, isList = Object.hasOwn(core.lists, name);
    if (!isList && !core.ranges.has(name))
      return this.refuse(word, 'unknown name');
    if (!this.isFirst(name === 'h' || name === 'v' ? 'h or v' : name, word))
      return null;
    const number = isList ? core.lists[name].indexOf(value)
      : this.number(value, word);
    if (number === null) return null;
    const why = core.refusal(name, number);
    if (why && isList) return this.refuse(word, why);
    if (why) { // by name already
      this.told.push(why);
      return null;
    }
    core.set(name, number);
    this.names.push(name);
    return null;
  }

  other(given) {
    const { name, value, word } = given;
    if (name === 'tick') {
      if (this.isFirst('tick', word)) this.tick = this.steps(value, word) ?? 0;
    } else if (name === 'tour') {
      const step = this.isFirst('tour', word) ? this.steps(value, word) : null;
      if (step !== null && !isStep(step)) this.refuse(word, 'no such step');
      else this.tour = step;
    } else if (name === 'hand' || name === 'take') {
      const entry = this[name](given);
      if (entry && this.isFirst(`${name} ${entry.tick}`, word))
        this.log.push(entry);
    } else this.set(given);
  }
}

const isScene = ({ name }) => name === 'scene' || name === 'file';

// Returns: { scene, own, log, tick, tour, told, names }, the set-up being in
// the core; own: the scene's values; told: what was not done, word by word;
// names: of the numbers that the address sets.
export function read(core, text) {
  const reader = new Reader(core), words = text === '' ? [] : text.split('&');
  const isWhole = text === '' || words[words.length - 1] === END;
  if (isWhole) words.pop();
  const given = words.map((word) => reader.split(word)).filter(Boolean);
  let scene = null;
  for (const word of given.filter(isScene))
    scene = reader.scene(word) ?? scene;
  scene ??= 0;
  core.c.load(scene);
  const own = Object.fromEntries(core.names.map((name) =>
    [name, core.get(name)]));
  const others = given.filter((word) => !isScene(word));
  // The range of a parameter depends on the law.
  for (const word of others) if (word.name === 'law') reader.set(word);
  for (const word of others) if (word.name !== 'law') reader.other(word);
  if (!isWhole) reader.told.push(`no '${END}' at its end: it may be cut off`);
  const { log, tick, tour, told, names } = reader;
  if (told.length > TOLD)
    told.splice(TOLD, Infinity, `and ${told.length - TOLD} more`);
  return { scene, own, log, tick, tour, told, names };
}
