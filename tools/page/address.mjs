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

// What of the set-up differs from the scene: [name, value as text] each. Of h
// and v, the one that is given.
export function differences(core, scene) {
  const words = [], now = core.setup.slice();
  const isGiven = now[core.at['v is given']];
  const [given, other] = isGiven ? ['v', 'h'] : ['h', 'v'];
  core.c.load(scene);
  const isOther = isGiven !== core.get('v is given');
  core.names.forEach((name, i) => {
    const value = now[i], list = core.lists[name];
    if (name === 'v is given' || name === other ||
      Object.is(core.setup[i], value) && !(name === given && isOther)) return;
    words.push([name, list ? list[value] : exact(value)]);
  });
  core.setup.set(now);
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

const clipped = (text) => (text.length > SHOWN ? `${text.slice(0, SHOWN)}…`
  : text);
const TICK = `a whole number in [0, ${Number.MAX_SAFE_INTEGER}]`;

// Why a word of an address is left out.
class Refusal extends Error {}
const reject = (why) => { throw new Refusal(why); };

// Reads an address word by word. What is wrong with a word is told by name, and
// the word is left out.
class Reader {
  constructor(core) {
    Object.assign(this, { core, told: [], log: [], scene: 0, tick: 0,
      tour: null });
    this.given = new Map(); // words by what they say
    this.names = [];        // of the numbers that were set
  }

  // Each word by one of the methods below.
  each(words, method) {
    for (const given of words) {
      try {
        this[method](given);
      } catch (error) {
        if (!(error instanceof Refusal)) throw error;
        this.told.push(`${clipped(given.word)}: ${error.message}`);
      }
    }
  }

  split(given) {
    const { word } = given, at = word.indexOf('=');
    if (at < 0) reject('expected name=value');
    const name = word.slice(0, at), coded = word.slice(at + 1);
    if (coded === '') reject('expected a value');
    try {
      // Of a file, name and text are decoded behind the colon between them.
      given.value = name === 'file' ? coded.split(':').map(decodeURIComponent)
        : decodeURIComponent(coded);
    } catch {
      reject('% is not followed by a code');
    }
    given.name = name;
  }

  // What has been said before is refused.
  once(key, word) {
    if (this.given.has(key))
      reject(`already given by ${clipped(this.given.get(key))}`);
    this.given.set(key, word);
  }

  choose({ name, value, word }) {
    const { core } = this;
    this.once('scene', word);
    if (name === 'file') {
      if (value.length !== 2) reject('expected NAME:TEXT');
      const why = core.takeFile(...value);
      if (why !== null) reject(why);
      this.scene = core.ownScene;
      return;
    }
    const known = core.scenes.slice(0, core.ownScene);
    if (!known.includes(value))
      reject(`unknown scene; there are ${known.join(', ')}`);
    this.scene = known.indexOf(value);
  }

  steps(text) {
    const tick = /^\d+$/.test(text) ? Number(text) : NaN;
    if (!Number.isSafeInteger(tick))
      reject(`'${clipped(text)}' must be ${TICK}`);
    return tick;
  }

  number(text) {
    const value = this.core.number(text);
    if (typeof value !== 'number') reject(`'${clipped(text)}' ${value}`);
    return value;
  }

  hand(value) {
    const [tick, force, torque, ...more] = value.split(':');
    const limit = this.core.c.state_limit();
    if (torque === undefined || more.length)
      reject('expected TICK:FORCE:TORQUE');
    const entry = { tick: this.steps(tick), force: this.number(force),
      torque: this.number(torque) };
    if (!(Math.abs(entry.force) <= limit && Math.abs(entry.torque) <= limit))
      reject(`force and torque must lie in [${-limit}, ${limit}]`);
    return entry;
  }

  take(value) {
    const [tick, name, ...more] = value.split(':'), { modes } = this.core;
    if (!modes.includes(name) || more.length)
      reject(`expected TICK:MODE, MODE one of ${modes.join(', ')}`);
    return { tick: this.steps(tick), mode: modes.indexOf(name) };
  }

  // A number of the set-up.
  set({ name, value, word }) {
    const { core } = this, isList = Object.hasOwn(core.lists, name);
    if (!isList && !core.ranges.has(name)) reject('unknown name');
    this.once(name === 'h' || name === 'v' ? 'h or v' : name, word);
    const number = isList ? core.lists[name].indexOf(value)
      : this.number(value);
    const why = core.refusal(name, number);
    if (why && isList) reject(why);
    if (why) { // by name already
      this.told.push(why);
      return;
    }
    core.set(name, number);
    this.names.push(name);
  }

  other(given) {
    const { name, value, word } = given;
    if (name === 'hand' || name === 'take') {
      const entry = this[name](value);
      this.once(`${name} ${entry.tick}`, word);
      this.log.push(entry);
    } else if (name === 'tick' || name === 'tour') {
      this.once(name, word);
      const steps = this.steps(value);
      if (name === 'tour' && !isStep(steps)) reject('no such step');
      this[name] = steps;
    } else this.set(given);
  }
}

// Returns: { scene, own, log, tick, tour, told, names }, the set-up being in
// the core; own: the scene's values; told: what was not done, word by word;
// names: of the numbers that the address sets.
export function read(core, text) {
  const reader = new Reader(core);
  const words = text === '' ? [END] : text.split('&');
  const isWhole = words.at(-1) === END;
  if (isWhole) words.pop();
  const all = words.map((word) => ({ word }));
  const named = (holds) => all.filter(({ name }) => name !== undefined &&
    holds(name));
  const isScene = (name) => name === 'scene' || name === 'file';
  reader.each(all, 'split');
  reader.each(named(isScene), 'choose');
  core.c.load(reader.scene);
  const own = Object.fromEntries(core.names.map((name) =>
    [name, core.get(name)]));
  // The range of a parameter depends on the law.
  reader.each(named((name) => name === 'law'), 'set');
  reader.each(named((name) => name !== 'law' && !isScene(name)), 'other');
  const { scene, log, tick, tour, told, names } = reader;
  if (!isWhole) told.push(`no '${END}' at its end: it may be cut off`);
  if (told.length > TOLD)
    told.splice(TOLD, Infinity, `and ${told.length - TOLD} more`);
  return { scene, own, log, tick, tour, told, names };
}
