// The simulator: names for the numbers of the module, and nothing of the
// physics. A Core is one motion; two of one compiled module share nothing.

export const ROW = ['t', 'r', 'v', 'omega', 'h', 'g', 'F', 'M', 'mode',
  'choices', 'set', 'status', 'tick', 'phi', 'table', 'omega0', 'r0', 'force',
  'torque', 'energy', 'delassus', 'residual'];
export const AT = Object.fromEntries(ROW.map((name, i) => [name, i]));
export const COLUMNS = ROW.length;

export const REGIONS = ['sliding', 'escaping', 'crossing up', 'crossing down',
  'codimension two', 'none'];
export const BAD_PARAMETER = -1;

export class Core {
  constructor(module) {
    const exports = new WebAssembly.Instance(module, {}).exports;
    this.c = exports;
    // The module never grows its memory, so views of it last.
    this.row = new Float64Array(exports.memory.buffer, exports.look(), COLUMNS);
    this.scenes = this.#list(exports.scenes(), 'scene_name');
    this.ownScene = this.scenes.length; // the number of the one from a file
    this.file = null; // { name, text } of it
    this.modes = this.#list(5, 'mode_name');
    this.lists = { law: this.#list(6, 'law_name'),
      rule: this.#list(4, 'rule_name'), rest: this.#list(3, 'rest_name') };
    this.parameters = [];
    for (let i = 0; this.text(exports.parameter_name(i)) !== ''; i++) {
      this.parameters.push({
        name: this.text(exports.parameter_name(i)),
        unit: this.text(exports.parameter_unit(i)),
        low: exports.parameter_low(i),
        high: exports.parameter_high(i),
        laws: exports.parameter_laws(i),
      });
    }
    this.names = [...this.parameters.map((p) => p.name), 'law', 'rule', 'rest',
      'r', 'omega', 'h', 'v', 'v is given', 'seed'];
    this.at = Object.fromEntries(this.names.map((name, i) => [name, i]));
  }

  #list(count, name) {
    return Array.from({ length: count }, (_, i) => this.text(this.c[name](i)));
  }

  text(at) {
    const bytes = new Uint8Array(this.c.memory.buffer, at);
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
  }

  // Reads a scene from the text of a file. Returns: null, or why it is none, by
  // line, key and range; then the one before holds.
  takeFile(name, text) {
    const { c } = this, encoder = new TextEncoder();
    const bytes = encoder.encode(text).subarray(0, c.scene_room());
    const path = encoder.encode(name).subarray(0, c.scene_path_room() - 1);
    this.bytes(c.scene_bytes(), bytes.length).set(bytes);
    this.bytes(c.scene_path(), path.length + 1).set([...path, 0]);
    if (!c.scene_take(bytes.length)) return this.text(c.scene_told());
    this.scenes[this.ownScene] = this.text(c.scene_name(this.ownScene));
    this.file = { name, text };
    return null;
  }

  bytes(at, count) {
    return new Uint8Array(this.c.memory.buffer, at, count);
  }

  numbers(at, count) {
    return new Float64Array(this.c.memory.buffer, at, count);
  }

  get(name) { return this.c.get(this.at[name]); }

  // Returns: whether the set-up has such a number and, if it is one of a list,
  // whether it is in the list. Ranges are checked by begin.
  set(name, value) {
    return name in this.at && this.c.set(this.at[name], value) !== 0;
  }

  // Returns: null, or why the core refuses, by name and range.
  begin() {
    const status = this.c.begin();
    if (status === 0) {
      this.look();
      return null;
    }
    const p = this.parameters[this.c.offending()];
    if (status === BAD_PARAMETER && p) {
      const unit = p.unit === '1' ? '' : ` ${p.unit}`;
      return { name: p.name, text: `${p.name} = ${this.get(p.name)} must lie ` +
        `in [${p.low}, ${p.high}]${unit}` };
    }
    return { name: '', text: `the start r = ${this.get('r')} m, omega = ` +
      `${this.get('omega')} rad/s is refused: ` +
      this.text(this.c.status_name(status)) };
  }

  status(code) { return this.text(this.c.status_name(code)); }

  look() {
    this.c.look();
    return this.row;
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

  regionsAt(r, g0, g1, count) {
    const at = this.c.regions_at(r, g0, g1, count);
    return at === 0 ? null : this.bytes(at, count);
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
