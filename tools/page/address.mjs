// The set-up and what was done to the motion as the part of the address behind
// #, to the bit: numbers are the shortest that read back to the same bits, by
// the command line's own reader. The last word is `end`, so that an
// address that was cut off on its way is known; people who only name a scene
// need not write it.
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

const stepsOf = (text) => {
  const tick = /^\d+$/.test(text) ? Number(text) : NaN;
  return Number.isSafeInteger(tick) ? tick
    : reject(`'${clipped(text)}' must be ${TICK}`);
};

function numberOf(core, text) {
  const value = core.number(text);
  return typeof value === 'number' ? value
    : reject(`'${clipped(text)}' ${value}`);
}

function handOf(core, value) {
  const [tick, force, torque, ...more] = value.split(':');
  const limit = core.c.state_limit();
  if (torque === undefined || more.length) reject('expected TICK:FORCE:TORQUE');
  const entry = { tick: stepsOf(tick), force: numberOf(core, force),
    torque: numberOf(core, torque) };
  return Math.abs(entry.force) <= limit && Math.abs(entry.torque) <= limit
    ? entry : reject(`force and torque must lie in [${-limit}, ${limit}]`);
}

function takeOf({ modes }, value) {
  const [tick, name, ...more] = value.split(':');
  if (!modes.includes(name) || more.length)
    reject(`expected TICK:MODE, MODE one of ${modes.join(', ')}`);
  return { tick: stepsOf(tick), mode: modes.indexOf(name) };
}

// Splits a word into name and value. Of a file, name and text are decoded
// behind the colon between them.
function splitWord(word) {
  const at = word.indexOf('=');
  if (at < 0) reject('expected name=value');
  const name = word.slice(0, at), coded = word.slice(at + 1);
  if (coded === '') reject('expected a value');
  try {
    return { word, name, value: name === 'file'
      ? coded.split(':').map(decodeURIComponent) : decodeURIComponent(coded) };
  } catch {
    return reject('% is not followed by a code');
  }
}

// The number of the scene that a word names, or has the text of.
function sceneOf(core, { name, value }) {
  if (name === 'file') {
    if (value.length !== 2) reject('expected NAME:TEXT');
    const why = core.takeFile(...value);
    return why === null ? core.ownScene : reject(why);
  }
  const known = core.scenes.slice(0, core.ownScene);
  return known.includes(value) ? known.indexOf(value)
    : reject(`unknown scene; there are ${known.join(', ')}`);
}

const isScene = ({ name }) => name === 'scene' || name === 'file';
// The range of a parameter depends on the law, which is read before them.
const rank = (given) => (isScene(given) ? 0 : given.name === 'law' ? 1 : 2);

function setNumber(core, got, once, { name, value, word }) {
  const list = Object.hasOwn(core.lists, name) ? core.lists[name] : null;
  if (!list && !core.ranges.has(name)) reject('unknown name');
  once(name === 'h' || name === 'v' ? 'h or v' : name, word);
  const x = list ? list.indexOf(value) : numberOf(core, value);
  const why = core.refusal(name, x);
  if (why && list) reject(why);
  if (why) return got.told.push(why); // by name already
  core.set(name, x);
  return got.names.push(name);
}

// Returns: { scene, own, log, tick, tour, told, names }, the set-up being in
// the core; own: the scene's values; told: what was not done, word by word;
// names: of the numbers that the address sets.
export function read(core, text) {
  const got = { scene: 0, log: [], tick: 0, tour: null, told: [], names: [] };
  const words = text === '' ? [] : text.split('&');
  if (text === '' || /^scene=[^&]+$/.test(text)) words.push(END);
  const isWhole = words.at(-1) === END, before = new Map();
  // What is wrong with a word is told, and the word is left out.
  const each = (list, use) => list.flatMap((given) => {
    try {
      return [use(given)];
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      got.told.push(`${clipped(given.word ?? given)}: ${error.message}`);
      return [];
    }
  });
  const once = (key, word) => {
    if (before.has(key)) reject(`already given by ${clipped(before.get(key))}`);
    before.set(key, word);
  };
  const all = each(isWhole ? words.slice(0, -1) : words, splitWord)
    .sort((a, b) => rank(a) - rank(b));
  each(all.filter(isScene), (given) => {
    once('scene', given.word);
    got.scene = sceneOf(core, given);
  });
  core.c.load(got.scene);
  got.own = Object.fromEntries(core.names.map((name) =>
    [name, core.get(name)]));
  each(all.filter((given) => !isScene(given)), (given) => {
    const { name, value, word } = given;
    if (name === 'hand' || name === 'take') {
      const entry = (name === 'hand' ? handOf : takeOf)(core, value);
      once(`${name} ${entry.tick}`, word);
      got.log.push(entry);
    } else if (name === 'tick' || name === 'tour') {
      once(name, word);
      const tick = stepsOf(value);
      if (name === 'tour' && !isStep(tick)) reject('no such step');
      got[name] = tick;
    } else setNumber(core, got, once, given);
  });
  if (!isWhole) got.told.push(`it does not end in '${END}' and may be cut off`);
  if (got.told.length > TOLD)
    got.told.splice(TOLD, Infinity, `and ${got.told.length - TOLD} more`);
  return got;
}
