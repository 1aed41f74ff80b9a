// The simulator: names for the numbers of the module, and nothing of the
// physics. A Core is one motion; two of one compiled module share nothing.
import { instantiate, textAt } from './libc.mjs';

// The columns of a row by name, and their number: of the module.
export const AT = {};
export let COLUMNS = 0;

export const BAD_PARAMETER = -1;
const LOCATED = ['tolerance', 'segments']; // of that scheme, not the page's

// The first of so many numbers for which something holds, which it then does
// for all behind it; the count where it holds for none.
export function firstOf(count, holds) {
  let low = 0, high = count;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (holds(middle)) high = middle;
    else low = middle + 1;
  }
  return low;
}

const unitOf = (p) => (p.unit === '1' ? '' : ` ${p.unit}`);
export const rangeOf = (p) => `[${p.low}, ${p.high}]${unitOf(p)}`;

export class Core {
  constructor(module) {
    const exports = instantiate(module);
    this.c = exports;
    const found = this.text(exports.arithmetic());
    if (found !== 'ok') document.body.prepend(`Wrong bits: ${found}`);
    if (found !== 'ok') throw new Error(found);
    COLUMNS = this.text(exports.columns()).split(',').slice(0, -1)
      .map((name, i) => { AT[name] = i; }).length;
    // The module never grows its memory, so views of it last.
    this.row = new Float64Array(exports.memory.buffer, exports.look(), COLUMNS);
    this.scenes = this.#list(exports.scenes(), 'scene_name');
    this.ownScene = this.scenes.length; // the number of the one from a file
    this.file = null; // { name, text } of it
    this.modes = this.#names('mode_name');
    this.lists = { law: this.#names('law_name'),
      rule: this.#names('rule_name'), rest: this.#names('rest_name') };
    this.parameters = [];
    for (let i = 0; this.text(exports.parameter_name(i)) !== ''; i++) {
      this.parameters.push({
        name: this.text(exports.parameter_name(i)),
        unit: this.text(exports.parameter_unit(i)),
        words: this.text(exports.parameter_words(i)), // what it is
        low: exports.parameter_low(i),
        high: exports.parameter_high(i),
        isWhole: !exports.parameter_fits(i, 0.5),
        laws: exports.parameter_laws(i),
        scene: exports.parameter_scene(i), // where another has a value for it
        there: exports.parameter_there(i),
      });
    }
    const limit = exports.state_limit();
    this.ranges = new Map(this.parameters.map((p) => [p.name, p]));
    for (const [name, unit, words] of [
      ['r', 'm', 'displacement of the slider at the start'],
      ['omega', 'rad/s', 'speed of the disc at the start'],
      ['h', 'm/s', 'lateral slip of the wheel at the start'],
      ['v', 'm/s', 'speed of the slider at the start']])
      this.ranges.set(name, { name, unit, words, low: -limit, high: limit });
    this.ranges.set('seed', { name: 'seed', unit: '1', low: 0,
      words: 'selects the random numbers that the rule draws',
      high: 2 ** 32 - 1, isWhole: true });
    this.names = [...this.parameters.map((p) => p.name), 'law', 'rule', 'rest',
      'r', 'omega', 'h', 'v', 'v is given', 'seed'];
    this.at = Object.fromEntries(this.names.map((name, i) => [name, i]));
    this.setup = this.numbers(exports.numbers(), this.names.length);
  }

  #list(count, name) {
    return Array.from({ length: count }, (_, i) => this.text(this.c[name](i)));
  }

  // All that the core has: the first name that it has not is unknown.
  #names(name) {
    const names = [];
    for (let i = 0, next; ; i++, names.push(next)) {
      next = this.text(this.c[name](i));
      if (next === '' || next.startsWith('unknown')) return names;
    }
  }

  text(at) { return textAt(this.c, at); }

  // Reads a scene from the text of a file. Returns: null, or why it is none, by
  // line, key and range; then the one before holds.
  takeFile(name, text) {
    const { c } = this, path = new TextEncoder().encode(name)
      .subarray(0, c.scene_path_room() - 1);
    this.bytes(c.scene_path(), path.length + 1).set([...path, 0]);
    if (!c.scene_take(this.#put(text))) return this.text(c.scene_told());
    this.scenes[this.ownScene] = this.text(c.scene_name(this.ownScene));
    this.file = { name, text };
    return null;
  }

  // Puts a text where the module reads one. Returns: its bytes there.
  #put(text) {
    const { c } = this;
    const bytes = new TextEncoder().encode(text).subarray(0, c.text_room());
    this.bytes(c.text_bytes(), bytes.length).set(bytes);
    return bytes.length;
  }

  bytes(at, count) {
    return new Uint8Array(this.c.memory.buffer, at, count);
  }

  numbers(at, count) {
    return new Float64Array(this.c.memory.buffer, at, count);
  }

  get(name) { return this.setup[this.at[name]]; }

  // Returns: the number that a text is for the command line, or why it is none.
  number(text) {
    return this.text(this.c.number_take(this.#put(text))) ||
      this.c.number_value();
  }

  // Returns: whether the law needs a parameter.
  needs(p, law = this.get('law')) { return (p.laws >> law & 1) !== 0; }

  // Returns: null, or why a value is none of the set-up's number of this name,
  // by name and range. A parameter that the law does not need may be 0.
  refusal(name, value) {
    const list = this.lists[name], p = this.ranges.get(name);
    if (list) return list[value] === undefined
      ? `unknown ${name}; there are ${list.join(', ')}` : null;
    if (!p) return 'unknown name';
    const isNone = value === 0 && p.laws !== undefined && !this.needs(p);
    const isGood = value >= p.low && value <= p.high &&
      (!p.isWhole || Number.isInteger(value));
    return isGood || isNone ? null
      : `${name} = ${value} must ${p.isWhole ? 'be a whole number' : 'lie'} ` +
        `in ${rangeOf(p)}`;
  }

  // Returns: null, or why a number of the set-up has no effect.
  unused(name) {
    const p = this.ranges.get(name), rule = this.lists.rule[this.get('rule')];
    if (p?.laws !== undefined && !this.needs(p))
      return `law ${this.lists.law[this.get('law')]} does not use it`;
    if (LOCATED.includes(name)) return 'only scheme located uses it';
    if (['rate', 'seed'].includes(name) && rule !== 'random')
      return `rule ${rule} draws nothing`;
    if (name === 'rest' && !this.c.uses_rest())
      return `law ${this.lists.law[this.get('law')]} has no moment in stick`;
    return null;
  }

  // A law has been chosen. Parameters that it needs and that have no value get
  // the one of a scene that uses them; those that have it no longer need it.
  // own: the scene's values. Returns: what was given to them, in words.
  fill(own) {
    const given = new Map(), ownLaw = own.law;
    for (const p of this.parameters) {
      const value = this.get(p.name);
      const hadNone = own[p.name] === 0 && !this.needs(p, ownLaw);
      if (!this.needs(p)) {
        if (hadNone && value === p.there) this.set(p.name, 0);
      } else if (hadNone && value === 0 || !(value >= p.low)) {
        this.set(p.name, p.there);
        const words = `${p.name} = ${p.there}${unitOf(p)}`;
        const before = given.get(p.scene);
        given.set(p.scene, before ? `${before}, ${words}` : words);
      }
    }
    return [...given].map(([scene, words]) =>
      `${words} as in scene ${this.scenes[scene]}`).join('; ');
  }

  // Ranges are checked by refusal and begin. Of h and v, the one that was set
  // last is given.
  set(name, value) {
    this.setup[this.at[name]] = value;
    if (name === 'h' || name === 'v')
      this.setup[this.at['v is given']] = Number(name === 'v');
  }

  // Returns: null, or why the core refuses, by name and range.
  begin() {
    const { c } = this, status = c.begin();
    if (status === 0) {
      this.look();
      return null;
    }
    const p = this.parameters[c.offending()];
    if (status === BAD_PARAMETER && p)
      return `${this.refusal(p.name, this.get(p.name))}: law ` +
        `${this.lists.law[this.get('law')]} needs it`;
    const gamma = this.get('gamma'), sine = Math.abs(Math.sin(gamma));
    if (!this.get('v is given') && sine < c.least_sine())
      return `gamma = ${gamma}: with a start by h, |sin(gamma)| must be at ` +
        `least ${c.least_sine()}`;
    return `the start r = ${this.get('r')} m, omega = ${this.get('omega')} ` +
      `rad/s is refused: |r| + |v| + |omega| must be at most ` +
      `${c.state_limit()} (${this.status(status)})`;
  }

  status(code) { return this.text(this.c.status_name(code)); }

  look() {
    this.c.look();
    return this.row;
  }

  // All that another one of the same module is: set-up, scene from a file,
  // machine, motion. Between calls its memory is all that it has.
  become(other) {
    new Uint8Array(this.c.memory.buffer)
      .set(new Uint8Array(other.c.memory.buffer));
  }

  restore(row) {
    this.row.set(row);
    this.c.restore();
  }

  // Changes of mode or set in the last step call: [tick, before, mode, set,
  // choices] each.
  changes() {
    const count = this.c.count_changes();
    const flat = this.numbers(this.c.changed(), 5 * count);
    return Array.from({ length: count }, (_, i) =>
      Array.from(flat.subarray(5 * i, 5 * i + 5)));
  }

  regions(r0, r1, columns, w0, w1, rows) {
    const at = this.c.regions(r0, r1, columns, w0, w1, rows);
    return at === 0 ? null : this.bytes(at, columns * rows);
  }

  twoFolds() {
    const count = this.c.find_two_folds();
    const flat = this.numbers(this.c.two_folds(), 4 * count);
    return Array.from({ length: count }, (_, i) => ({
      r: flat[4 * i], v: flat[4 * i + 1], omega: flat[4 * i + 2],
      g: flat[4 * i + 3],
    }));
  }
}
